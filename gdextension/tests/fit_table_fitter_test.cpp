#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <thread>

#include "base/pi.h"
#include "fit/table_fitter.h"
#include "fit/view_error.h"
#include "statistics.h"

namespace lobelight {
namespace {

// Notes how far the work says it is whenever it asks whether it should go on.
class NotedProgress : public Progress {
 public:
  bool cancelled() const noexcept override {
    noted_.insert(fraction());
    return Progress::cancelled();
  }
  const std::set<double>& noted() const { return noted_; }

 private:
  mutable std::set<double> noted_;
};

Recipe small_recipe(const char* brdf, const glm::dvec2& alpha, FitMethod method) {
  Recipe recipe;
  recipe.brdf = brdf;
  recipe.alpha = alpha;
  recipe.lobes = 5;
  recipe.views = {5, alpha.x == alpha.y ? 1 : 3};
  recipe.method = method;
  return recipe;
}

LobeTable fit(const Recipe& recipe, FitReport* report = nullptr, const FitOptions& options = {}) {
  Progress progress;
  return fit_table(recipe, progress, report, options);
}

TEST_CASE("The same recipe gives the same bytes with any number of threads") {
  for (const FitMethod method : {FitMethod::independent, FitMethod::continuation}) {
    Recipe recipe = small_recipe("ward", {0.05, 0.2}, method);
    recipe.threads = 1;
    FitOptions options;
    options.nodes_per_axis = 32;
    const std::vector<std::uint16_t> one = fit(recipe, nullptr, options).to_rgba16f();
    for (const int threads : {2, 3, 0}) {
      recipe.threads = threads;
      CHECK(fit(recipe, nullptr, options).to_rgba16f() == one);
    }
    recipe.seed = 1;
    CHECK(fit(recipe, nullptr, options).to_rgba16f() != one);
  }
}

TEST_CASE("Weights sum to the directional albedo of their view") {
  for (const char* brdf : {"ward", "ward_bounded", "ggx"}) {
    for (const FitMethod method : {FitMethod::independent, FitMethod::continuation}) {
      const Recipe recipe = small_recipe(brdf, {0.1, 0.3}, method);
      const LobeTable table = fit(recipe);
      const LobeTable stored =
          LobeTable::from_rgba16f(table.alpha(), table.lobes(), table.views(), table.to_rgba16f());
      const auto model = make_brdf(brdf, recipe.alpha);
      for (int p = 0; p < 3; ++p) {
        for (int t = 0; t < 5; ++t) {
          const double albedo = sample_slice(*model, table.view(t, p), 256).albedo;
          CAPTURE(brdf);
          CAPTURE(t);
          CHECK(total_weight(table.mixture_at_view(t, p)) == doctest::Approx(albedo).epsilon(2e-3));
          CHECK(total_weight(stored.mixture_at_view(t, p)) ==
                doctest::Approx(albedo).epsilon(2.5e-3));
        }
      }
    }
  }
}

TEST_CASE("Continued tables are as good between views as at them, independent ones are not") {
  const auto brdf = make_brdf("ward", {0.1, 0.1});
  double errors[2];
  for (const FitMethod method : {FitMethod::independent, FitMethod::continuation}) {
    Recipe recipe = small_recipe("ward", {0.1, 0.1}, method);
    recipe.lobes = 8;
    recipe.views = {16, 1};
    const LobeTable table = fit(recipe);
    double worst_at = 0.0;
    double worst_between = 0.0;
    // Up to 75°; the last views are harder for eight lobes.
    for (int t = 0; table.elevation(t + 0.5) < 75.0 * kPi / 180.0; ++t) {
      worst_at = std::max(worst_at, l1_error(*brdf, table.view(t, 0), table.mixture_at_view(t, 0)));
      const double elevation = table.elevation(t + 0.5);
      const glm::dvec3 o(std::sin(elevation), 0.0, std::cos(elevation));
      worst_between = std::max(worst_between, l1_error(*brdf, o, table.interpolate(o)));
    }
    errors[method == FitMethod::continuation] = worst_between;
    if (method == FitMethod::continuation) {
      CHECK(worst_at < 0.04);
      CHECK(worst_between < 0.05);
    }
  }
  CHECK(errors[1] <= errors[0] + 0.01);
}

TEST_CASE("Smoothing brings neighbouring views together and costs nothing at the views") {
  const auto brdf = make_brdf("ward", {0.1, 0.1});
  Recipe recipe = small_recipe("ward", {0.1, 0.1}, FitMethod::continuation);
  recipe.lobes = 8;
  recipe.views = {16, 1};
  double at[2];
  double between[2];
  for (const bool smoothed : {false, true}) {
    FitOptions options;
    if (!smoothed) options.smoothing_passes = 0;
    const LobeTable table = fit(recipe, nullptr, options);
    at[smoothed] = between[smoothed] = 0.0;
    for (int t = 0; table.elevation(t + 0.5) < 75.0 * kPi / 180.0; ++t) {
      at[smoothed] += l1_error(*brdf, table.view(t, 0), table.mixture_at_view(t, 0));
      const double elevation = table.elevation(t + 0.5);
      const glm::dvec3 o(std::sin(elevation), 0.0, std::cos(elevation));
      between[smoothed] = std::max(between[smoothed], l1_error(*brdf, o, table.interpolate(o)));
    }
  }
  CHECK(between[1] < 0.7 * between[0]);
  CHECK(at[1] < 1.05 * at[0]);
}

TEST_CASE("Anisotropic tables have no seam where they are mirrored") {
  // The lobes at the planes are mirror images of each other, so the mixture a little to the one
  // side is that a little to the other side.
  for (const glm::dvec2& alpha : {glm::dvec2(0.05, 0.2), glm::dvec2(0.3, 0.1)}) {
    for (const int lobes : {4, 5}) {
      Recipe recipe = small_recipe("ggx", alpha, FitMethod::continuation);
      recipe.lobes = lobes;
      const LobeTable table = fit(recipe);
      for (const double azimuth : {0.0, 0.5 * kPi}) {
        for (double elevation = 0.02; elevation < 1.55; elevation += 0.1) {
          const auto at = [&](double offset) {
            return table.interpolate({std::sin(elevation) * std::cos(azimuth + offset),
                                      std::sin(elevation) * std::sin(azimuth + offset),
                                      std::cos(elevation)});
          };
          const Mixture left = at(-1e-9);
          const Mixture right = at(1e-9);
          for (const Lobe& probe : left) {
            const double value = evaluate(left, probe.gaussian.mean);
            CHECK(evaluate(right, probe.gaussian.mean) == doctest::Approx(value).epsilon(1e-4));
          }
        }
      }
    }
  }
}

TEST_CASE("Extreme widths give finite tables with the right albedo") {
  FitOptions options;
  options.nodes_per_axis = 24;
  for (const glm::dvec2& alpha :
       {glm::dvec2(kMinAlpha, kMinAlpha), glm::dvec2(kMinAlpha, kMaxAlpha),
        glm::dvec2(kMaxAlpha, 0.3), glm::dvec2(kMaxAlpha, kMaxAlpha)}) {
    for (const char* brdf : {"ward", "ggx"}) {
      for (const int lobes : {1, 32}) {
        Recipe recipe = small_recipe(brdf, alpha, FitMethod::continuation);
        recipe.lobes = lobes;
        CAPTURE(brdf);
        CAPTURE(alpha.x);
        CAPTURE(alpha.y);
        CAPTURE(lobes);
        const LobeTable table = fit(recipe, nullptr, options);
        // Refuses texels that are not finite.
        const LobeTable stored =
            LobeTable::from_rgba16f(table.alpha(), lobes, table.views(), table.to_rgba16f());
        const glm::dvec3 o = table.view(2, 0);
        const Mixture mixture = stored.interpolate(o);
        const double albedo = sample_slice(*make_brdf(brdf, alpha), o, 24).albedo;
        CHECK(total_weight(mixture) == doctest::Approx(albedo).epsilon(1e-3));
        for (const Lobe& lobe : mixture) CHECK(std::isfinite(lobe.gaussian.kappa));
      }
    }
  }
}

TEST_CASE("All azimuths agree at the pole") {
  const LobeTable table = fit(small_recipe("ward", {0.05, 0.2}, FitMethod::continuation));
  for (int p = 1; p < 3; ++p) {
    for (int k = 0; k < table.lobes(); ++k) CHECK(table.entry(k, 0, p) == table.entry(k, 0, 0));
  }
}

TEST_CASE("The report tells what happened to every view") {
  FitReport report;
  const LobeTable table = fit(small_recipe("ward", {0.1, 0.2}, FitMethod::continuation), &report);
  CHECK(report.seconds > 0.0);
  CHECK(report.iterations.size() == 15);
  CHECK(report.log_likelihood.size() == 15);
  REQUIRE(report.first_view_curve.size() == static_cast<std::size_t>(report.iterations[0]) + 1);
  CHECK(report.first_view_curve.back() == report.log_likelihood[0]);
  CHECK(report.first_view_curve.front() < report.log_likelihood[0]);
  for (std::size_t view = 0; view < 15; ++view) {
    CHECK(std::isfinite(report.log_likelihood[view]));
    // Only the copies of the pole were not iterated.
    CHECK((report.iterations[view] > 0) == (view != 5 && view != 10));
  }
}

TEST_CASE("Views take the documented defaults") {
  Recipe recipe;
  CHECK(resolve_views(recipe) == glm::ivec2(16, 1));
  recipe.alpha = {0.1, 0.2};
  CHECK(resolve_views(recipe) == glm::ivec2(16, 8));
  recipe.views = {0, 4};
  CHECK(resolve_views(recipe) == glm::ivec2(16, 4));
}

TEST_CASE("The progress moves while lobes are placed otherwise than by EM") {
  Recipe arcs = small_recipe("ward", {0.02, 0.3}, FitMethod::continuation);
  arcs.placement = Placement::arc;
  const Recipe squares = small_recipe("ggx", {0.5, 0.5}, FitMethod::continuation);
  for (Recipe recipe : {arcs, squares}) {
    recipe.threads = 1;
    NotedProgress progress;
    fit_table(recipe, progress, nullptr);
    CHECK(*progress.noted().rbegin() < 1.0);
    double before = 0.0;
    for (const double now : progress.noted()) {
      CHECK(now - before < 0.26);
      before = now;
    }
    CHECK(before > 0.7);
    CHECK(progress.fraction() == 1.0);
  }
}

TEST_CASE("Progress rises to one, and a cancelled bake stops") {
  Progress progress;
  fit_table(small_recipe("ward", {0.1, 0.2}, FitMethod::continuation), progress, nullptr);
  CHECK(progress.fraction() == 1.0);

  Progress cancelled;
  cancelled.cancel();
  for (const FitMethod method : {FitMethod::independent, FitMethod::continuation}) {
    CHECK_THROWS_AS(fit_table(small_recipe("ward", {0.1, 0.2}, method), cancelled, nullptr),
                    Cancelled);
  }

  // In the middle of the work, from another thread.
  Progress watched;
  Recipe large = small_recipe("ward", {0.05, 0.2}, FitMethod::continuation);
  large.views = {128, 64};
  std::thread watcher([&] {
    while (watched.fraction() == 0.0) std::this_thread::yield();
    watched.cancel();
  });
  CHECK_THROWS_AS(fit_table(large, watched, nullptr), Cancelled);
  watcher.join();
  CHECK(watched.fraction() < 0.5);
}

TEST_CASE("Bad recipes are refused by a sentence that names key and value") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](const Recipe& recipe) {
    try {
      validate(recipe);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(message({}).empty());
  Recipe recipe;
  recipe.lobes = 0;
  CHECK(message(recipe) == "lobes is 0, but must be between 1 and 32.");
  recipe.lobes = 1000;
  CHECK(message(recipe) == "lobes is 1000, but must be between 1 and 32.");

  recipe = {};
  recipe.brdf = "phong";
  CHECK(message(recipe).find("\"phong\"") != std::string::npos);
  CHECK(message(recipe).find("\"ggx\"") != std::string::npos);

  recipe = {};
  for (const double bad : {0.0, -0.1, nan}) {
    recipe.alpha = {bad, 0.1};
    CHECK(message(recipe).find("alpha is (") == 0);
  }

  recipe = {};
  for (const glm::ivec2& bad : {glm::ivec2(1, 1), glm::ivec2(-3, 1), glm::ivec2(8, -1),
                                glm::ivec2(100000, 1), glm::ivec2(8, 257)}) {
    recipe.views = bad;
    CHECK(message(recipe).find("views is (" + std::to_string(bad.x) + ", ") == 0);
  }
  recipe.alpha = {0.1, 0.2};
  recipe.views = {8, 1};
  CHECK(message(recipe) == "views is (8, 1), but an anisotropic alpha needs at least 2 azimuths.");

  CHECK(fit_method_from_string("independent") == FitMethod::independent);
  CHECK(to_string(fit_method_from_string("continuation")) == "continuation");
  CHECK_THROWS_WITH_AS(
      fit_method_from_string("newton"),
      R"(method is "newton", which is not known; known are "continuation", "independent".)",
      std::invalid_argument);

  Progress progress;
  recipe = {};
  recipe.lobes = 0;
  CHECK_THROWS_AS(fit_table(recipe, progress, nullptr), std::invalid_argument);
}

}  // namespace
}  // namespace lobelight
