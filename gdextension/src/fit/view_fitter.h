#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "brdf/brdf.h"
#include "fit/em.h"
#include "fit/slice.h"
#include "table/lobe_table.h"

namespace lobelight {

// How a fit went. View (t, p) is element p · T + t.
struct FitReport {
  double seconds = 0.0;
  std::vector<int> iterations;
  // Final, mean over the slice's mass in nats: of the Gaussians or, refined, of what is drawn.
  // Lobes by least squares may be negative and have none: it is that of the lobes before.
  std::vector<double> log_likelihood;
  std::vector<double> first_view_curve;  // log-likelihood of view (0, 0), iteration by iteration
  // Of lobes along the highlight (fit/placement.h), which take no iterations: how far they reach.
  double arc_reach = 0.0;
  bool is_by_squares = false;  // whether the lobes are those of fit/wide_lobes.h
};

// What a recipe does not say, with the values that every baked table uses; tests and benchmarks
// vary them.
struct FitOptions {
  int nodes_per_axis = 64;
  EmOptions em;
  // Lobes may wander on the way from view to view where many arrangements are about equally good,
  // and tables are then worse between views than at them. After the continuation, every inner view
  // of a column is fitted again this often, for kSmoothingIterations from the mean of itself and
  // its two neighbours in table coordinates (continuation only; 0 leaves it out). Half-way between
  // views this lowers the worst L1 error by up to half.
  int smoothing_passes = 3;
  // Of each view of a recipe that says `refine`; half as many once more where views are smoothed.
  int refinement_iterations = 20;
};

// How many iterations a view is given when it is smoothed: so few that the lobes stay where they
// were put as far as the likelihood does not care.
constexpr int kSmoothingIterations = 10;

// Fits the views of one table, each by itself. Different views may be fitted at the same time: a
// fit reads and writes nothing of the table and of the report but its own view's.
class ViewFitter {
 public:
  // `fits`: how many calls of fit() and refine() make the whole progress. All but `options` outlive
  // this object; `report` may be null.
  ViewFitter(const Brdf& brdf, LobeTable& table, const FitOptions& options, std::uint64_t seed,
             int fits, Progress& progress, FitReport* report);

  Slice slice(int t, int p) const;

  // Fits the lobes of view (t, p) from `start` on, or from Töral's guess where it is empty, and
  // stores them; a coloured BRDF's with weights for each channel (fit/channel_weights.h). Returns
  // them as they were before they were stored. Throws Cancelled.
  Mixture fit(int t, int p, Mixture start, std::vector<Mirror> mirrors, int max_iterations);

  // Refines the lobes of view (t, p) from `start` on (fit/refinement.h), and stores them.
  void refine(int t, int p, Mixture start, const std::vector<Mirror>& mirrors, int max_iterations);

 private:
  void finish(int t, int p, int iterations, const std::vector<double>& log_likelihood);

  const Brdf& brdf_;
  LobeTable& table_;
  int nodes_per_axis_;
  EmOptions em_;
  double rotation_;
  int fits_;
  std::atomic<int> finished_{0};
  Progress& progress_;
  FitReport* report_;
};

}  // namespace lobelight
