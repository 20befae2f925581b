#include <doctest/doctest.h>

#include <cmath>

#include "base/pi.h"
#include "sg/mixture.h"
#include "statistics.h"

namespace lobelight {
namespace {

TEST_CASE("A mixture is the weighted sum of its lobes") {
  testing::Uniform uniform(1);
  const Mixture mixture{{0.25, {uniform.direction(), 3.0}}, {0.5, {uniform.direction(), 0.0}}};
  for (int n = 0; n < 50; ++n) {
    const glm::dvec3 x = uniform.direction();
    CHECK(evaluate(mixture, x) ==
          doctest::Approx(0.25 * density(mixture[0].gaussian, x) + 0.5 * 0.25 / kPi));
  }
  CHECK(total_weight(mixture) == 0.75);
  CHECK(evaluate({}, {0.0, 0.0, 1.0}) == 0.0);
  CHECK(total_weight({}) == 0.0);
}

}  // namespace
}  // namespace lobelight
