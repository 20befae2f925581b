// Error of a table against the time that its fit takes:  lobelight_curve [--quick]
//
// Nodes per axis and iterations are varied, for EM as in the textbook and accelerated, with no
// tolerance: every view takes the iterations that it is given. One thread, processor time, the best
// of two runs. Prints CSV; errors as in table_errors.h, in per cent.

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <vector>

#include "fit/table_fitter.h"
#include "table_errors.h"

namespace {

using namespace lobelight;

struct Material {
  const char* brdf;
  glm::dvec2 alpha;
};

void measure(const Material& material, bool accelerate, int nodes, int iterations, int runs) {
  Recipe recipe;
  recipe.brdf = material.brdf;
  recipe.alpha = material.alpha;
  recipe.threads = 1;
  FitOptions options;
  options.nodes_per_axis = nodes;
  options.em.accelerate = accelerate;
  options.em.max_iterations = iterations;
  options.em.tolerance = -1.0;
  double seconds = 1e300;
  TableErrors errors;
  for (int run = 0; run < runs; ++run) {
    Progress progress;
    const std::clock_t before = std::clock();
    const LobeTable table = fit_table(recipe, progress, nullptr, options);
    seconds = std::min(seconds, static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
    if (run > 0) continue;
    errors = table_errors(table, *make_brdf(material.brdf, material.alpha));
  }
  std::printf("%s,%g,%g,%d,%d,%d,%.5f,%.4f,%.4f\n", material.brdf, material.alpha.x,
              material.alpha.y, accelerate, nodes, iterations, seconds,
              errors.at_views.mean_per_cent(), errors.between_views.mean_per_cent());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
  const std::vector<Material> materials =
      quick
          ? std::vector<Material>{{"ward", {0.1, 0.1}}}
          : std::vector<Material>{{"ward", {0.1, 0.1}}, {"ward", {0.05, 0.2}}, {"ggx", {0.1, 0.1}}};
  const std::vector<int> node_counts =
      quick ? std::vector<int>{16, 64} : std::vector<int>{16, 32, 64, 96};
  const std::vector<int> iteration_counts =
      quick ? std::vector<int>{5, 40} : std::vector<int>{3, 6, 12, 25, 50, 100, 200};
  std::printf("brdf,alpha_x,alpha_y,accelerated,nodes_per_axis,iterations,seconds,at,between\n");
  try {
    for (const Material& material : materials) {
      for (const bool accelerate : {false, true}) {
        for (const int nodes : node_counts) {
          for (const int iterations : iteration_counts) {
            measure(material, accelerate, nodes, iterations, quick ? 1 : 2);
          }
        }
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lobelight_curve: %s\n", error.what());
    return 1;
  }
  return 0;
}
