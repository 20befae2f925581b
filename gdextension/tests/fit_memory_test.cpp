#include <doctest/doctest.h>

#include "allocated_bytes.h"
#include "fit/memory.h"

namespace lobelight {
namespace {

std::size_t measured_peak(const Recipe& recipe, const FitOptions& options) {
  Progress progress;
  FitReport report;
  bench::reset_peak_bytes();
  const std::size_t before = bench::held_bytes();
  const LobeTable table = fit_table(recipe, progress, &report, options);
  return bench::peak_bytes() - before;
}

TEST_CASE("A fit needs no more memory than the formula says, and not much less") {
  for (const FitMethod method : {FitMethod::independent, FitMethod::continuation}) {
    for (const int nodes : {16, 64, 128}) {
      for (const int lobes : {1, 8, 32}) {
        for (const int threads : {1, 2, 4}) {
          Recipe recipe;
          recipe.brdf = "ggx";
          recipe.alpha = {0.1, 0.3};
          recipe.views = {4, 4};
          recipe.lobes = lobes;
          recipe.method = method;
          recipe.refine = lobes == 8;
          recipe.threads = threads;
          FitOptions options;
          options.nodes_per_axis = nodes;
          options.em.max_iterations = 5;
          CAPTURE(nodes);
          CAPTURE(lobes);
          CAPTURE(threads);
          const std::size_t bound = fit_memory_bound(recipe, options);
          const std::size_t peak = measured_peak(recipe, options);
          CHECK(peak <= bound);
          // Large problems fill the bound by a good part even if all threads never peak together.
          if (nodes == 128) CHECK(2 * peak * static_cast<std::size_t>(threads) > bound);
        }
      }
    }
  }
}

TEST_CASE("Looking at lobes along the highlight stays within the formula too") {
  for (const Placement placement : {Placement::automatic, Placement::arc}) {
    for (const int lobes : {1, 32}) {
      for (const int threads : {1, 4}) {
        Recipe recipe;
        recipe.alpha = {0.02, 0.3};
        recipe.views = {6, 4};
        recipe.lobes = lobes;
        recipe.threads = threads;
        recipe.placement = placement;
        FitOptions options;
        options.nodes_per_axis = 16;
        options.em.max_iterations = 5;
        CAPTURE(lobes);
        CAPTURE(threads);
        CHECK(measured_peak(recipe, options) <= fit_memory_bound(recipe, options));
      }
    }
  }
}

TEST_CASE("Least squares stay within the formula too") {
  for (const int lobes : {3, 32}) {
    for (const int views : {2, 128}) {
      Recipe recipe;
      recipe.brdf = "ggx";
      recipe.alpha = {0.5, 0.5};
      recipe.views = {views, 1};
      recipe.lobes = lobes;
      recipe.threads = 1;
      FitOptions options;
      options.nodes_per_axis = 16;
      options.em.max_iterations = 5;
      CAPTURE(lobes);
      CAPTURE(views);
      CHECK(measured_peak(recipe, options) <= fit_memory_bound(recipe, options));
    }
  }
}

TEST_CASE("Many iterations and many views stay within the formula too") {
  Recipe recipe;
  recipe.alpha = {0.2, 0.2};
  recipe.lobes = 4;
  recipe.views = {128, 1};
  FitOptions options;
  options.nodes_per_axis = 4;
  options.em.max_iterations = 20000;
  options.em.tolerance = -1.0;  // to the last one
  options.em.accelerate = false;
  recipe.views = {2, 1};
  CHECK(measured_peak(recipe, options) <= fit_memory_bound(recipe, options));
  options.em.max_iterations = 3;
  recipe.views = {256, 1};
  CHECK(measured_peak(recipe, options) <= fit_memory_bound(recipe, options));
}

}  // namespace
}  // namespace lobelight
