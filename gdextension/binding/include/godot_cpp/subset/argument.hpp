// How a C++ type travels through the engine's two calling conventions: as a Variant, and as a
// pointer to the engine's own representation.
#pragma once

#include <cstdint>
#include <godot_cpp/core/property_info.hpp>
#include <type_traits>

namespace godot::subset {

// Conversions for T without reference and const:
//   TYPE, METADATA               what the engine is told about it
//   from_variant, from_pointer   reading an argument
//   to_pointer                   writing a return value (any T converts to Variant by itself)
template <class T, class = void>
struct Argument;

// Types that look alike on both sides.
template <class T>
struct Argument<T, std::void_t<decltype(T::VARIANT_TYPE)>> {
  static constexpr GDExtensionVariantType TYPE = T::VARIANT_TYPE;
  static constexpr auto METADATA = GDEXTENSION_METHOD_ARGUMENT_METADATA_NONE;

  static T from_variant(const Variant& value) { return value; }
  static const T& from_pointer(const void* pointer) { return *static_cast<const T*>(pointer); }
  static void to_pointer(const T& value, void* pointer) { *static_cast<T*>(pointer) = value; }
};

template <>
struct Argument<Variant> {
  static constexpr GDExtensionVariantType TYPE = GDEXTENSION_VARIANT_TYPE_NIL;
  static constexpr auto METADATA = GDEXTENSION_METHOD_ARGUMENT_METADATA_NONE;

  static const Variant& from_variant(const Variant& value) { return value; }
  static const Variant& from_pointer(const void* pointer) {
    return *static_cast<const Variant*>(pointer);
  }
  static void to_pointer(const Variant& value, void* pointer) {
    *static_cast<Variant*>(pointer) = value;
  }
};

// Numbers: the engine passes every one of a kind as its widest.
template <class T, class Engine, GDExtensionVariantType VARIANT_TYPE,
          GDExtensionClassMethodArgumentMetadata ARGUMENT_METADATA>
struct NumberArgument {
  static constexpr GDExtensionVariantType TYPE = VARIANT_TYPE;
  static constexpr auto METADATA = ARGUMENT_METADATA;

  static T from_variant(const Variant& value) { return value; }
  static T from_pointer(const void* pointer) {
    return static_cast<T>(*static_cast<const Engine*>(pointer));
  }
  static void to_pointer(T value, void* pointer) {
    *static_cast<Engine*>(pointer) = static_cast<Engine>(value);
  }
};

template <>
struct Argument<bool> : NumberArgument<bool, GDExtensionBool, GDEXTENSION_VARIANT_TYPE_BOOL,
                                       GDEXTENSION_METHOD_ARGUMENT_METADATA_NONE> {};
template <>
struct Argument<std::int32_t>
    : NumberArgument<std::int32_t, std::int64_t, GDEXTENSION_VARIANT_TYPE_INT,
                     GDEXTENSION_METHOD_ARGUMENT_METADATA_INT_IS_INT32> {};
template <>
struct Argument<std::int64_t>
    : NumberArgument<std::int64_t, std::int64_t, GDEXTENSION_VARIANT_TYPE_INT,
                     GDEXTENSION_METHOD_ARGUMENT_METADATA_INT_IS_INT64> {};
template <>
struct Argument<double> : NumberArgument<double, double, GDEXTENSION_VARIANT_TYPE_FLOAT,
                                         GDEXTENSION_METHOD_ARGUMENT_METADATA_REAL_IS_DOUBLE> {};

template <class T>
using ArgumentFor = Argument<std::remove_cv_t<std::remove_reference_t<T>>>;

template <class T>
PropertyInfo argument_info(const StringName& name) {
  using Kind = ArgumentFor<T>;
  const bool is_variant = Kind::TYPE == GDEXTENSION_VARIANT_TYPE_NIL;
  return PropertyInfo(static_cast<Variant::Type>(Kind::TYPE), name, PROPERTY_HINT_NONE, "",
                      PROPERTY_USAGE_DEFAULT | (is_variant ? PROPERTY_USAGE_NIL_IS_VARIANT : 0u));
}

}  // namespace godot::subset
