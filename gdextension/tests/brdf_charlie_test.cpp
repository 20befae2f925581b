#include <doctest/doctest.h>

#include <cmath>

#include "base/pi.h"
#include "brdf/charlie.h"
#include "fit/slice.h"
#include "fit/table_fitter.h"
#include "sg/mixture.h"

namespace lobelight {
namespace {

glm::dvec3 view(double elevation_degrees) {
  const double e = elevation_degrees * kPi / 180.0;
  return {std::sin(e), 0.0, std::cos(e)};
}

TEST_CASE("The projected area of all fibres' normals is one") {
  for (const double alpha : {0.05, 0.3, 1.0}) {
    constexpr int kCells = 20000;
    double area = 0.0;
    for (int n = 0; n < kCells; ++n) {
      const double theta = 0.5 * kPi * (n + 0.5) / kCells;
      area += charlie_normal_density(std::sin(theta), alpha) * std::cos(theta) * std::sin(theta);
    }
    CHECK(area * 2.0 * kPi * 0.5 * kPi / kCells == doctest::Approx(1.0).epsilon(1e-6));
  }
}

TEST_CASE("Both halves of Charlie's shadowing meet, and it grows towards the horizon") {
  for (const double alpha : {0.05, 0.3, 1.0}) {
    CHECK(charlie_lambda(0.5 - 1e-12, alpha) ==
          doctest::Approx(charlie_lambda(0.5, alpha)).epsilon(1e-9));
    CHECK(charlie_lambda(1.0, alpha) >= 0.0);
    for (double cosine = 0.02; cosine < 1.0; cosine += 0.02) {
      CHECK(charlie_lambda(cosine, alpha) < charlie_lambda(cosine - 0.015, alpha));
    }
  }
}

TEST_CASE("Sheen vanishes where the half-vector is the normal and is strongest at the rim") {
  const Charlie charlie(0.3);
  CHECK(charlie.evaluate({0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}) == 0.0);
  CHECK(charlie.evaluate(view(80.0), view(80.0)) > charlie.evaluate(view(40.0), view(40.0)));
}

TEST_CASE("Sheen of widths from a tenth on reflects less than it receives") {
  for (const double alpha : {0.1, 0.3, 1.0}) {
    double before = 0.0;
    for (const double elevation : {0.0, 30.0, 60.0, 80.0, 89.4}) {
      const double albedo = sample_slice(Charlie(alpha), view(elevation), 128).albedo;
      CHECK(albedo < 1.0);
      CHECK(albedo > before);
      before = albedo;
    }
  }
}

TEST_CASE("Four lobes hold the sheen of a smoothly lit world") {
  // Light with a bright side: L(i) = 1 + (i·s) + (i·s)², reflected by the slice and by its lobes,
  // whose part below the horizon sees the same light.
  const glm::dvec3 sun = glm::normalize(glm::dvec3(0.6, -0.5, 0.6));
  const auto light = [&](const glm::dvec3& i) {
    const double c = glm::dot(i, sun);
    return 1.0 + c + c * c;
  };
  for (const double alpha : {0.1, 0.3, 1.0}) {
    Recipe recipe;
    recipe.brdf = "charlie";
    recipe.alpha = glm::dvec2(alpha);
    recipe.lobes = 4;
    Progress progress;
    const LobeTable table = fit_table(recipe, progress, nullptr);
    for (const double elevation : {25.0, 50.0, 75.0}) {
      const glm::dvec3 o = view(elevation);
      const Slice slice = sample_slice(Charlie(alpha), o, 256);
      double truth = 0.0;
      for (std::size_t n = 0; n < slice.weights.size(); ++n) {
        truth += slice.weights[n] * light(slice.directions[n]);
      }
      double drawn = 0.0;
      double albedo = 0.0;
      for (const Lobe& lobe : table.interpolate(o)) {
        // A Gaussian's means of i·s and (i·s)² are a (μ·s) and b + (1 − 3b)(μ·s)².
        const double k = lobe.gaussian.kappa;
        const double a = 1.0 / std::tanh(k) - 1.0 / k;
        const double b = a / k;
        const double c = glm::dot(lobe.gaussian.mean, sun);
        drawn += lobe.weight * (1.0 + a * c + b + (1.0 - 3.0 * b) * c * c);
        albedo += lobe.weight;
      }
      CAPTURE(alpha);
      CAPTURE(elevation);
      CHECK(drawn == doctest::Approx(truth).epsilon(0.03));
      CHECK(albedo == doctest::Approx(slice.albedo).epsilon(0.01));
    }
  }
}

}  // namespace
}  // namespace lobelight
