#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "image/file_io.h"
#include "image/image_error.h"

#ifdef __unix__
#include <sys/resource.h>

#include <csignal>
#endif

namespace lobelight {
namespace {

namespace fs = std::filesystem;

// A folder of its own that disappears at the end.
struct TemporaryFolder {
  fs::path path =
      fs::temp_directory_path() / ("lobelight-test-" + std::to_string(std::random_device{}()));
  TemporaryFolder() { fs::create_directories(path); }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  std::string file(const std::string& name) const { return (path / fs::u8path(name)).u8string(); }
  std::ptrdiff_t entries() const {
    return std::distance(fs::directory_iterator(path), fs::directory_iterator());
  }
};

const std::vector<char> kText = {'l', 'o', 'b', 'e', '\n', '\0', '\xff'};

TEST_CASE("write_file_atomically and read_file give the bytes back and leave nothing else") {
  const TemporaryFolder folder;
  for (const std::string name : {"plain.bin", "with space.bin", "gr\u00fc\u00df.bin"}) {
    write_file_atomically(folder.file(name), kText);
    write_file_atomically(folder.file(name), kText);  // over the old one
    const std::vector<std::uint8_t> back = read_file(folder.file(name));
    REQUIRE(back.size() == kText.size());
    CHECK(std::equal(back.begin(), back.end(), kText.begin(),
                     [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); }));
  }
  CHECK(folder.entries() == 3);
}

TEST_CASE("write_file_atomically names what is wrong and leaves nothing behind") {
  const TemporaryFolder folder;
  const std::string nowhere = folder.file("no/such/folder.bin");
  CHECK_THROWS_WITH_AS(write_file_atomically(nowhere, kText),
                       (nowhere + ": cannot be created (No such file or directory)").c_str(),
                       ImageError);
  fs::create_directory(folder.path / "taken");
  CHECK_THROWS_AS(write_file_atomically(folder.file("taken"), kText), ImageError);
  CHECK(folder.entries() == 1);
}

TEST_CASE("read_file refuses what is no file") {
  const TemporaryFolder folder;
  const std::string missing = folder.file("missing");
  CHECK_THROWS_WITH_AS(read_file(missing), (missing + ": no such file").c_str(), ImageError);
  const std::string itself = folder.path.u8string();
  CHECK_THROWS_WITH_AS(read_file(itself), (itself + ": is a folder, not a file").c_str(),
                       ImageError);
#ifdef __unix__
  CHECK_THROWS_WITH_AS(read_file("/dev/zero"), "/dev/zero: is not a regular file", ImageError);
#endif
}

#ifdef __unix__
TEST_CASE("write_file_atomically: a write that the system cuts short keeps the old file") {
  const TemporaryFolder folder;
  const std::string path = folder.file("old.bin");
  write_file_atomically(path, kText);
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  rlimit small = before;
  small.rlim_cur = 4096;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  const std::vector<char> large(100000, 'x');
  std::string message;
  try {
    write_file_atomically(path, large);
  } catch (const ImageError& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK(message == path + ": cannot be written (File too large)");
  CHECK(read_file(path).size() == kText.size());
  CHECK(folder.entries() == 1);
}
#endif

}  // namespace
}  // namespace lobelight
