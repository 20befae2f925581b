#include <doctest/doctest.h>

#include <cmath>

#include "statistics.h"
#include "table/half_vector.h"

namespace lobelight {
namespace {

TEST_CASE("Half-vector form is inverted exactly") {
  testing::Uniform uniform(1);
  for (int n = 0; n < 500; ++n) {
    const glm::dvec3 o = uniform.direction_above();
    const SphericalGaussian gaussian{uniform.direction_above(), 1000.0 * uniform.next()};
    const SphericalGaussian back = from_half_vector(to_half_vector(gaussian, o), o);
    CHECK(glm::length(back.mean - gaussian.mean) < 1e-9);
    CHECK(back.kappa == doctest::Approx(gaussian.kappa).epsilon(1e-9));
  }
}

TEST_CASE("The mirror direction has zero slope, and slopes are tangents of the tilt") {
  const glm::dvec3 o(0.6, 0.0, 0.8);
  const HalfVectorLobe mirror = to_half_vector({{-0.6, 0.0, 0.8}, 10.0}, o);
  CHECK(glm::length(mirror.slope) < 1e-15);
  CHECK(mirror.sharpness == doctest::Approx(8.0));
  // A facet tilted by t towards x takes the view straight above to 2t.
  const double t = 0.2;
  const HalfVectorLobe tilted =
      to_half_vector({{std::sin(2.0 * t), 0.0, std::cos(2.0 * t)}, 1.0}, {0.0, 0.0, 1.0});
  CHECK(tilted.slope.x == doctest::Approx(std::tan(t)));
  CHECK(tilted.slope.y == 0.0);
}

TEST_CASE("A lobe carried to another view mirrors that view at the same facet") {
  testing::Uniform uniform(2);
  for (int n = 0; n < 100; ++n) {
    const HalfVectorLobe lobe{{0.4 * uniform.next() - 0.2, 0.4 * uniform.next() - 0.2}, 5.0};
    const glm::dvec3 o = uniform.direction_above();
    const SphericalGaussian gaussian = from_half_vector(lobe, o);
    const glm::dvec3 h = glm::normalize(glm::dvec3(lobe.slope, 1.0));
    CHECK(glm::length(gaussian.mean) == doctest::Approx(1.0));
    if (glm::dot(o, h) > 1e-4) CHECK(glm::dot(gaussian.mean, h) == doctest::Approx(glm::dot(o, h)));
    CHECK(std::isfinite(gaussian.kappa));
    CHECK(gaussian.kappa > 0.0);
  }
}

TEST_CASE(
    "Half-vectors that are turned away from the view give lobes that light cannot come from") {
  // Interpolation between distant views can make these. The shader's formulas, on purpose.
  for (const double slope : {-1.0, -50.0, -1e4}) {
    const glm::dvec3 o = glm::normalize(glm::dvec3(1.0, 0.0, 0.0105));
    const glm::dvec3 h = glm::normalize(glm::dvec3(slope, 0.0, 1.0));
    REQUIRE(glm::dot(o, h) < 0.0);
    const SphericalGaussian gaussian = from_half_vector({{slope, 0.0}, 3.0}, o);
    CHECK(glm::length(gaussian.mean) == doctest::Approx(1.0));
    CHECK(glm::length(gaussian.mean - glm::normalize(2e-4 * h - o)) < 1e-12);
    CHECK(gaussian.kappa == doctest::Approx(3e4));
  }
}

TEST_CASE("kappa (o·h) does not change when only the view does") {
  // The same facets seen from two views: the spread of their mirror directions is 1/κ per axis in
  // geometric mean, so κ (o·h) must agree.
  const auto spread = [](const glm::dvec3& o) {
    const double step = 1e-4;
    const auto mirrored = [&](double x, double y) {
      const glm::dvec3 h = glm::normalize(glm::dvec3(x, y, 1.0));
      return 2.0 * glm::dot(o, h) * h - o;
    };
    const glm::dvec3 dx = (mirrored(step, 0.0) - mirrored(-step, 0.0)) / (2.0 * step);
    const glm::dvec3 dy = (mirrored(0.0, step) - mirrored(0.0, -step)) / (2.0 * step);
    return glm::length(glm::cross(dx, dy));  // solid angle per area of slopes
  };
  const glm::dvec3 steep(0.8, 0.0, 0.6);
  CHECK(spread(steep) / steep.z == doctest::Approx(spread({0.0, 0.0, 1.0})).epsilon(1e-6));
}

}  // namespace
}  // namespace lobelight
