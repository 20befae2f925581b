#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "table/half_float.h"

namespace lobelight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST_CASE("All 65536 half floats come back from double") {
  for (unsigned bits = 0; bits < 65536; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    const double value = double_from_half(half);
    const bool is_nan = (bits & 0x7c00) == 0x7c00 && (bits & 0x3ff) != 0;
    CHECK(std::isnan(value) == is_nan);
    if (is_nan) {
      CHECK((half_from_double(value) & 0x7fff) == 0x7e00);
    } else {
      CHECK(half_from_double(value) == half);
    }
  }
}

TEST_CASE("Half floats have the values of IEEE 754") {
  CHECK(double_from_half(0x3c00) == 1.0);
  CHECK(double_from_half(0xc000) == -2.0);
  CHECK(double_from_half(0x7bff) == 65504.0);
  CHECK(double_from_half(0x0400) == 0x1p-14);
  CHECK(double_from_half(0x0001) == 0x1p-24);
  CHECK(double_from_half(0x3555) == 0.333251953125);
  CHECK(double_from_half(0x7c00) == kInfinity);
  CHECK(std::signbit(double_from_half(0x8000)));
}

TEST_CASE("Numbers between two half floats go to the nearer, ties to the even one") {
  for (unsigned bits = 0; bits < 0x7bff; ++bits) {
    const double low = double_from_half(static_cast<std::uint16_t>(bits));
    const double high = double_from_half(static_cast<std::uint16_t>(bits + 1));
    const double middle = 0.5 * (low + high);
    const unsigned even = bits % 2 == 0 ? bits : bits + 1;
    CHECK(high > low);
    CHECK(half_from_double(middle) == even);
    CHECK(half_from_double(std::nextafter(middle, 0.0)) == bits);
    CHECK(half_from_double(std::nextafter(middle, kInfinity)) == bits + 1);
    CHECK(half_from_double(-middle) == (0x8000 | even));
  }
  CHECK(half_from_double(std::nextafter(65520.0, 0.0)) == 0x7bff);
  CHECK(half_from_double(65520.0) == 0x7c00);
  CHECK(half_from_double(-1e300) == 0xfc00);
  CHECK(half_from_double(kInfinity) == 0x7c00);
  CHECK(half_from_double(1e-300) == 0);
  CHECK(half_from_double(-0.0) == 0x8000);
}

}  // namespace
}  // namespace lobelight
