#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "brdf/binary_file.h"

namespace lobelight {

// The container of the RGL database's .bsdf files: "tensor_file" and a zero byte, two bytes of
// version (1, 0), uint32 the number of fields; for each field uint16 the length of its name, the
// name, uint16 the number of its dimensions, uint8 its type (1 = uint8, 10 = float32, …), uint64
// the offset of its data from the start of the file, and one uint64 for each dimension.
class TensorFile {
 public:
  enum class Type : std::uint8_t { uint8 = 1, float32 = 10 };

  struct Field {
    std::uint8_t type = 0;
    std::uint64_t offset = 0;
    std::vector<std::uint64_t> shape;  // the last dimension is the fastest
  };

  // Reads the list of fields. Throws MeasuredFileError for what is not such a file.
  explicit TensorFile(const std::string& path);

  // Whether a file begins as a tensor file does; false for one that cannot be read.
  static bool recognises(const std::string& path);

  bool has(const std::string& name) const { return fields_.count(name) != 0; }

  // The field of that name; its absence, another type or another number of dimensions is an error.
  const Field& field(const std::string& name, Type type, std::size_t dimensions) const;

  // The data of such a field, whose size is checked before anything is allocated.
  std::vector<float> floats(const std::string& name, std::size_t dimensions);
  std::vector<std::uint8_t> bytes(const std::string& name, std::size_t dimensions);

  [[noreturn]] void fail(const std::string& reason) const { file_.fail(reason); }

 private:
  template <typename T>
  std::vector<T> read(const std::string& name, Type type, std::size_t dimensions);

  BinaryFile file_;
  std::map<std::string, Field> fields_;
};

}  // namespace lobelight
