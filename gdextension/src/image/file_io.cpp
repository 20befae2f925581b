#include "image/file_io.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <random>
#include <system_error>

#include "base/input_file.h"
#include "image/image_error.h"

namespace lobelight {
namespace {

namespace fs = std::filesystem;

// Well above the largest panorama as floats.
constexpr int kMostGib = 8;

// Bytes between two looks at whether to go on.
constexpr std::size_t kAtOnce = std::size_t{8} << 20;

std::string system_reason(int error) {
  return error == 0 ? "unknown reason" : std::generic_category().message(error);
}

fs::path temporary_beside(const fs::path& path) {
  std::random_device entropy;
  fs::path temporary = path;
  temporary += ".tmp-" + std::to_string(entropy());
  return temporary;
}

}  // namespace

std::vector<std::uint8_t> read_file(const std::string& path, const Progress* progress) try {
  InputFile file(path, kMostGib);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(file.size()));
  for (std::size_t at = 0; at < bytes.size(); at += kAtOnce) {
    throw_if_cancelled(progress);
    file.read(at, reinterpret_cast<char*>(bytes.data() + at), std::min(kAtOnce, bytes.size() - at));
  }
  return bytes;
} catch (const FileProblem& problem) {
  throw ImageError(path, problem.what());
}

void write_file_atomically(const std::string& path, const std::vector<char>& bytes) {
  const fs::path file = fs::u8path(path);
  const fs::path temporary = temporary_beside(file);
  std::error_code ignored;

  errno = 0;
  std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
  if (!stream) throw ImageError(path, "cannot be created (" + system_reason(errno) + ")");
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();  // flushes: a full disk shows here at the latest
  if (!stream) {
    const int reason = errno;
    fs::remove(temporary, ignored);
    throw ImageError(path, "cannot be written (" + system_reason(reason) + ")");
  }

  std::error_code error;
  fs::rename(temporary, file, error);
  if (error) {
    fs::remove(temporary, ignored);
    throw ImageError(path, "cannot be replaced (" + error.message() + ")");
  }
}

}  // namespace lobelight
