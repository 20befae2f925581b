#include "brdf/tensor_file.h"

#include <cstring>
#include <utility>

namespace lobelight {

namespace {

// With its terminating zero.
constexpr char kMagic[12] = "tensor_file";

// Bounds on what a header may ask for; the database's files have eleven fields of at most five
// dimensions.
constexpr std::uint32_t kMaxFields = 64;
constexpr std::uint16_t kMaxNameLength = 256;
constexpr std::uint16_t kMaxDimensions = 8;

const char* type_name(TensorFile::Type type) {
  return type == TensorFile::Type::uint8 ? "uint8" : "float32";
}

// Reads numbers one after the other.
class Cursor {
 public:
  explicit Cursor(BinaryFile& file) : file_(file) {}

  template <typename T>
  T next() {
    T value{};
    take(&value, 1);
    return value;
  }

  template <typename T>
  void take(T* elements, std::size_t count) {
    file_.read(position_, elements, count, "a tensor file's header");
    position_ += count * sizeof(T);
  }

 private:
  BinaryFile& file_;
  std::uint64_t position_ = 0;
};

}  // namespace

TensorFile::TensorFile(const std::string& path) : file_(path) {
  Cursor cursor(file_);
  char magic[sizeof kMagic];
  cursor.take(magic, sizeof magic);
  if (std::memcmp(magic, kMagic, sizeof magic) != 0) fail("is not a tensor file");
  const auto major = cursor.next<std::uint8_t>();
  const auto minor = cursor.next<std::uint8_t>();
  if (major != 1 || minor != 0) {
    fail("is a tensor file of version " + std::to_string(major) + "." + std::to_string(minor) +
         ", but only 1.0 is known");
  }
  const auto count = cursor.next<std::uint32_t>();
  if (count > kMaxFields) fail("claims to have " + std::to_string(count) + " fields");
  for (std::uint32_t n = 0; n < count; ++n) {
    const auto length = cursor.next<std::uint16_t>();
    if (length > kMaxNameLength) fail("has a field whose name is too long");
    std::string name(length, '\0');
    cursor.take(name.data(), length);
    const auto dimensions = cursor.next<std::uint16_t>();
    if (dimensions > kMaxDimensions) fail("has a field of too many dimensions");
    Field field;
    field.type = cursor.next<std::uint8_t>();
    field.offset = cursor.next<std::uint64_t>();
    field.shape.resize(dimensions);
    cursor.take(field.shape.data(), dimensions);
    fields_[name] = std::move(field);
  }
}

bool TensorFile::recognises(const std::string& path) {
  try {
    BinaryFile file(path);
    char magic[sizeof kMagic];
    file.read(0, magic, sizeof magic, "its first bytes");
    return std::memcmp(magic, kMagic, sizeof magic) == 0;
  } catch (const MeasuredFileError&) {
    return false;
  }
}

const TensorFile::Field& TensorFile::field(const std::string& name, Type type,
                                           std::size_t dimensions) const {
  const auto found = fields_.find(name);
  if (found == fields_.end()) fail("has no field \"" + name + "\"");
  const Field& field = found->second;
  if (field.type != static_cast<std::uint8_t>(type) || field.shape.size() != dimensions) {
    fail("its field \"" + name + "\" is not " + type_name(type) + " with " +
         std::to_string(dimensions) + " dimensions");
  }
  return field;
}

template <typename T>
std::vector<T> TensorFile::read(const std::string& name, Type type, std::size_t dimensions) {
  const Field& wanted = field(name, type, dimensions);
  // Whether the product of the dimensions fits is seen factor by factor, without its overflow.
  std::uint64_t count = 1;
  for (const std::uint64_t extent : wanted.shape) {
    if (extent != 0 && count > file_.size() / extent) {
      fail("its field \"" + name + "\" claims to be larger than the file");
    }
    count *= extent;
  }
  if (count == 0) fail("its field \"" + name + "\" is empty");
  if (count > file_.size() / sizeof(T)) {
    fail("its field \"" + name + "\" claims to be larger than the file");
  }
  const std::string what = "its field \"" + name + "\"";
  file_.require(wanted.offset, count * sizeof(T), what);
  std::vector<T> elements(static_cast<std::size_t>(count));
  file_.read(wanted.offset, elements.data(), elements.size(), what);
  return elements;
}

std::vector<float> TensorFile::floats(const std::string& name, std::size_t dimensions) {
  return read<float>(name, Type::float32, dimensions);
}

std::vector<std::uint8_t> TensorFile::bytes(const std::string& name, std::size_t dimensions) {
  return read<std::uint8_t>(name, Type::uint8, dimensions);
}

}  // namespace lobelight
