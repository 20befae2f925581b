#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "fit/pyramid_kernel.h"
#include "fit/slice.h"
#include "fit/table_fitter.h"
#include "fit/wide_lobes.h"

namespace lobelight {
namespace {

LobeTable wide_table(const std::string& brdf, double width, int lobes) {
  Recipe recipe;
  recipe.brdf = brdf;
  recipe.alpha = {width, width};
  recipe.lobes = lobes;
  Progress progress;
  return fit_table(recipe, progress, nullptr);
}

double second_degree(const glm::dvec3& d) {
  return d.x * d.y + 1.5 * d.z * d.x + 0.5 * (d.y * d.y - d.z * d.z);
}

TEST_CASE("fit_wide_lobes: simple light is reflected as the material reflects it") {
  const glm::dvec3 slopes[] = {{1, 0, 0}, {0, 0, 1}, {0.6, 0.5, -0.6}};
  for (const char* brdf : {"ggx", "ward"}) {
    for (const double width : {0.3, 0.5, 0.7, 1.0}) {
      const LobeTable table = wide_table(brdf, width, 8);
      const auto material = make_brdf(brdf, {width, width});
      for (const double elevation : {0.05, 0.4, 0.8, 1.2, 1.45}) {
        const glm::dvec3 o(std::sin(elevation), 0.0, std::cos(elevation));
        const Slice slice = sample_slice(*material, o);
        const Mixture lobes = table.interpolate(o);
        CAPTURE(brdf);
        CAPTURE(width);
        CAPTURE(elevation);
        CHECK(total_weight(lobes) == doctest::Approx(slice.albedo).epsilon(0.01));
        for (const glm::dvec3& slope : slopes) {
          double wanted = 0.0, drawn = 0.0;
          for (std::size_t n = 0; n < slice.directions.size(); ++n) {
            wanted += slice.weights[n] * glm::dot(slope, slice.directions[n]);
          }
          for (const Lobe& lobe : lobes) {
            drawn += lobe.weight * drawn_harmonics(1.0 / lobe.gaussian.kappa)[1] *
                     glm::dot(slope, lobe.gaussian.mean);
          }
          CHECK(std::abs(drawn - wanted) < 0.016 * slice.albedo);
        }
        double wanted = 0.0, drawn = 0.0;
        for (std::size_t n = 0; n < slice.directions.size(); ++n) {
          wanted += slice.weights[n] * second_degree(slice.directions[n]);
        }
        for (const Lobe& lobe : lobes) {
          drawn += lobe.weight * drawn_harmonics(1.0 / lobe.gaussian.kappa)[2] *
                   second_degree(lobe.gaussian.mean);
        }
        CHECK(std::abs(drawn - wanted) < 0.025 * slice.albedo);
      }
    }
  }
}

TEST_CASE("fit_wide_lobes: lobes can be stored, stay small and are the same each time") {
  const LobeTable table = wide_table("ggx", 0.5, 16);
  CHECK(table.to_rgba16f() == wide_table("ggx", 0.5, 16).to_rgba16f());
  for (int t = 0; t < table.views().x; ++t) {
    double sum = 0.0, magnitudes = 0.0;
    const glm::dvec3 o = table.view(t, 0);
    for (const Lobe& lobe : table.mixture_at_view(t, 0)) {
      sum += lobe.weight;
      magnitudes += std::abs(lobe.weight);
      CHECK(glm::dot(glm::normalize(lobe.gaussian.mean + o), o) > 0.01);
      CHECK(glm::normalize(lobe.gaussian.mean + o).z > 0.2);
    }
    CHECK(magnitudes < 2.5 * sum);
  }
}

TEST_CASE("fit_wide_lobes: reports tell of it, and recipes can refuse it") {
  Recipe recipe;
  recipe.brdf = "ggx";
  recipe.alpha = {0.5, 0.5};
  Progress progress;
  FitReport report;
  fit_table(recipe, progress, &report);
  CHECK(report.is_by_squares);
  recipe.placement = Placement::em;
  const LobeTable table = fit_table(recipe, progress, &report);
  CHECK_FALSE(report.is_by_squares);
  for (int t = 0; t < table.views().x; ++t) {
    for (const Lobe& lobe : table.mixture_at_view(t, 0)) CHECK(lobe.weight >= 0.0);
  }
}

TEST_CASE("is_wide: round materials of one colour from a width on") {
  const LobeTable round({0.5, 0.5}, 8, {16, 1});
  CHECK(is_wide(*make_brdf("ggx", {0.5, 0.5}), round));
  CHECK_FALSE(is_wide(*make_brdf("ggx", {0.2, 0.2}), round));
  CHECK_FALSE(is_wide(*make_brdf("ggx", {0.5, 0.5}), LobeTable({0.5, 0.5}, 8, {16, 8})));
}

}  // namespace
}  // namespace lobelight
