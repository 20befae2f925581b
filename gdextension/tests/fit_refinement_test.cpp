#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "base/pi.h"
#include "fit/em.h"
#include "fit/initial_guess.h"
#include "fit/pyramid_kernel.h"
#include "fit/refinement.h"
#include "fit/table_fitter.h"
#include "statistics.h"

namespace lobelight {
namespace {

const glm::dvec3 kOblique = glm::normalize(glm::dvec3(0.5, 0.2, 0.7));

// Σ_n w_n / W · ln Σ_k π_k q_k(n) from the densities that channel_weights() is given.
double drawn_log_likelihood(const Slice& slice, const Mixture& mixture) {
  const std::vector<double> log_densities = drawn_log_densities(slice, mixture);
  const double total = total_weight(mixture);
  const std::size_t nodes = slice.weights.size();
  double sum = 0.0;
  for (std::size_t n = 0; n < nodes; ++n) {
    double density = 0.0;
    for (std::size_t k = 0; k < mixture.size(); ++k) {
      density += mixture[k].weight / total * std::exp(log_densities[k * nodes + n]);
    }
    sum += slice.weights[n] / slice.albedo * std::log(density);
  }
  return sum;
}

Mixture fitted(const Slice& slice, int lobes, const std::vector<Mirror>& mirrors = {}) {
  EmOptions em;
  em.mirrors = mirrors;
  return run_em(slice, initial_guess(slice, lobes), em).mixture;
}

TEST_CASE("The gradient is that of the objective") {
  for (const glm::dvec2& alpha : {glm::dvec2(0.1, 0.1), glm::dvec2(0.05, 0.4)}) {
    const Slice slice = sample_slice(*make_brdf("ggx", alpha), kOblique, 24);
    RefinementOptions options;
    const RefinementObjective objective(slice, fitted(slice, 5), options);
    testing::Uniform uniform(3);
    std::vector<double> x(objective.size());
    for (double& component : x) component = 0.2 * (uniform.next() - 0.5);
    std::vector<double> gradient(x.size());
    std::vector<double> unused(x.size());
    objective(x, gradient);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double step = 1e-6;
      std::vector<double> ahead = x;
      std::vector<double> behind = x;
      ahead[i] += step;
      behind[i] -= step;
      const double slope = (objective(ahead, unused) - objective(behind, unused)) / (2.0 * step);
      CAPTURE(i);
      CHECK(gradient[i] == doctest::Approx(slope).epsilon(1e-5).scale(1e-2));
    }
  }
}

TEST_CASE("The likelihood of what is drawn rises, at the expense of that of the Gaussians") {
  for (const char* brdf : {"ward", "ggx"}) {
    for (const glm::dvec3& o : {glm::dvec3(0.0, 0.0, 1.0), kOblique}) {
      const Slice slice = sample_slice(*make_brdf(brdf, {0.1, 0.2}), o);
      const Mixture start = fitted(slice, 8);
      const RefinementResult result = refine(slice, start);
      REQUIRE(result.log_likelihood.size() == static_cast<std::size_t>(result.iterations) + 1);
      CHECK(result.iterations > 3);
      for (std::size_t i = 1; i < result.log_likelihood.size(); ++i) {
        CHECK(result.log_likelihood[i] > result.log_likelihood[i - 1]);
      }
      CHECK(result.log_likelihood.front() ==
            doctest::Approx(drawn_log_likelihood(slice, start)).epsilon(1e-9));
      CHECK(result.log_likelihood.back() ==
            doctest::Approx(drawn_log_likelihood(slice, result.mixture)).epsilon(1e-9));
      CHECK(result.log_likelihood.back() > result.log_likelihood.front() + 5e-4);

      EmOptions no_steps;
      no_steps.max_iterations = 0;
      CHECK(run_em(slice, result.mixture, no_steps).log_likelihood[0] <
            run_em(slice, start, no_steps).log_likelihood[0]);

      CHECK(total_weight(result.mixture) == doctest::Approx(slice.albedo).epsilon(1e-12));
      for (const Lobe& lobe : result.mixture) {
        CHECK(lobe.weight >= 0.0);
        CHECK(lobe.gaussian.mean.z > 0.0);
        CHECK(glm::length(lobe.gaussian.mean) == doctest::Approx(1.0));
      }
    }
  }
}

TEST_CASE("What is drawn by a level alone is found again") {
  // A slice that is the kernel of one level, by quantiles of its radius.
  const double variance = pyramid_levels(0.003).finer;
  const glm::dvec3 mean = glm::normalize(glm::dvec3(0.3, -0.2, 0.9));
  Slice slice;
  const glm::dvec3 across = glm::normalize(glm::cross(mean, glm::dvec3(0.0, 0.0, 1.0)));
  const glm::dvec3 along = glm::cross(mean, across);
  for (int ring = 0; ring < 200; ++ring) {
    // The mass within t is 1 − (1 − t/12)^5.
    const double share = (ring + 0.5) / 200.0;
    const double squared = 12.0 * variance * (1.0 - std::pow(1.0 - share, 0.2));
    const double sine = std::sqrt(squared * (1.0 - 0.25 * squared));
    for (int n = 0; n < 16; ++n) {
      const double turn = 2.0 * kPi * n / 16.0;
      slice.directions.push_back(mean * (1.0 - 0.5 * squared) +
                                 sine * (std::cos(turn) * across + std::sin(turn) * along));
      slice.weights.push_back(0.5 / 3200.0);
    }
  }
  slice.albedo = 0.5;
  RefinementOptions options;
  options.max_iterations = 100;
  options.tolerance = 1e-10;
  const Mixture start{{0.5, {glm::normalize(mean + 0.02 * across), 0.6 / variance}}};
  const RefinementResult result = refine(slice, start, options);
  CHECK(glm::length(result.mixture[0].gaussian.mean - mean) < 1e-3 * std::sqrt(variance));
  CHECK(result.mixture[0].gaussian.kappa * variance == doctest::Approx(1.0).epsilon(0.01));
  CHECK(result.mixture[0].weight == doctest::Approx(0.5));
}

TEST_CASE("Images stay images to the last bit") {
  const auto brdf = make_brdf("ward", {0.1, 0.3});
  for (const bool at_pole : {true, false}) {
    const glm::dvec3 o = at_pole ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.6, 0.0, 0.8);
    const Slice slice = sample_slice(*brdf, o);
    const Mixture guess = initial_guess(slice, 7);
    RefinementOptions options;
    options.mirrors = {match_images(guess, 1)};
    if (at_pole) options.mirrors.push_back(match_images(guess, 0));
    const RefinementResult result = refine(slice, fitted(slice, 7, options.mirrors), options);
    CHECK(result.iterations > 3);
    for (const Mirror& mirror : options.mirrors) {
      for (std::size_t k = 0; k < result.mixture.size(); ++k) {
        const Lobe& own = result.mixture[k];
        const Lobe& image = result.mixture[static_cast<std::size_t>(mirror.image[k])];
        CHECK(own.weight == image.weight);
        CHECK(own.gaussian.kappa == image.gaussian.kappa);
        CHECK(own.gaussian.mean == reflected(image.gaussian.mean, mirror.axis));
      }
    }
  }
}

