#include "image/file_io.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <random>
#include <system_error>

#include "image/image_error.h"

namespace lobelight {
namespace {

namespace fs = std::filesystem;

// Well above the largest panorama as floats; a sparse file cannot ask for more memory than this.
constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 33;

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

std::vector<std::uint8_t> read_file(const std::string& path) {
  const fs::path file = fs::u8path(path);
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) throw ImageError(path, "no such file");
  if (error) throw ImageError(path, "cannot be opened (" + error.message() + ")");
  if (fs::is_directory(status)) throw ImageError(path, "is a folder, not a file");
  if (!fs::is_regular_file(status)) throw ImageError(path, "is not a regular file");
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) throw ImageError(path, "cannot be opened (" + error.message() + ")");
  if (size > kMaxFileBytes) throw ImageError(path, "is larger than 8 GiB");

  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw ImageError(path, "cannot be opened (" + system_reason(errno) + ")");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::size_t>(stream.gcount()) != bytes.size()) {
    throw ImageError(path, "cannot be read (" + system_reason(errno) + ")");
  }
  return bytes;
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
