#include "brdf/brdf.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/pi.h"
#include "brdf_oracle.h"
#include "models.h"
#include "statistics.h"

namespace lobelight {
namespace {

constexpr glm::dvec2 kAlphas[] = {{0.3, 0.3}, {0.15, 0.4}, {0.01, 0.2}, {1.0, 0.05}};

glm::dvec3 view(double elevation_degrees, double azimuth_degrees) {
  const double e = elevation_degrees * kPi / 180.0;
  const double a = azimuth_degrees * kPi / 180.0;
  return {std::sin(e) * std::cos(a), std::sin(e) * std::sin(a), std::cos(e)};
}

TEST_CASE("Every BRDF is reciprocal, positive and its own mirror image") {
  testing::Uniform uniform(1);
  for (const std::string& name : brdf_names()) {
    for (const glm::dvec2& alpha : kAlphas) {
      CAPTURE(name);
      const auto brdf = testing::model(name, alpha);
      for (int n = 0; n < 300; ++n) {
        const glm::dvec3 i = uniform.direction_above();
        const glm::dvec3 o = uniform.direction_above();
        const double value = brdf->evaluate(i, o);
        CHECK(value >= 0.0);
        CHECK(std::isfinite(value));
        // Products far below the smallest normal number lose bits differently on the two sides.
        if (value < 1e-290) continue;
        CHECK(brdf->evaluate(o, i) == doctest::Approx(value).epsilon(1e-11));
        const auto mirrored = [&](const glm::dvec3& s) { return brdf->evaluate(s * i, s * o); };
        CHECK(mirrored({-1.0, 1.0, 1.0}) == doctest::Approx(value).epsilon(1e-12));
        CHECK(mirrored({1.0, -1.0, 1.0}) == doctest::Approx(value).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("Turning the material by 90 degrees swaps the widths") {
  testing::Uniform uniform(2);
  const auto turned = [](const glm::dvec3& v) { return glm::dvec3(-v.y, v.x, v.z); };
  for (const std::string& name : brdf_names()) {
    if (is_always_isotropic(name)) continue;
    const auto a = make_brdf(name, {0.15, 0.4});
    const auto b = make_brdf(name, {0.4, 0.15});
    for (int n = 0; n < 100; ++n) {
      const glm::dvec3 i = uniform.direction_above();
      const glm::dvec3 o = uniform.direction_above();
      CHECK(b->evaluate(turned(i), turned(o)) == doctest::Approx(a->evaluate(i, o)).epsilon(1e-11));
    }
  }
}

TEST_CASE("Nothing is reflected at or below the horizon") {
  const glm::dvec3 up = view(30.0, 20.0);
  for (const std::string& name : brdf_names()) {
    const auto brdf = testing::model(name, {0.3, 0.2});
    for (const glm::dvec3& down : {glm::dvec3(1.0, 0.0, 0.0), view(100.0, 50.0), -up}) {
      CHECK(brdf->evaluate(down, up) == 0.0);
      CHECK(brdf->evaluate(up, down) == 0.0);
      CHECK(brdf->pdf(down, up) == 0.0);
      CHECK(brdf->pdf(up, down) == 0.0);
      CHECK_FALSE(brdf->sample(down, {0.4, 0.4}).has_value());
    }
  }
}

TEST_CASE("A sample agrees with evaluate() and pdf()") {
  testing::Uniform uniform(3);
  for (const std::string& name : brdf_names()) {
    for (const glm::dvec2& alpha : kAlphas) {
      CAPTURE(name);
      const auto brdf = testing::model(name, alpha);
      int refused = 0;
      for (int n = 0; n < 2000; ++n) {
        const glm::dvec3 o = uniform.direction_above();
        const auto s = brdf->sample(o, uniform.next2());
        if (!s) {
          ++refused;
          continue;
        }
        CHECK(std::abs(glm::length(s->direction) - 1.0) < 1e-14);
        CHECK(s->direction.z > 0.0);
        CHECK(s->pdf > 0.0);
        CHECK(brdf->pdf(s->direction, o) == doctest::Approx(s->pdf).epsilon(1e-6));
        const double weight = brdf->evaluate(s->direction, o) * s->direction.z / s->pdf;
        CHECK(s->weight == doctest::Approx(weight).epsilon(1e-6));
      }
      CHECK(refused < 1500);
    }
  }
}

TEST_CASE("Samples are distributed as pdf() says, refused ones included") {
  const glm::dvec3 views[] = {view(0.0, 0.0), view(50.0, 30.0), view(80.0, 110.0)};
  constexpr glm::dvec2 kTested[] = {{0.3, 0.3}, {0.25, 0.6}};
  testing::SphereTest test;
  test.samples = 200000;
  test.subdivisions = 16;
  test.lowest_z = 0.0;
  const double threshold = testing::significance(2 * 3 * static_cast<int>(brdf_names().size()));
  for (const std::string& name : brdf_names()) {
    for (const glm::dvec2& alpha : kTested) {
      const auto brdf = testing::model(name, alpha);
      for (const glm::dvec3& o : views) {
        CAPTURE(name);
        CAPTURE(o.z);
        ++test.seed;
        const double p =
            testing::sampler_p_value([&](const glm::dvec3& i) { return brdf->pdf(i, o); },
                                     [&](const glm::dvec2& u) -> std::optional<glm::dvec3> {
                                       const auto s = brdf->sample(o, u);
                                       if (!s) return std::nullopt;
                                       return s->direction;
                                     },
                                     test);
        CHECK(p > threshold);
      }
    }
  }
}

TEST_CASE("The density of samples integrates to at most one") {
  for (const std::string& name : brdf_names()) {
    const auto brdf = testing::model(name, {0.25, 0.5});
    for (const double elevation : {0.0, 45.0, 85.0}) {
      const glm::dvec3 o = view(elevation, 40.0);
      constexpr int kCells = 600;
      double sum = 0.0;
      for (int r = 0; r < kCells; ++r) {
        for (int c = 0; c < kCells; ++c) {
          const double z = (r + 0.5) / kCells;
          const double azimuth = 2.0 * kPi * (c + 0.5) / kCells;
          const double s = std::sqrt(1.0 - z * z);
          sum += brdf->pdf({s * std::cos(azimuth), s * std::sin(azimuth), z}, o);
        }
      }
      sum *= 2.0 * kPi / (kCells * kCells);
      CAPTURE(name);
      CHECK(sum <= 1.0 + 1e-4);
      CHECK(sum > 0.4);
    }
  }
}

TEST_CASE("Sampled albedos agree with SciPy's quadrature") {
  for (const auto& [name, alpha_x, alpha_y, elevation, azimuth, albedo] : oracle::kAlbedos) {
    const auto brdf = make_brdf(name, {alpha_x, alpha_y});
    const glm::dvec3 o = view(elevation, azimuth);
    constexpr int kCells = 400;
    double sum = 0.0;
    for (int r = 0; r < kCells; ++r) {
      for (int c = 0; c < kCells; ++c) {
        const auto s = brdf->sample(o, {(r + 0.5) / kCells, (c + 0.5) / kCells});
        if (s) sum += s->weight;
      }
    }
    CAPTURE(name);
    CAPTURE(alpha_x);
    CAPTURE(elevation);
    CHECK(sum / (kCells * kCells) == doctest::Approx(albedo).epsilon(3e-4));
  }
}

TEST_CASE("Names and widths are refused by a sentence that names them") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const std::string& name : brdf_names()) {
    CHECK(make_brdf(name, {0.2, 0.2})->name() == name);
    CHECK(make_brdf(name, {0.2, 0.2})->alpha() == glm::dvec2(0.2, 0.2));
    if (is_always_isotropic(name)) continue;
    CHECK(make_brdf(name, {0.1, 0.2})->alpha() == glm::dvec2(0.1, 0.2));
  }
  CHECK_THROWS_WITH_AS(
      make_brdf("phong", {0.1, 0.1}),
      R"(brdf is "phong", which is not known; known are "ward", "ward_bounded", "ggx", "charlie", and files of measurements (.binary, .bsdf).)",
      std::invalid_argument);
  CHECK_THROWS_WITH_AS(make_brdf("ward", {0.1, -0.25}),
                       "alpha is (0.1, -0.25), but both widths must be between 0.0001 and 2.",
                       std::invalid_argument);
  for (const glm::dvec2& bad : {glm::dvec2(0.1, 0.2), glm::dvec2(1.5, 1.5)}) {
    CHECK_THROWS_AS(make_brdf("charlie", bad), std::invalid_argument);
  }
  for (const double bad : {0.0, -1.0, 9e-5, 2.1, nan, infinity}) {
    CHECK_THROWS_AS(make_brdf("ggx", {bad, 0.1}), std::invalid_argument);
    CHECK_THROWS_AS(make_brdf("ggx", {0.1, bad}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace lobelight
