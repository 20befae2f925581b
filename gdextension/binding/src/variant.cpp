#include <cstring>
#include <godot_cpp/variant/variant.hpp>

namespace godot {

namespace {

using subset::engine;

// The engine's conversions between Variant and one type.
template <GDExtensionVariantType TYPE>
void write_variant(void* variant, const void* value) {
  engine.types[TYPE].to_variant(variant, const_cast<void*>(value));
}

// `T` is the engine's representation of the type.
template <GDExtensionVariantType TYPE, class T>
T read_variant(void* variant) {
  T value{};
  if (engine.variant_can_convert_strict(engine.variant_get_type(variant), TYPE) == 0) return value;
  // It constructs the value in place: what stands there has to go first.
  value.~T();
  engine.types[TYPE].from_variant(&value, variant);
  return value;
}

}  // namespace

void Variant::swap(Variant& other) noexcept {
  std::uint8_t bytes[SIZE];
  std::memcpy(bytes, opaque_, SIZE);
  std::memcpy(opaque_, other.opaque_, SIZE);
  std::memcpy(other.opaque_, bytes, SIZE);
}

Variant::Variant(bool value) {
  const GDExtensionBool wide = value;
  write_variant<GDEXTENSION_VARIANT_TYPE_BOOL>(opaque_, &wide);
}
Variant::Variant(std::int64_t value) {
  write_variant<GDEXTENSION_VARIANT_TYPE_INT>(opaque_, &value);
}
Variant::Variant(double value) { write_variant<GDEXTENSION_VARIANT_TYPE_FLOAT>(opaque_, &value); }

Variant::operator bool() const {
  return read_variant<GDEXTENSION_VARIANT_TYPE_BOOL, GDExtensionBool>(opaque_) != 0;
}
Variant::operator std::int64_t() const {
  return read_variant<GDEXTENSION_VARIANT_TYPE_INT, std::int64_t>(opaque_);
}
Variant::operator std::int32_t() const {
  return static_cast<std::int32_t>(operator std::int64_t());
}
Variant::operator std::uint64_t() const {
  return static_cast<std::uint64_t>(operator std::int64_t());
}
Variant::operator std::uint32_t() const {
  return static_cast<std::uint32_t>(operator std::int64_t());
}
Variant::operator double() const {
  return read_variant<GDEXTENSION_VARIANT_TYPE_FLOAT, double>(opaque_);
}
Variant::operator float() const { return static_cast<float>(operator double()); }

// The types that have a class of their own here, which says what they are to the engine.
#define GODOT_SUBSET_CONVERSIONS(type)                                                        \
  Variant::Variant(const type& value) { write_variant<type::VARIANT_TYPE>(opaque_, &value); } \
  Variant::operator type() const { return read_variant<type::VARIANT_TYPE, type>(opaque_); }
GODOT_SUBSET_CONVERSIONS(String)
GODOT_SUBSET_CONVERSIONS(StringName)
GODOT_SUBSET_CONVERSIONS(Vector2)
GODOT_SUBSET_CONVERSIONS(Vector2i)
GODOT_SUBSET_CONVERSIONS(Vector3)
GODOT_SUBSET_CONVERSIONS(Dictionary)
GODOT_SUBSET_CONVERSIONS(Array)
GODOT_SUBSET_CONVERSIONS(PackedByteArray)
GODOT_SUBSET_CONVERSIONS(PackedInt32Array)
GODOT_SUBSET_CONVERSIONS(PackedFloat32Array)
#undef GODOT_SUBSET_CONVERSIONS

String Variant::get_type_name(Type type) {
  String name;
  engine.variant_get_type_name(static_cast<GDExtensionVariantType>(type), name._native_ptr());
  return name;
}

String Variant::stringify() const {
  String text;
  engine.variant_stringify(opaque_, text._native_ptr());
  return text;
}

}  // namespace godot
