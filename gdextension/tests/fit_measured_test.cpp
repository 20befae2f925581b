#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/pi.h"
#include "brdf/binary_file.h"
#include "brdf/ggx.h"
#include "fit/channel_weights.h"
#include "fit/table_fitter.h"
#include "measured_files.h"
#include "statistics.h"

namespace lobelight {
namespace {

using testing::TemporaryFile;

// ∫|a − b| over the slices of `brdf`, as a share of its albedo; mean over the views up to 80°.
double table_distance(const LobeTable& a, const LobeTable& b, const Brdf& brdf) {
  double sum = 0.0;
  int count = 0;
  for (int p = 0; p < a.views().y; ++p) {
    for (int t = 0; t < a.views().x; ++t) {
      const glm::dvec3 o = a.view(t, p);
      if (o.z < 0.17) continue;
      const Slice slice = sample_slice(brdf, o, 48, 0.3);
      double distance = 0.0;
      for (std::size_t n = 0; n < slice.weights.size(); ++n) {
        const glm::dvec3& i = slice.directions[n];
        const double value = brdf.evaluate(i, o) * i.z;
        distance += slice.weights[n] / value *
                    std::abs(evaluate(a.interpolate(o), i) - evaluate(b.interpolate(o), i));
      }
      sum += distance / slice.albedo;
      ++count;
    }
  }
  return sum / count;
}

// Greatest relative difference of two tables' albedos over the views up to 80°.
double albedo_distance(const LobeTable& a, const LobeTable& b) {
  double worst = 0.0;
  for (int p = 0; p < a.views().y; ++p) {
    for (int t = 0; t < a.views().x; ++t) {
      if (a.view(t, p).z < 0.17) continue;
      const double own = total_weight(a.mixture_at_view(t, p));
      const double other = total_weight(b.mixture_at_view(t, p));
      worst = std::max(worst, std::abs(own / other - 1.0));
    }
  }
  return worst;
}

LobeTable fit(Recipe recipe) {
  Progress progress;
  return fit_table(recipe, progress, nullptr);
}

TEST_CASE("A MERL file's table is that of the model it was made of") {
  Recipe recipe;
  recipe.brdf = "ggx";
  recipe.alpha = {0.15, 0.15};
  const auto model = make_brdf(recipe.brdf, recipe.alpha);
  const LobeTable expected = fit(recipe);

  const TemporaryFile file(".binary");
  file.write(testing::merl_file(
      [&](const glm::dvec3& i, const glm::dvec3& o) { return glm::dvec3(model->evaluate(i, o)); }));
  recipe.brdf = file.path();
  recipe.alpha = {0.0, 0.0};
  const LobeTable found = fit(recipe);
  CHECK(found.views() == glm::ivec2(16, 1));
  CHECK(found.alpha().x == doctest::Approx(0.15).epsilon(0.2));
  CHECK(table_distance(found, expected, *model) < 0.02);
  CHECK(albedo_distance(found, expected) < 0.005);
}

TEST_CASE("An anisotropic RGL file's table is that of the model it was made of") {
  Recipe recipe;
  recipe.brdf = "ggx";
  recipe.alpha = {0.15, 0.35};
  recipe.lobes = 4;
  recipe.views = {6, 3};
  const auto model = make_brdf(recipe.brdf, recipe.alpha);
  const LobeTable expected = fit(recipe);

  testing::RglRecipe made;
  made.reflectance = [&](const glm::dvec3& i, const glm::dvec3& o) {
    return glm::dvec3(model->evaluate(i, o));
  };
  made.alpha = model->alpha();
  made.azimuths.clear();
  for (int p = 0; p <= 4; ++p) made.azimuths.push_back(-kPi + p * kPi / 8.0);
  for (int t = 0; t <= 8; ++t) made.elevations.push_back(0.5 * kPi * t / 8.0);
  const TemporaryFile file(".bsdf");
  file.write(testing::rgl_file(made));
  recipe.brdf = file.path();
  recipe.alpha = {0.0, 0.0};
  const LobeTable found = fit(recipe);
  CHECK(found.alpha().y / found.alpha().x == doctest::Approx(0.35 / 0.15).epsilon(0.2));
  CHECK(table_distance(found, expected, *model) < 0.03);
  CHECK(albedo_distance(found, expected) < 0.01);

  recipe.views = {0, 0};
  CHECK(resolve_views(recipe, false) == glm::ivec2(16, 8));
  recipe.views = {8, 1};
  CHECK_THROWS_WITH_AS(fit(recipe),
                       "views is (8, 1), but an anisotropic alpha needs at least 2 azimuths.",
                       std::invalid_argument);
}

TEST_CASE("A coloured file's table has the colours of what it was made of") {
  const auto model = make_brdf("ggx", {0.2, 0.2});
  const glm::dvec3 colour(0.9, 0.6, 0.3);
  const TemporaryFile file(".binary");
  file.write(testing::merl_file([&](const glm::dvec3& i, const glm::dvec3& o) {
    // Red at normal incidence, white at grazing.
    const double cosine = glm::dot(glm::normalize(i + o), i);
    return glm::mix(colour, glm::dvec3(1.0), std::pow(1.0 - cosine, 5.0)) * model->evaluate(i, o);
  }));
  Recipe recipe;
  recipe.brdf = file.path();
  recipe.alpha = {0.0, 0.0};
  recipe.lobes = 4;
  const LobeTable table = fit(recipe);
  REQUIRE(table.has_second_texels());
  const auto brdf = make_brdf(recipe.brdf, recipe.alpha);
  for (int t = 0; t < 16; ++t) {
    CAPTURE(t);
    const glm::dvec3 o = table.view(t, 0);
    const Slice slice = sample_slice(*brdf, o);
    glm::dvec3 albedo(0.0);
    for (const glm::dvec3& weight : channel_node_weights(*brdf, o, slice)) albedo += weight;
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& weight : table.channel_weights_at_view(t, 0)) sum += weight;
    for (int channel = 0; channel < 3; ++channel) {
      CHECK(sum[channel] == doctest::Approx(albedo[channel]).epsilon(1e-9));
    }
    if (t < 8) CHECK(sum.z / sum.x == doctest::Approx(0.3 / 0.9).epsilon(0.1));
    // The texel's weights are the means of the channels'.
    CHECK(total_weight(table.mixture_at_view(t, 0)) ==
          doctest::Approx((sum.x + sum.y + sum.z) / 3.0).epsilon(1e-9));
  }
}

TEST_CASE("What is wrong with a file shows when it is fitted") {
  Recipe recipe;
  recipe.brdf = "nowhere/gold.binary";
  recipe.alpha = {0.0, 0.0};
  CHECK_NOTHROW(validate(recipe));
  CHECK_THROWS_WITH_AS(fit(recipe), "nowhere/gold.binary: no such file", MeasuredFileError);
  recipe.lobes = 0;
  CHECK_THROWS_AS(validate(recipe), std::invalid_argument);
}

}  // namespace
}  // namespace lobelight
