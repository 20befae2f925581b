#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "fit/placement.h"
#include "fit/view_fitter.h"
#include "table/lobe_table.h"

namespace lobelight {

enum class FitMethod {
  independent,   // every view by itself, as Töral 2015 does; neighbours cannot be interpolated
  continuation,  // every view from its neighbour's lobes, from normal incidence outwards
};

// "independent", "continuation"; the inverse throws std::invalid_argument naming the known ones.
std::string_view to_string(FitMethod method);
FitMethod fit_method_from_string(std::string_view name);

struct Recipe {
  std::string brdf = "ward";   // as make_brdf() takes it: a model's name or a file's path
  glm::dvec2 alpha{0.1, 0.1};  // (0, 0) for files: estimated
  int lobes = 8;
  // Elevations × azimuths; 0 = default: 16 × 1 for isotropic materials, 16 × 8 for others.
  glm::ivec2 views{0, 0};
  FitMethod method = FitMethod::continuation;
  // Whether the lobes are fitted to what is drawn in their place after they have been fitted as
  // Gaussians (fit/refinement.h).
  bool refine = false;
  // How lobes are placed (fit/placement.h), and, for arcs, how far they reach along the highlight,
  // in slopes over alpha. A reach of 0 is chosen by the error of a picture. Independent fits are
  // always EM's.
  Placement placement = Placement::automatic;
  double reach = 0.0;
  std::uint64_t seed = 0;
  int threads = 0;  // zero or negative: every core
};

constexpr int kMaxLobes = 32;
constexpr int kMaxViews = 256;

// Throws std::invalid_argument with one sentence that names the key and the value. Files are not
// read: what is wrong with one shows when it is fitted.
void validate(const Recipe& recipe);

// The recipe's views with the defaults filled in for a material that is isotropic or is not; a
// model is isotropic if both widths are equal.
glm::ivec2 resolve_views(const Recipe& recipe, bool isotropic);
glm::ivec2 resolve_views(const Recipe& recipe);

// Whether a fit of the recipe also looks at lobes along the highlight.
bool looks_at_arcs(const Recipe& recipe, std::string_view brdf, const glm::dvec2& alpha);

// Fits the recipe's table. Lobes of a coloured BRDF are fitted to the mean of its channels and get
// weights for each channel (fit/channel_weights.h). The bytes are the same for any number of
// threads. Throws what validate() and make_brdf() throw, std::invalid_argument if a file's numbers
// give weights that a table cannot hold, and Cancelled. `report` may be null.
LobeTable fit_table(const Recipe& recipe, Progress& progress, FitReport* report,
                    const FitOptions& options = {});

// The same for a given BRDF; the recipe's `brdf` and `alpha` are ignored.
LobeTable fit_table(const Brdf& brdf, const Recipe& recipe, Progress& progress, FitReport* report,
                    const FitOptions& options = {});

}  // namespace lobelight
