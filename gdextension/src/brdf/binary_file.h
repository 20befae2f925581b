#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "base/input_file.h"

namespace lobelight {

// A file of measurements that cannot be used. The message is one sentence, "FILE: reason".
class MeasuredFileError : public std::runtime_error {
 public:
  MeasuredFileError(const std::string& file, const std::string& reason)
      : std::runtime_error(file + ": " + reason) {}
};

// Reads ranges of a regular file, little-endian as the formats here are, and as every machine that
// this is built for. Nothing is read, and callers allocate nothing, before the range is known to
// lie in the file. Every member throws MeasuredFileError.
class BinaryFile {
 public:
  explicit BinaryFile(const std::string& path);  // UTF-8

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return file_.size(); }

  // Ends the reading with "FILE: reason".
  [[noreturn]] void fail(const std::string& reason) const;

  // Refuses a range that the file does not hold; `what` names it in the message.
  void require(std::uint64_t offset, std::uint64_t bytes, const std::string& what) const;

  // `count` elements of T from the byte `offset` on.
  template <typename T>
  void read(std::uint64_t offset, T* elements, std::size_t count, const std::string& what) {
    read_bytes(offset, reinterpret_cast<char*>(elements), count * sizeof(T), what);
  }

 private:
  void read_bytes(std::uint64_t offset, char* bytes, std::uint64_t count, const std::string& what);

  std::string path_;
  InputFile file_;
};

}  // namespace lobelight
