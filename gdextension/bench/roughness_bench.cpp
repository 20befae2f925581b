// What interpolation over the widths costs:  lobelight_roughness [BRDF [LEVELS [LOBES]]]
//
// Fits a set of tables over widths from 0.005 to 1 and prints, for widths half-way between the
// set's (in triangles next to the diagonal: in their middle), the mean L1 errors of the
// interpolated table and of a table fitted for these very widths, in per cent of the albedo, at the
// views of the grid and half-way between them.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/parallel.h"
#include "fit/roughness_fitter.h"
#include "fit/table_fitter.h"
#include "table_errors.h"

namespace {

using namespace lobelight;

// Cells of the grid, as fractions of its sides: the widths from narrow to wide along the diagonal,
// then pairs of growing ratio.
constexpr double kCells[][2] = {{0.05, 0.05}, {0.25, 0.25}, {0.5, 0.5}, {0.75, 0.75}, {0.55, 0.5},
                                {0.55, 0.4},  {0.75, 0.35}, {0.9, 0.6}, {0.95, 0.7},  {0.6, 0.1}};

std::string row(const SetRecipe& set, const std::vector<std::uint16_t>& texels,
                const glm::dvec2& alpha) {
  Recipe recipe;
  recipe.brdf = set.brdf;
  recipe.alpha = alpha;
  recipe.lobes = set.lobes;
  recipe.views = {set.views.x, alpha.x == alpha.y ? 1 : set.views.y};
  recipe.threads = 1;
  Progress progress;
  const auto brdf = make_brdf(set.brdf, alpha);
  const TableErrors direct = table_errors(fit_table(recipe, progress, nullptr), *brdf, false);
  const TableErrors between = table_errors(interpolate_table_set(set, texels, alpha), *brdf, false);
  char text[160];
  std::snprintf(text, sizeof text, "%-6s %7.4f %7.4f %12.2f %12.2f %12.2f %12.2f", set.brdf.c_str(),
                alpha.x, alpha.y, between.at_views.mean_per_cent(), direct.at_views.mean_per_cent(),
                between.between_views.mean_per_cent(), direct.between_views.mean_per_cent());
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    SetRecipe set;
    if (argc > 1) set.brdf = argv[1];
    const int levels = argc > 2 ? std::atoi(argv[2]) : 21;
    set.widths = geometric_widths(0.005, 1.0, levels);
    if (argc > 3) set.lobes = std::atoi(argv[3]);

    Progress progress;
    const auto start = std::chrono::steady_clock::now();
    const std::vector<std::uint16_t> texels = fit_table_set(set, progress);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf("%s, %d widths, %d lobes: %.1f s, %zu bytes\n", set.brdf.c_str(), levels, set.lobes,
                seconds.count(), texels.size() * sizeof(texels[0]));

    std::vector<glm::dvec2> middles;
    const auto half_way = [&](double place, double part) {
      const auto level = static_cast<std::size_t>(place * (levels - 1));
      return set.widths[level] * std::pow(set.widths[level + 1] / set.widths[level], part);
    };
    for (const auto& cell : kCells) {
      if (cell[0] == cell[1]) {
        middles.emplace_back(half_way(cell[0], 0.5));
        middles.emplace_back(half_way(cell[0], 2.0 / 3.0), half_way(cell[1], 1.0 / 3.0));
      } else {
        middles.emplace_back(half_way(cell[0], 0.5), half_way(cell[1], 0.5));
      }
    }
    std::vector<std::string> rows(middles.size());
    parallel_for(rows.size(), 0, [&](std::size_t n) { rows[n] = row(set, texels, middles[n]); });
    std::printf("brdf   alpha_x alpha_y interpolated       direct  between views\n");
    for (const std::string& text : rows) std::printf("%s\n", text.c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lobelight_roughness: %s\n", error.what());
    return 1;
  }
  return 0;
}
