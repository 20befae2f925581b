#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

#include "base/pi.h"
#include "reference/integrator.h"

namespace lobelight {
namespace {

// An oblique frame, so that a mixed-up axis shows.
SurfaceFrame oblique_frame() {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.5, 0.6));
  const glm::dvec3 tangent = glm::normalize(glm::cross(glm::dvec3(0, 1, 0.2), normal));
  return {tangent, glm::cross(normal, tangent), normal};
}

glm::dvec3 world(const glm::dvec3& v, const SurfaceFrame& frame) {
  return v.x * frame.tangent + v.y * frame.bitangent + v.z * frame.normal;
}

glm::dvec3 view_at(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// ∫ L(i) ρ(i, o) i_z di over the hemisphere by the midpoint rule in (cos θ, φ): nothing of the
// integrator's takes part. L is given in world space.
glm::dvec3 quadrature(const Brdf& brdf, const glm::dvec3& o, const SurfaceFrame& frame,
                      const std::function<glm::dvec3(const glm::dvec3&)>& light, int steps) {
  glm::dvec3 sum(0.0);
  for (int j = 0; j < steps; ++j) {
    const double z = (j + 0.5) / steps;
    const double radius = std::sqrt(1.0 - z * z);
    for (int k = 0; k < 2 * steps; ++k) {
      const double phi = kPi * (k + 0.5) / steps;
      const glm::dvec3 i(radius * std::cos(phi), radius * std::sin(phi), z);
      sum += brdf.evaluate(i, o) * z * light(world(i, frame));
    }
  }
  return sum * (kPi / (static_cast<double>(steps) * steps));
}

struct Material {
  const char* name;
  glm::dvec2 alpha;
};

TEST_CASE("Integrator: a constant environment gives the directional albedo") {
  const SurfaceFrame frame = oblique_frame();
  const Panorama constant{8, 4, std::vector<float>(96, 2.5f)};
  for (const Material& material : {Material{"ward", {0.2, 0.4}}, Material{"ward", {0.3, 0.3}},
                                   Material{"ggx", {0.3, 0.5}}, Material{"ggx", {0.7, 0.7}}}) {
    const auto brdf = make_brdf(material.name, material.alpha);
    for (const double theta : {0.1, 0.8, 1.3}) {
      INFO(material.name, " ", material.alpha.x, " theta ", theta);
      const glm::dvec3 o = view_at(theta, 0.7);
      const double albedo =
          quadrature(
              *brdf, o, frame, [](const glm::dvec3&) { return glm::dvec3(1.0); }, 500)
              .x;
      const Integrator integrator(constant, *brdf, 1 << 14);
      const RadianceEstimate estimate = integrator.integrate(world(o, frame), frame, 1);
      for (int c = 0; c < 3; ++c) {
        CHECK(estimate.radiance[c] == doctest::Approx(2.5 * albedo).epsilon(2e-3).scale(0));
      }
    }
  }
}

// Random texels over several orders of magnitude, some of them suns.
Panorama rough_panorama(int width, int height) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform;
  Panorama panorama{width, height, {}};
  for (int i = 0; i < width * height * 3; ++i) {
    panorama.rgb.push_back(0.1f + std::pow(uniform(random), 8.0f));
  }
  for (int sun = 0; sun < 3; ++sun) {
    const std::size_t texel = random() % static_cast<unsigned>(width * height);
    panorama.rgb[3 * texel + static_cast<std::size_t>(sun)] = 300.0f;
  }
  return panorama;
}

// A model with a colour that changes with the light's height.
class Coloured final : public Brdf {
 public:
  Coloured() : Brdf({0.4, 0.4}), model_(make_brdf("ggx", {0.4, 0.4})) {}
  glm::dvec3 evaluate_rgb(const glm::dvec3& i, const glm::dvec3& o) const override {
    return glm::dvec3(0.9, 0.6 * i.z, 0.3 * (1.0 - i.z)) * model_->evaluate(i, o);
  }
  double evaluate(const glm::dvec3& i, const glm::dvec3& o) const override {
    const glm::dvec3 rgb = evaluate_rgb(i, o);
    return (rgb.x + rgb.y + rgb.z) / 3.0;
  }
  std::optional<BrdfSample> sample(const glm::dvec3& o, const glm::dvec2& u) const override {
    auto drawn = model_->sample(o, u);
    if (drawn) drawn->weight = evaluate(drawn->direction, o) * drawn->direction.z / drawn->pdf;
    return drawn;
  }
  double pdf(const glm::dvec3& i, const glm::dvec3& o) const override { return model_->pdf(i, o); }
  std::string_view name() const override { return "coloured"; }
  bool is_coloured() const override { return true; }