TEST_CASE("Starts and slices of any kind give numbers or the documented error") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Slice slice = sample_slice(*make_brdf("ward", {0.1, 0.1}), kOblique, 16);
  const Mixture start = fitted(slice, 3);
  const Mixture expected = refine(slice, start).mixture;

  Slice disturbed = slice;
  disturbed.directions.insert(disturbed.directions.begin() + 7, glm::dvec3(nan));
  disturbed.weights.insert(disturbed.weights.begin() + 7, nan);
  disturbed.albedo = nan;
  const Mixture found = refine(disturbed, start).mixture;
  for (std::size_t k = 0; k < 3; ++k) CHECK(found[k].weight == expected[k].weight);

  Mixture odd = start;
  odd[0].weight = nan;
  odd[1].gaussian.kappa = 0.0;
  odd[2].gaussian.kappa = 1e300;
  for (const Lobe& lobe : refine(slice, odd).mixture) {
    CHECK(lobe.weight >= 0.0);
    CHECK(lobe.gaussian.kappa > 0.0);
    CHECK(lobe.gaussian.kappa <= 1e8);
  }

  for (const Lobe& lobe : refine({}, start).mixture) CHECK(lobe.weight == 0.0);

  Progress progress;
  progress.cancel();
  RefinementOptions options;
  options.progress = &progress;
  CHECK_THROWS_AS(refine(slice, start, options), Cancelled);
}

