#pragma once

#include <cstddef>
#include <cstdint>
#include <godot_cpp/variant/array.hpp>
#include <godot_cpp/variant/callable.hpp>
#include <godot_cpp/variant/dictionary.hpp>
#include <godot_cpp/variant/packed_byte_array.hpp>
#include <godot_cpp/variant/packed_float32_array.hpp>
#include <godot_cpp/variant/packed_int32_array.hpp>
#include <godot_cpp/variant/string.hpp>
#include <godot_cpp/variant/string_name.hpp>
#include <godot_cpp/variant/vector2.hpp>
#include <godot_cpp/variant/vector2i.hpp>
#include <godot_cpp/variant/vector3.hpp>

namespace godot {

// Any value that the engine's scripts can hold. Converting to a type that the engine would not
// convert to gives that type's empty value; ask get_type() first where it matters.
class Variant {
 public:
  // In the order of GDExtensionVariantType; those beyond the subset's types occur as answers.
  enum Type {
    NIL,
    BOOL,
    INT,
    FLOAT,
    STRING,
    VECTOR2,
    VECTOR2I,
    RECT2,
    RECT2I,
    VECTOR3,
    VECTOR3I,
    TRANSFORM2D,
    VECTOR4,
    VECTOR4I,
    PLANE,
    QUATERNION,
    AABB,
    BASIS,
    TRANSFORM3D,
    PROJECTION,
    COLOR,
    STRING_NAME,
    NODE_PATH,
    RID,
    OBJECT,
    CALLABLE,
    SIGNAL,
    DICTIONARY,
    ARRAY,
    PACKED_BYTE_ARRAY,
    PACKED_INT32_ARRAY,
    PACKED_INT64_ARRAY,
    PACKED_FLOAT32_ARRAY,
    PACKED_FLOAT64_ARRAY,
    PACKED_STRING_ARRAY,
    PACKED_VECTOR2_ARRAY,
    PACKED_VECTOR3_ARRAY,
    PACKED_COLOR_ARRAY,
    PACKED_VECTOR4_ARRAY,
    VARIANT_MAX
  };

  Variant() { subset::engine.variant_new_nil(opaque_); }
  Variant(const Variant& other) { subset::engine.variant_new_copy(opaque_, other.opaque_); }
  Variant(Variant&& other) noexcept : Variant() { swap(other); }
  Variant& operator=(const Variant& other) {
    Variant copy(other);
    swap(copy);
    return *this;
  }
  Variant& operator=(Variant&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Variant() { subset::engine.variant_destroy(opaque_); }

  Variant(bool value);
  Variant(std::int64_t value);
  Variant(std::int32_t value) : Variant(static_cast<std::int64_t>(value)) {}
  Variant(std::uint64_t value) : Variant(static_cast<std::int64_t>(value)) {}
  Variant(std::uint32_t value) : Variant(static_cast<std::int64_t>(value)) {}
  Variant(double value);
  Variant(float value) : Variant(static_cast<double>(value)) {}
  Variant(const char* latin1) : Variant(String(latin1)) {}
  Variant(const String& value);
  Variant(const StringName& value);
  Variant(const Vector2& value);
  Variant(const Vector2i& value);
  Variant(const Vector3& value);
  Variant(const Dictionary& value);
  Variant(const Array& value);
  Variant(const PackedByteArray& value);
  Variant(const PackedInt32Array& value);
  Variant(const PackedFloat32Array& value);

  operator bool() const;
  operator std::int64_t() const;
  operator std::int32_t() const;
  operator std::uint64_t() const;
  operator std::uint32_t() const;
  operator double() const;
  operator float() const;
  operator String() const;
  operator StringName() const;
  operator Vector2() const;
  operator Vector2i() const;
  operator Vector3() const;
  operator Dictionary() const;
  operator Array() const;
  operator PackedByteArray() const;
  operator PackedInt32Array() const;
  operator PackedFloat32Array() const;

  Type get_type() const { return static_cast<Type>(subset::engine.variant_get_type(opaque_)); }
  static String get_type_name(Type type);
  String stringify() const;

  void* _native_ptr() const { return opaque_; }

 private:
  void swap(Variant& other) noexcept;

  // sizeof(Variant) in the engine's single-precision builds for 64-bit processors.
  static constexpr std::size_t SIZE = 24;
  alignas(8) mutable std::uint8_t opaque_[SIZE];
};

template <class... Arguments>
void Callable::call_deferred(const Arguments&... arguments) const {
  const Variant values[] = {Variant(arguments)..., Variant()};
  call_deferred_with(values, sizeof...(Arguments));
}

}  // namespace godot
