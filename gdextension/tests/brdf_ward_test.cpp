#include <doctest/doctest.h>

#include <cmath>

#include "base/pi.h"
#include "brdf/ward.h"
#include "fit/slice.h"
#include "statistics.h"

namespace lobelight {
namespace {

TEST_CASE("Ward 1992 has the value that its paper's equation gives by hand") {
  // Normal incidence and view: h = n, the exponential is 1.
  const Ward ward({0.1, 0.2});
  CHECK(ward.evaluate({0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}) ==
        doctest::Approx(1.0 / (4.0 * kPi * 0.1 * 0.2)));
  // In the mirror direction at 60° too, with √(cos² 60°) = 1/2.
  const double s = std::sqrt(0.75);
  CHECK(ward.evaluate({s, 0.0, 0.5}, {-s, 0.0, 0.5}) ==
        doctest::Approx(2.0 / (4.0 * kPi * 0.1 * 0.2)));
  // Eq. 5a in angles: e^{−tan²δ (cos²φ/α_x² + sin²φ/α_y²)}.
  const double delta = 0.05;
  const double phi = 0.7;
  const glm::dvec3 h(std::sin(delta) * std::cos(phi), std::sin(delta) * std::sin(phi),
                     std::cos(delta));
  const glm::dvec3 o(0.0, 0.0, 1.0);
  const glm::dvec3 i = 2.0 * h.z * h - o;
  const double tangent = std::tan(delta);
  const double exponent =
      tangent * tangent * (std::pow(std::cos(phi) / 0.1, 2.0) + std::pow(std::sin(phi) / 0.2, 2.0));
  CHECK(ward.evaluate(i, o) ==
        doctest::Approx(std::exp(-exponent) / (4.0 * kPi * 0.1 * 0.2) / std::sqrt(i.z)));
}

TEST_CASE("Ward 1992's albedo diverges at grazing views, the bounded model's stays below one") {
  const Ward ward({0.05, 0.5});
  const WardBounded bounded({0.05, 0.5});
  const auto grazing = [](double degrees) {
    return glm::dvec3(0.0, std::sin(degrees * kPi / 180.0), std::cos(degrees * kPi / 180.0));
  };
  CHECK(sample_slice(ward, grazing(89.99)).albedo > 1.0);
  for (double degrees = 0.0; degrees < 90.0; degrees += 2.7) {
    CHECK(sample_slice(bounded, grazing(degrees)).albedo <= 1.0);
  }
  CHECK(sample_slice(bounded, grazing(89.99)).albedo <= 1.0);
}

TEST_CASE("The bounded model shares Ward's exponential") {
  testing::Uniform uniform(4);
  const Ward ward({0.3, 0.5});
  const WardBounded bounded({0.3, 0.5});
  for (int n = 0; n < 200; ++n) {
    const glm::dvec3 i = uniform.direction_above();
    const glm::dvec3 o = uniform.direction_above();
    const glm::dvec3 h = glm::normalize(i + o);
    const double ratio = std::sqrt(i.z * o.z) / (std::pow(glm::dot(o, h), 2) * std::pow(h.z, 4));
    CHECK(bounded.evaluate(i, o) == doctest::Approx(ward.evaluate(i, o) * ratio).epsilon(1e-9));
  }
}

}  // namespace
}  // namespace lobelight
