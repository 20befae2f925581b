#include <doctest/doctest.h>

#include <cmath>

#include "base/vector_math.h"
#include "statistics.h"

namespace lobelight {
namespace {

// |value − truth| in units of the last place of the double nearest to truth.
double ulps(double value, long double truth) {
  const double nearest = static_cast<double>(truth);
  const double ulp = std::nextafter(std::abs(nearest), 1e308) - std::abs(nearest);
  return static_cast<double>(std::abs(static_cast<long double>(value) - truth)) / ulp;
}

TEST_CASE("exp_nonpositive is within 2 ulp of the long double exponential") {
  double worst = 0.0;
  testing::Uniform uniform(1);
  for (int n = 0; n < 300000; ++n) {
    // Half of the arguments down to −700, half of them close to 0.
    const double x = n % 2 == 0 ? -700.0 * uniform.next() : -std::exp2(-60.0 * uniform.next());
    worst = std::max(worst, ulps(exp_nonpositive(x), std::exp(static_cast<long double>(x))));
  }
  // Ties of the reduction to |r| ≤ ln 2 / 2.
  for (int n = 0; n < 1000; ++n) {
    const double x = -(n + 0.5) * std::log(2.0);
    worst = std::max(worst, ulps(exp_nonpositive(x), std::exp(static_cast<long double>(x))));
  }
  CHECK(worst < 2.0);
  CHECK(exp_nonpositive(0.0) == 1.0);
  CHECK(exp_nonpositive(-0.0) == 1.0);
}

TEST_CASE("log_of_at_least_one is within 2 ulp of the long double logarithm") {
  double worst = 0.0;
  testing::Uniform uniform(2);
  for (int n = 0; n < 300000; ++n) {
    const double x =
        n % 2 == 0 ? 1.0 + std::exp2(-52.0 * uniform.next()) : std::exp2(1023.0 * uniform.next());
    worst = std::max(worst, ulps(log_of_at_least_one(x), std::log(static_cast<long double>(x))));
  }
  CHECK(worst < 2.0);
  CHECK(log_of_at_least_one(1.0) == 0.0);
}

}  // namespace
}  // namespace lobelight
