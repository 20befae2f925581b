#pragma once

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>

namespace lobelight {

// Why a file cannot be read, without its name: "no such file".
class FileProblem : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A regular file, open for reading. Every member throws FileProblem.
class InputFile {
 public:
  // `path` in UTF-8. A file of more than `most_gib` GiB is refused before anything is read: a
  // sparse one could otherwise ask for any amount of memory.
  InputFile(const std::string& path, int most_gib);

  std::uint64_t size() const { return size_; }

  // `count` bytes from `offset` on, which lie in the file.
  void read(std::uint64_t offset, char* bytes, std::uint64_t count);

 private:
  std::uint64_t size_ = 0;
  std::ifstream stream_;
};

}  // namespace lobelight
