#include "base/input_file.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace lobelight {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* what, const std::error_code& error) {
  throw FileProblem(std::string(what) + " (" + (error ? error.message() : "unknown reason") + ")");
}

[[noreturn]] void fail_with_errno(const char* what) {
  fail(what, {errno, std::generic_category()});
}

}  // namespace

InputFile::InputFile(const std::string& path, int most_gib) {
  const fs::path file = fs::u8path(path);
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) throw FileProblem("no such file");
  if (error) fail("cannot be opened", error);
  if (fs::is_directory(status)) throw FileProblem("is a folder, not a file");
  if (!fs::is_regular_file(status)) throw FileProblem("is not a regular file");
  size_ = fs::file_size(file, error);
  if (error) fail("cannot be opened", error);
  if (size_ > static_cast<std::uint64_t>(most_gib) << 30) {
    throw FileProblem("is larger than " + std::to_string(most_gib) + " GiB");
  }
  errno = 0;
  stream_.open(file, std::ios::binary);
  if (!stream_) fail_with_errno("cannot be opened");
}

void InputFile::read(std::uint64_t offset, char* bytes, std::uint64_t count) {
  errno = 0;
  stream_.seekg(static_cast<std::streamoff>(offset));
  stream_.read(bytes, static_cast<std::streamsize>(count));
  if (!stream_) fail_with_errno("cannot be read");
}

}  // namespace lobelight