 private:
  std::unique_ptr<Brdf> model_;
};

TEST_CASE("Integrator: a coloured material reflects each channel by itself") {
  const SurfaceFrame frame = oblique_frame();
  const Panorama constant{8, 4, std::vector<float>(96, 2.5f)};
  const Coloured brdf;
  const glm::dvec3 o = view_at(0.9, 0.7);
  glm::dvec3 albedo(0.0);
  constexpr int kSteps = 400;
  for (int j = 0; j < kSteps; ++j) {
    for (int k = 0; k < 2 * kSteps; ++k) {
      const double z = (j + 0.5) / kSteps;
      const glm::dvec3 i = view_at(std::acos(z), kPi * (k + 0.5) / kSteps);
      albedo += brdf.evaluate_rgb(i, o) * (z * kPi / (kSteps * kSteps));
    }
  }
  const RadianceEstimate estimate =
      Integrator(constant, brdf, 1 << 14).integrate(world(o, frame), frame, 1);
  for (int c = 0; c < 3; ++c) {
    CHECK(estimate.radiance[c] == doctest::Approx(2.5 * albedo[c]).epsilon(2e-3).scale(0));
  }
}

TEST_CASE("Integrator: a rough environment agrees with plain quadrature") {
  const SurfaceFrame frame = oblique_frame();
  const Panorama panorama = rough_panorama(16, 8);
  const auto light = [&](const glm::dvec3& direction) { return panorama.sample(direction); };
  for (const Material& material : {Material{"ward", {0.2, 0.4}}, Material{"ggx", {0.4, 0.2}}}) {
    const auto brdf = make_brdf(material.name, material.alpha);
    for (const double theta : {0.3, 1.2}) {
      INFO(material.name, " theta ", theta);
      const glm::dvec3 o = view_at(theta, 2.0);
      const glm::dvec3 expected = quadrature(*brdf, o, frame, light, 1000);
      const Integrator integrator(panorama, *brdf, 1 << 15);
      const RadianceEstimate estimate = integrator.integrate(world(o, frame), frame, 3);
      for (int c = 0; c < 3; ++c) {
        CHECK(estimate.radiance[c] == doctest::Approx(expected[c]).epsilon(5e-3).scale(0));
        CHECK(estimate.standard_error[c] < 5e-3 * expected[c]);
        CHECK(std::abs(estimate.radiance[c] - expected[c]) <
              6.0 * estimate.standard_error[c] + 1e-4 * expected[c]);
      }
    }
  }
}

TEST_CASE("Integrator: one bright texel, in the lobe, in its tail and at the pole") {
  // ∫ of the texel's tent times ρ i_z: 40 × 40 midpoints in each quarter, 2π² sin θ du dv.
  const int width = 128;
  const int height = 64;
  const SurfaceFrame frame = oblique_frame();
  const auto brdf = make_brdf("ward", {0.1, 0.3});
  const glm::dvec3 o = view_at(0.6, 0.4);
  const glm::dvec3 mirror = world({-o.x, -o.y, o.z}, frame);
  const glm::dvec2 centre = panorama_position(mirror);
  struct Texel {
    int column;
    int row;
  };
  const Texel at_mirror{static_cast<int>(centre.x * width), static_cast<int>(centre.y * height)};
  for (const Texel& sun : {at_mirror, Texel{at_mirror.column + 6, at_mirror.row},
                           Texel{at_mirror.column - 4, at_mirror.row + 9}, Texel{7, 0}}) {
    Panorama panorama{width, height, std::vector<float>(width * height * 3, 0.0f)};
    panorama.rgb[static_cast<std::size_t>(3 * (sun.row * width + sun.column))] = 6e4f;
    double expected = 0.0;
    constexpr int kSteps = 80;
    for (int j = 0; j < kSteps; ++j) {
      for (int k = 0; k < kSteps; ++k) {
        const double dx = 2.0 * (k + 0.5) / kSteps - 1.0;
        const double dy = 2.0 * (j + 0.5) / kSteps - 1.0;
        const double v = (sun.row + 0.5 + dy) / height;
        if (v < 0.0) continue;
        // Above the first row's centres the map is constant.
        const double tent =
            (1.0 - std::abs(dx)) * (sun.row == 0 && dy < 0.0 ? 1.0 : 1.0 - std::abs(dy));
        const glm::dvec3 direction = panorama_direction({(sun.column + 0.5 + dx) / width, v});
        const glm::dvec3 i(glm::dot(direction, frame.tangent), glm::dot(direction, frame.bitangent),
                           glm::dot(direction, frame.normal));
        expected += tent * brdf->evaluate(i, o) * i.z * std::sin(kPi * v);
      }
    }
    expected *= 6e4 * (4.0 / (kSteps * kSteps)) / (width * height) * 2.0 * kPi * kPi;
    INFO("texel ", sun.column, ", ", sun.row);
    REQUIRE(expected > 0.0);
    const Integrator integrator(panorama, *brdf, 4096);
    const RadianceEstimate estimate = integrator.integrate(world(o, frame), frame, 4);
    CHECK(estimate.radiance.x == doctest::Approx(expected).epsilon(5e-3).scale(0));
    CHECK(estimate.radiance.y == 0.0);
  }
}

