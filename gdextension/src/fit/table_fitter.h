#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "fit/em.h"
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

// How a fit went. View (t, p) is element p · T + t.
struct FitReport {
  double seconds = 0.0;
  std::vector<int> iterations;
  // Final, mean over the slice's mass in nats: of the Gaussians or, refined, of what is drawn.
  std::vector<double> log_likelihood;
  std::vector<double> first_view_curve;  // log-likelihood of view (0, 0), iteration by iteration
};

// What a recipe does not say, with the values that every baked table uses; tests and benchmarks
// vary them.
struct FitOptions {
  int nodes_per_axis = 64;
  EmOptions em;
  // Views in the planes of symmetry get lobes that are their own mirror image as a set
  // (continuation only).
  bool keep_mirror_symmetry = true;
  // Lobes may wander on the way from view to view where many arrangements are about equally good,
  // and tables are then worse between views than at them. After the continuation, every inner view
  // of a column is fitted again this often, for kSmoothingIterations from the mean of itself and
  // its two neighbours in table coordinates (continuation only; 0 leaves it out). Half-way between
  // views this lowers the worst L1 error by up to half.
  int smoothing_passes = 3;
  // Of each view of a recipe that says `refine`; half as many once more where views are smoothed.
  int refinement_iterations = 20;
};

// What FitOptions::em.longest_step is at most while lobes are carried on from view to view: short
// steps, so that lobes stay what they are.
constexpr double kContinuationStep = 0.1;

// How many iterations a view is given when it is smoothed: so few that the lobes stay where they
// were put as far as the likelihood does not care.
constexpr int kSmoothingIterations = 10;

// The order in which a column's inner views are smoothed: every other one, then those between them.
std::vector<int> smoothing_order(int elevations);

// Lobes that start below the horizon, where a slice has no mass, are put just above it.
void lift_above_horizon(Mixture& mixture);

// Fits the recipe's table. The lobes of a coloured BRDF are fitted to the mean of its channels and
// get weights for each of them (fit/channel_weights.h). The bytes are the same for any number of
// threads. Throws what validate() and make_brdf() do, and Cancelled. `report` may be null.
LobeTable fit_table(const Recipe& recipe, Progress& progress, FitReport* report,
                    const FitOptions& options = {});

// The same for a BRDF at hand; the recipe's `brdf` and `alpha` count for nothing.
LobeTable fit_table(const Brdf& brdf, const Recipe& recipe, Progress& progress, FitReport* report,
                    const FitOptions& options = {});

}  // namespace lobelight
