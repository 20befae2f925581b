// Time, memory and error of table fitting:  lobelight_bench [LOBES [ELEVATIONS AZIMUTHS]]
//
// For every material and method: seconds on the clock and of processor time, iterations per view,
// mean log-likelihood, and the L1 error of the mixture against ρ(i, o) i_z (mean and worst over
// views, in per cent of the albedo) at the views of the grid and half-way between them. Independent
// tables are read at the nearest view, the others by interpolation.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#endif

#include "fit/table_fitter.h"
#include "table_errors.h"

namespace {

using namespace lobelight;

// Peak resident memory of this process so far in MiB, 0 where it cannot be asked for.
double peak_memory() {
#if defined(__APPLE__)
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1048576.0;
#elif defined(__unix__)
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
#else
  return 0.0;
#endif
}

template <typename T>
double mean(const std::vector<T>& values) {
  return static_cast<double>(std::accumulate(values.begin(), values.end(), T(0))) /
         static_cast<double>(values.size());
}

void measure(const Recipe& recipe, bool keep_symmetry, const char* label) {
  FitOptions options;
  options.keep_mirror_symmetry = keep_symmetry;
  Progress progress;
  FitReport report;
  const std::clock_t before = std::clock();
  const LobeTable table = fit_table(recipe, progress, &report, options);
  const double processor = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  const auto brdf = make_brdf(recipe.brdf, recipe.alpha);

  const TableErrors errors = table_errors(table, *brdf, recipe.method == FitMethod::independent);
  const glm::ivec2 views = table.views();
  std::printf(
      "%-5s %-12s %2d %3dx%-3d %-14s %7.2f %7.2f %6.0f %9.5f %7.2f %7.2f %7.2f %7.2f %6.1f\n",
      recipe.brdf.c_str(),
      (std::to_string(recipe.alpha.x).substr(0, 4) + "," +
       std::to_string(recipe.alpha.y).substr(0, 4))
          .c_str(),
      recipe.lobes, views.x, views.y, label, report.seconds, processor, mean(report.iterations),
      mean(report.log_likelihood), errors.at_views.mean_per_cent(),
      errors.at_views.worst_per_cent(), errors.between_views.mean_per_cent(),
      errors.between_views.worst_per_cent(), peak_memory());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  struct Material {
    const char* brdf;
    glm::dvec2 alpha;
  };
  constexpr Material kMaterials[] = {
      {"ward", {0.01, 0.01}}, {"ward", {0.1, 0.1}},  {"ward", {0.2, 0.2}}, {"ward", {0.05, 0.2}},
      {"ward", {0.05, 0.5}},  {"ward", {0.01, 0.2}}, {"ggx", {0.1, 0.1}},  {"ggx", {0.05, 0.2}},
  };
  std::printf(
      "brdf  alpha         K views   method         seconds  proc. s  iter.  log-lik.     at   "
      "worst"
      " between   worst    MiB\n");
  try {
    for (const Material& material : kMaterials) {
      Recipe recipe;
      recipe.brdf = material.brdf;
      recipe.alpha = material.alpha;
      if (argc > 1) recipe.lobes = std::atoi(argv[1]);
      if (argc > 3) recipe.views = {std::atoi(argv[2]), std::atoi(argv[3])};
      if (material.alpha.x == material.alpha.y) recipe.views.y = 0;
      recipe.method = FitMethod::independent;
      measure(recipe, true, "independent");
      recipe.method = FitMethod::continuation;
      measure(recipe, false, "cont. untied");
      measure(recipe, true, "continuation");
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lobelight_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
