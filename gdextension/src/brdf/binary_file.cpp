#include "brdf/binary_file.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace lobelight {

namespace {

namespace fs = std::filesystem;

// Far above any of the databases' files: a sparse file cannot ask for more memory than this.
constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 31;

std::string in_brackets(const std::error_code& error) { return " (" + error.message() + ")"; }

}  // namespace

BinaryFile::BinaryFile(const std::string& path) : path_(path) {
  const fs::path file = fs::u8path(path);
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) fail("no such file");
  if (error) fail("cannot be opened" + in_brackets(error));
  if (fs::is_directory(status)) fail("is a folder, not a file");
  if (!fs::is_regular_file(status)) fail("is not a regular file");
  size_ = fs::file_size(file, error);
  if (error) fail("cannot be opened" + in_brackets(error));
  if (size_ > kMaxFileBytes) fail("is larger than 2 GiB");
  errno = 0;
  stream_.open(file, std::ios::binary);
  if (!stream_) fail("cannot be opened" + in_brackets({errno, std::generic_category()}));
}

void BinaryFile::fail(const std::string& reason) const { throw MeasuredFileError(path_, reason); }

void BinaryFile::require(std::uint64_t offset, std::uint64_t bytes, const std::string& what) const {
  // Written so that no sum can overflow.
  if (offset > size_ || bytes > size_ - offset) fail("ends before the end of " + what);
}

void BinaryFile::read_bytes(std::uint64_t offset, char* bytes, std::uint64_t count,
                            const std::string& what) {
  require(offset, count, what);
  errno = 0;
  stream_.seekg(static_cast<std::streamoff>(offset));
  stream_.read(bytes, static_cast<std::streamsize>(count));
  if (!stream_) fail("cannot be read" + in_brackets({errno, std::generic_category()}));
}

}  // namespace lobelight
