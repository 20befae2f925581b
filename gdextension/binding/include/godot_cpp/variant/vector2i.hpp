#pragma once

#include <gdextension_interface.h>

#include <cstdint>

namespace godot {

struct Vector2i {
  static constexpr GDExtensionVariantType VARIANT_TYPE = GDEXTENSION_VARIANT_TYPE_VECTOR2I;

  std::int32_t x = 0;
  std::int32_t y = 0;

  constexpr Vector2i() = default;
  constexpr Vector2i(std::int32_t x_value, std::int32_t y_value) : x(x_value), y(y_value) {}
};

}  // namespace godot
