#include "statistics.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/pi.h"

namespace lobelight::testing {
namespace {

TEST_CASE("The chi-square tail has tabulated values") {
  // scipy.stats.chi2.sf
  CHECK(chi_square_tail(3.841458820694124, 1) == doctest::Approx(0.05).epsilon(1e-10));
  CHECK(chi_square_tail(18.307038053275146, 10) == doctest::Approx(0.05).epsilon(1e-10));
  CHECK(chi_square_tail(2.0, 10) == doctest::Approx(0.9963401531726563).epsilon(1e-10));
  CHECK(chi_square_tail(900.0, 800) == doctest::Approx(0.007774644192745909).epsilon(1e-10));
}

TEST_CASE("The sampler test accepts a true density and rejects a slightly wrong one") {
  const auto sampler = [](const glm::dvec2& u) -> std::optional<glm::dvec3> {
    const double z = 2.0 * u.x - 1.0;
    const double r = std::sqrt(1.0 - z * z);
    return glm::dvec3(r * std::cos(2.0 * kPi * u.y), r * std::sin(2.0 * kPi * u.y), z);
  };
  SphereTest test;
  test.subdivisions = 4;
  CHECK(sampler_p_value([](const glm::dvec3&) { return 0.25 / kPi; }, sampler, test) > 0.01);
  const auto tilted = [](const glm::dvec3& d) { return 0.25 / kPi * (1.0 + 0.1 * d.x); };
  CHECK(sampler_p_value(tilted, sampler, test) < 1e-6);
}

}  // namespace
}  // namespace lobelight::testing
