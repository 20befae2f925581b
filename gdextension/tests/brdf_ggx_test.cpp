#include <doctest/doctest.h>

#include <cmath>

#include "base/pi.h"
#include "brdf/ggx.h"
#include "fit/slice.h"
#include "statistics.h"

namespace lobelight {
namespace {

constexpr glm::dvec2 kAlphas[] = {{0.1, 0.1}, {0.2, 0.7}, {1.0, 0.3}};

// ∫ f(h) dω over the upper hemisphere of normals, in polar coordinates of slope/α with the radius
// as tan t: smooth for GGX, whose slopes reach to infinity.
template <typename F>
double integrate_normals(const glm::dvec2& alpha, F f) {
  constexpr int kCells = 800;
  double sum = 0.0;
  for (int a = 0; a < kCells; ++a) {
    const double t = 0.5 * kPi * (a + 0.5) / kCells;
    for (int b = 0; b < kCells; ++b) {
      const double phi = 2.0 * kPi * (b + 0.5) / kCells;
      const double radius = std::tan(t);
      const glm::dvec3 h = glm::normalize(
          glm::dvec3(alpha.x * radius * std::cos(phi), alpha.y * radius * std::sin(phi), 1.0));
      sum += f(h) * h.z * h.z * h.z * alpha.x * alpha.y * radius / (std::cos(t) * std::cos(t));
    }
  }
  return sum * 0.5 * kPi * 2.0 * kPi / (kCells * kCells);
}

TEST_CASE("The projected area of all normals is one") {
  for (const glm::dvec2& alpha : kAlphas) {
    const double area = integrate_normals(
        alpha, [&](const glm::dvec3& h) { return ggx_normal_density(h, alpha) * h.z; });
    CHECK(area == doctest::Approx(1.0).epsilon(1e-5));
  }
}

TEST_CASE("Smith's G1 is the share of the projected area that is visible") {
  // ∫ G1(o) D(h) max(0, o·h) dh = o_z (Heitz 2014, eq. 15). Divided by o_z this is the weak white
  // furnace: ∫ D(h) G1(o) / (4 o_z) di over the whole sphere of reflected directions is exactly 1.
  for (const glm::dvec2& alpha : kAlphas) {
    for (const double elevation : {0.0, 0.6, 1.2, 1.5}) {
      const glm::dvec3 o(std::sin(elevation) * 0.6, std::sin(elevation) * 0.8, std::cos(elevation));
      const double g1 = 1.0 / (1.0 + ggx_lambda(o, alpha));
      const double furnace = integrate_normals(alpha, [&](const glm::dvec3& h) {
        return g1 * ggx_normal_density(h, alpha) * std::max(0.0, glm::dot(o, h)) / o.z;
      });
      CAPTURE(alpha.x);
      CAPTURE(elevation);
      CHECK(furnace == doctest::Approx(1.0).epsilon(1e-4));
    }
  }
}

TEST_CASE("GGX has the value that its equation gives by hand at normal incidence") {
  const Ggx ggx({0.1, 0.2});
  CHECK(ggx.evaluate({0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}) ==
        doctest::Approx(1.0 / (4.0 * kPi * 0.1 * 0.2)));
  // Isotropic Λ in terms of the angle: (√(1 + α² tan²θ) − 1)/2.
  const double theta = 1.1;
  CHECK(ggx_lambda({std::sin(theta), 0.0, std::cos(theta)}, {0.3, 0.3}) ==
        doctest::Approx(0.5 * (std::sqrt(1.0 + 0.09 * std::pow(std::tan(theta), 2)) - 1.0)));
}

TEST_CASE("GGX never reflects more than it receives") {
  for (const glm::dvec2& alpha :
       {glm::dvec2(0.01, 0.01), glm::dvec2(0.1, 0.5), glm::dvec2(1.0, 1.0)}) {
    const Ggx ggx(alpha);
    for (double elevation = 0.0; elevation < 1.57; elevation += 0.05) {
      for (const double azimuth : {0.0, 0.8, 1.57}) {
        const glm::dvec3 o(std::sin(elevation) * std::cos(azimuth),
                           std::sin(elevation) * std::sin(azimuth), std::cos(elevation));
        const double albedo = sample_slice(ggx, o).albedo;
        CHECK(albedo <= 1.0 + 1e-12);
        CHECK(albedo > 0.3);
      }
    }
  }
}

}  // namespace
}  // namespace lobelight
