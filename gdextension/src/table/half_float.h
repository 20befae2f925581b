#pragma once

#include <cstdint>

namespace lobelight {

// IEEE 754 binary16. Rounds to the nearest, ties to even; overflow gives infinity, underflow
// subnormals and signed zeros; every NaN becomes the quiet NaN 0x7e00 or 0xfe00.
std::uint16_t half_from_double(double value);

// Exact.
double double_from_half(std::uint16_t half);

}  // namespace lobelight
