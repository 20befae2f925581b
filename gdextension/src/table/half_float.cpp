#include "table/half_float.h"

#include <cmath>
#include <limits>

namespace lobelight {

std::uint16_t half_from_double(double value) {
  const auto sign = static_cast<unsigned>(std::signbit(value) ? 0x8000 : 0);
  const double magnitude = std::abs(value);
  unsigned bits = 0;
  if (std::isnan(value)) {
    bits = 0x7e00;
  } else if (magnitude >= 65520.0) {  // half-way to the number after the largest, 65504
    bits = 0x7c00;
  } else if (magnitude < 0x1p-14) {
    // Subnormal: multiples of 2^-24. Rounding up to 2^-14 carries into the exponent by itself.
    bits = static_cast<unsigned>(std::nearbyint(magnitude * 0x1p24));
  } else {
    // Significand as an integer from 1024 to 2048; 2048 carries into the exponent likewise.
    const int exponent = std::ilogb(magnitude);
    const auto significand =
        static_cast<unsigned>(std::nearbyint(std::ldexp(magnitude, 10 - exponent)));
    bits = (static_cast<unsigned>(exponent + 14) << 10) + significand;
  }
  return static_cast<std::uint16_t>(sign | bits);
}

double double_from_half(std::uint16_t half) {
  const int exponent = (half >> 10) & 0x1f;
  const int fraction = half & 0x3ff;
  double magnitude = 0.0;
  if (exponent == 0x1f) {
    magnitude = fraction == 0 ? std::numeric_limits<double>::infinity()
                              : std::numeric_limits<double>::quiet_NaN();
  } else if (exponent == 0) {
    magnitude = std::ldexp(fraction, -24);
  } else {
    magnitude = std::ldexp(1024 + fraction, exponent - 25);
  }
  return (half & 0x8000) != 0 ? -magnitude : magnitude;
}

}  // namespace lobelight
