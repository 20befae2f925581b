#include "fit/memory.h"

#include <algorithm>

#include "base/parallel.h"
#include "fit/picture_error.h"

namespace lobelight {

std::size_t fit_memory_bound(const Recipe& recipe, const FitOptions& options) {
  const auto count = [](int value) { return static_cast<std::size_t>(std::max(value, 0)); };
  const glm::ivec2 grid = resolve_views(recipe);
  const std::size_t views = count(grid.x) * count(grid.y);
  const std::size_t lobes = count(recipe.lobes);
  const std::size_t axis = (count(options.nodes_per_axis) + 3) / 4 * 4;
  const std::size_t nodes = axis * axis;
  const std::size_t iterations = count(options.em.max_iterations);
  const std::size_t threads = std::min(views, count(resolve_threads(recipe.threads)));
  // Two more tables and what they are compared by: it has slices of its own.
  const std::size_t arcs =
      looks_at_arcs(recipe, recipe.brdf, recipe.alpha)
          ? 64 * views * lobes + PictureError::memory_bound(grid) + threads * 32 * 64 * 64
          : 0;
  const std::size_t em = threads * (96 * nodes + 4096 * (lobes + 1) + 32 * (iterations + 1));
  // One more table, each view's coefficients, and a slice before and after nodes are left out. What
  // measurements are as wide as is not known yet.
  const bool may_be_wide = recipe.placement == Placement::automatic &&
                           recipe.method == FitMethod::continuation && !recipe.refine &&
                           recipe.alpha.x == recipe.alpha.y;
  const std::size_t squares = may_be_wide ? views * (32 * lobes + 640) + 64 * nodes : 0;
  return 64 * 1024 + arcs + views * (32 * lobes + 16) + std::max(em, squares);
}

}  // namespace lobelight
