#pragma once

#include <cstdint>
#include <godot_cpp/variant/variant.hpp>

namespace godot {

enum PropertyHint { PROPERTY_HINT_NONE = 0 };

enum PropertyUsageFlags : std::uint32_t {
  PROPERTY_USAGE_DEFAULT = 6,
  PROPERTY_USAGE_NIL_IS_VARIANT = 131072,
};

// Name and type of an argument, a return value or a signal's argument.
struct PropertyInfo {
  Variant::Type type = Variant::NIL;
  StringName name;
  StringName class_name;
  std::uint32_t hint = PROPERTY_HINT_NONE;
  String hint_string;
  std::uint32_t usage = PROPERTY_USAGE_DEFAULT;

  PropertyInfo() = default;
  PropertyInfo(Variant::Type value_type, const StringName& value_name,
               PropertyHint value_hint = PROPERTY_HINT_NONE, const String& value_hint_string = "",
               std::uint32_t value_usage = PROPERTY_USAGE_DEFAULT)
      : type(value_type),
        name(value_name),
        hint(value_hint),
        hint_string(value_hint_string),
        usage(value_usage) {}

  // Points into this object.
  GDExtensionPropertyInfo _to_gdextension() const {
    return {static_cast<GDExtensionVariantType>(type),
            name._native_ptr(),
            class_name._native_ptr(),
            hint,
            hint_string._native_ptr(),
            usage};
  }
};

}  // namespace godot
