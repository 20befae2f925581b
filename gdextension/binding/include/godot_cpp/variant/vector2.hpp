#pragma once

#include <gdextension_interface.h>

#include <godot_cpp/core/math_defs.hpp>

namespace godot {

struct Vector2 {
  static constexpr GDExtensionVariantType VARIANT_TYPE = GDEXTENSION_VARIANT_TYPE_VECTOR2;

  real_t x = 0;
  real_t y = 0;

  constexpr Vector2() = default;
  constexpr Vector2(real_t x_value, real_t y_value) : x(x_value), y(y_value) {}
};

}  // namespace godot