TEST_CASE("Integrator: the standard error is honest") {
  const SurfaceFrame frame = oblique_frame();
  const Panorama panorama = rough_panorama(64, 32);
  const auto brdf = make_brdf("ward", {0.05, 0.2});
  const Integrator coarse(panorama, *brdf, 64);
  const Integrator fine(panorama, *brdf, 1 << 15);
  double deviations = 0.0;
  double errors = 0.0;
  int far = 0;
  int count = 0;
  for (const double theta : {0.2, 0.9, 1.35}) {
    const glm::dvec3 view = world(view_at(theta, 1.0), frame);
    const glm::dvec3 truth = fine.integrate(view, frame, 1000).radiance;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      const RadianceEstimate estimate = coarse.integrate(view, frame, seed);
      for (int c = 0; c < 3; ++c) {
        const double deviation = (estimate.radiance[c] - truth[c]) / truth[c];
        const double error = estimate.standard_error[c] / truth[c];
        deviations += deviation * deviation;
        errors += error * error;
        far += std::abs(deviation) > 5.0 * error ? 1 : 0;
        ++count;
      }
    }
  }
  // Four batches: Student's t with 3 degrees of freedom, P(|t| > 5) = 0.015.
  INFO("ratio ", std::sqrt(deviations / errors), ", far ", far, " of ", count);
  CHECK(std::sqrt(deviations / errors) > 0.85);
  CHECK(std::sqrt(deviations / errors) < 1.15);
  CHECK(far < 0.03 * count);
}

TEST_CASE("Integrator: linear in the light, the same for the same seed, 0 from below") {
  const SurfaceFrame frame = oblique_frame();
  const Panorama panorama = rough_panorama(32, 16);
  Panorama brighter = panorama;
  for (float& value : brighter.rgb) value *= 4.0f;
  const auto brdf = make_brdf("ggx", {0.1, 0.1});
  const Integrator integrator(panorama, *brdf, 256);
  const Integrator four_times(brighter, *brdf, 256);
  const glm::dvec3 view = world(view_at(0.5, 0.3), frame);
  const glm::dvec3 once = integrator.integrate(view, frame, 8).radiance;
  CHECK(once == integrator.integrate(view, frame, 8).radiance);
  CHECK(once != integrator.integrate(view, frame, 9).radiance);
  CHECK(glm::length(four_times.integrate(view, frame, 8).radiance - 4.0 * once) <
        1e-6 * glm::length(once));
  CHECK(integrator.integrate(-view, frame, 8).radiance == glm::dvec3(0.0));
}

TEST_CASE("Integrator: widths from 1e-3 to 2 stay finite and below the brightest light") {
  const SurfaceFrame frame = oblique_frame();
  const Panorama panorama = rough_panorama(32, 16);
  for (const char* name : {"ward", "ggx"}) {
    for (const double alpha : {1e-3, 1e-2, 0.5, 2.0}) {
      const auto brdf = make_brdf(name, {alpha, 2.0 * alpha > 2.0 ? alpha : 2.0 * alpha});
      const Integrator integrator(panorama, *brdf, 512);
      for (const double theta : {0.0, 0.7, 1.5}) {
        const RadianceEstimate e =
            integrator.integrate(world(view_at(theta, 0.2), frame), frame, 1);
        INFO(name, " ", alpha, " at ", theta);
        for (int c = 0; c < 3; ++c) {
          CHECK(std::isfinite(e.radiance[c]));
          CHECK(e.radiance[c] > 0.0);
          // GGX loses energy only; Ward's albedo passes 1 at grazing views.
          CHECK(e.radiance[c] < (std::string_view(name) == "ggx" ? 300.0 : 600.0));
          CHECK(std::isfinite(e.standard_error[c]));
        }
      }
    }
  }
}

}  // namespace
}  // namespace lobelight
