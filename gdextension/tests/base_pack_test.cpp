#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/pack.h"
#include "statistics.h"

namespace lobelight {
namespace {

// |value − truth| in units of the last place of the double nearest to `unit`.
double ulps(double value, long double truth, long double unit) {
  const double nearest = static_cast<double>(std::abs(unit));
  const double ulp = std::nextafter(nearest, 1e308) - nearest;
  return static_cast<double>(std::abs(static_cast<long double>(value) - truth)) / ulp;
}

template <int Width>
std::array<double, 8> exp2_of(const std::array<double, 8>& x) {
  std::array<double, 8> result;
  for (std::size_t n = 0; n < 8; n += Width) {
    Pack<Width> pack[1] = {load<Width>(&x[n])};
    exp2_nonpositive<Width, 1>(pack);
    store<Width>(pack[0], &result[n]);
  }
  return result;
}

template <int Width>
std::array<std::array<double, 8>, 2> log2_and_reciprocal_of(const std::array<double, 8>& x) {
  std::array<std::array<double, 8>, 2> result;
  for (std::size_t n = 0; n < 8; n += Width) {
    Pack<Width> logarithm, reciprocal;
    log2_and_reciprocal<Width>(load<Width>(&x[n]), logarithm, reciprocal);
    store<Width>(logarithm, &result[0][n]);
    store<Width>(reciprocal, &result[1][n]);
  }
  return result;
}

TEST_CASE("exp2_nonpositive is within 3 ulp of the long double exponential at every width") {
  testing::Uniform uniform(1);
  double worst = 0.0;
  for (int n = 0; n < 40000; ++n) {
    std::array<double, 8> x;
    for (double& value : x) {
      const double u = uniform.next();
      // Down to −1000, close to 0, and ties of the rounding to an integer.
      value = n % 3 == 0   ? -1000.0 * u
              : n % 3 == 1 ? -std::exp2(-60.0 * u)
                           : -std::floor(999.0 * u) - 0.5;
    }
    const auto result = exp2_of<2>(x);
    for (std::size_t i = 0; i < 8; ++i) {
      const long double truth = std::exp2(static_cast<long double>(x[i]));
      worst = std::max(worst, ulps(result[i], truth, truth));
    }
    REQUIRE(exp2_of<4>(x) == result);
    REQUIRE(exp2_of<8>(x) == result);
  }
  CHECK(worst < 3.0);
  CHECK(exp2_of<2>({0.0, -0.0, -1.0, -2.0, -10.0, -100.0, -1000.0, 0.0}) ==
        std::array<double, 8>{1.0, 1.0, 0.5, 0.25, std::ldexp(1.0, -10), std::ldexp(1.0, -100),
                              std::ldexp(1.0, -1000), 1.0});
}

TEST_CASE("log2_and_reciprocal is within 2 ulp of long double arithmetic at every width") {
  testing::Uniform uniform(2);
  double worst_logarithm = 0.0;
  double worst_reciprocal = 0.0;
  for (int n = 0; n < 40000; ++n) {
    std::array<double, 8> x;
    for (double& value : x) {
      const double u = uniform.next();
      value = n % 2 == 0 ? 1.0 + std::exp2(-52.0 * u) : std::exp2(1000.0 * u);
    }
    const auto result = log2_and_reciprocal_of<2>(x);
    for (std::size_t i = 0; i < 8; ++i) {
      const long double logarithm = std::log2(static_cast<long double>(x[i]));
      const long double reciprocal = 1.0L / static_cast<long double>(x[i]);
      worst_logarithm =
          std::max(worst_logarithm, ulps(result[0][i], logarithm, std::max(1.0L, logarithm)));
      worst_reciprocal = std::max(worst_reciprocal, ulps(result[1][i], reciprocal, reciprocal));
    }
    REQUIRE(log2_and_reciprocal_of<4>(x) == result);
    REQUIRE(log2_and_reciprocal_of<8>(x) == result);
  }
  CHECK(worst_logarithm < 2.0);
  CHECK(worst_reciprocal < 2.0);
  CHECK(log2_and_reciprocal_of<8>({1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0})[0][0] == 0.0);
}

}  // namespace
}  // namespace lobelight
