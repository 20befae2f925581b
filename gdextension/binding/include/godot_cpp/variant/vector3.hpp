#pragma once

#include <gdextension_interface.h>

#include <godot_cpp/core/math_defs.hpp>

namespace godot {

struct Vector3 {
  static constexpr GDExtensionVariantType VARIANT_TYPE = GDEXTENSION_VARIANT_TYPE_VECTOR3;

  real_t x = 0;
  real_t y = 0;
  real_t z = 0;

  constexpr Vector3() = default;
  constexpr Vector3(real_t x_value, real_t y_value, real_t z_value)
      : x(x_value), y(y_value), z(z_value) {}
};

}  // namespace godot