Recipe refined_recipe(const char* brdf, const glm::dvec2& alpha) {
  Recipe recipe;
  recipe.brdf = brdf;
  recipe.alpha = alpha;
  recipe.lobes = 5;
  recipe.views = {8, alpha.x == alpha.y ? 1 : 3};
  recipe.refine = true;
  return recipe;
}

LobeTable fit(const Recipe& recipe, FitReport* report = nullptr, int nodes_per_axis = 32) {
  Progress progress;
  FitOptions options;
  options.nodes_per_axis = nodes_per_axis;
  return fit_table(recipe, progress, report, options);
}

TEST_CASE("Refined tables are the same with any number of threads, and agree at the pole") {
  for (const FitMethod method : {FitMethod::independent, FitMethod::continuation}) {
    Recipe recipe = refined_recipe("ward", {0.05, 0.2});
    recipe.method = method;
    recipe.threads = 1;
    const std::vector<std::uint16_t> one = fit(recipe).to_rgba16f();
    recipe.threads = 3;
    const LobeTable table = fit(recipe);
    CHECK(table.to_rgba16f() == one);
    recipe.refine = false;
    CHECK(fit(recipe).to_rgba16f() != one);
    if (method == FitMethod::independent) continue;
    for (int k = 0; k < table.lobes(); ++k) CHECK(table.entry(k, 0, 2) == table.entry(k, 0, 0));
  }
}

TEST_CASE("Refined tables keep the albedo and gain between views too") {
  for (const char* brdf : {"ward", "ggx"}) {
    const auto model = make_brdf(brdf, {0.1, 0.1});
    Recipe recipe = refined_recipe(brdf, {0.1, 0.1});
    recipe.lobes = 8;
    recipe.views = {16, 1};
    FitReport report;
    const LobeTable refined = fit(recipe, &report, 64);
    recipe.refine = false;
    const LobeTable plain = fit(recipe, nullptr, 64);
    double gain_at = 0.0;
    double gain_between = 0.0;
    for (int t = 0; t < 15; ++t) {
      const double elevation = refined.elevation(t + 0.5);
      const glm::dvec3 o(std::sin(elevation), 0.0, std::cos(elevation));
      const Slice between = sample_slice(*model, o, 48);
      gain_between += drawn_log_likelihood(between, refined.interpolate(o)) -
                      drawn_log_likelihood(between, plain.interpolate(o));
      const Slice at = sample_slice(*model, refined.view(t, 0), 64);
      const Mixture mixture = refined.mixture_at_view(t, 0);
      gain_at +=
          drawn_log_likelihood(at, mixture) - drawn_log_likelihood(at, plain.mixture_at_view(t, 0));
      CHECK(total_weight(mixture) == doctest::Approx(at.albedo).epsilon(1e-9));
      CHECK(report.log_likelihood[static_cast<std::size_t>(t)] ==
            doctest::Approx(drawn_log_likelihood(at, mixture)).epsilon(1e-6));
    }
    CAPTURE(gain_at);
    CAPTURE(gain_between);
    CHECK(gain_at > 0.0);
    CHECK(gain_between > 0.7 * gain_at);
  }
}

}  // namespace
}  // namespace lobelight
