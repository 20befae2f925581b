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
  // The last log-likelihood of each view, as a mean over the slice's mass in nats: of the Gaussians
  // or, in refined tables, of the densities that are drawn. Lobes by least squares may have
  // negative weights and no likelihood; this is then that of EM's lobes before them.
  std::vector<double> log_likelihood;
  std::vector<double> first_view_curve;  // log-likelihood of view (0, 0), iteration by iteration
  // The reach of arcs (fit/placement.h), which take no iterations; 0 for other lobes.
  double arc_reach = 0.0;
  bool is_by_squares = false;  // whether the lobes are those of fit/wide_lobes.h
};

// Options that a recipe does not have. Every baked table uses the values here; tests and benchmarks
// vary them.
struct FitOptions {
  int nodes_per_axis = 64;
  EmOptions em;
  // Where many arrangements of the lobes are about equally good, lobes may drift from view to view,
  // and the table is then worse between views than at them. So after a continuation each inner view
  // of a column is fitted again this many times, for kSmoothingIterations, starting from the mean
  // of itself and its two neighbours in table coordinates. Half-way between views this lowers the
  // worst L1 error by up to half. 0 leaves it out.
  int smoothing_passes = 3;
  // Iterations of refinement for each view of a recipe with `refine`; smoothed views get half as
  // many again.
  int refinement_iterations = 20;
};

// Iterations of a view when it is smoothed. They are few: where the likelihood is indifferent,
// lobes stay where smoothing has put them.
constexpr int kSmoothingIterations = 10;

// Fits single views of a table. Different views may be fitted at the same time: a fit reads and
// writes its own view only, in the table and in the report.
class ViewFitter {
 public:
  // `fits` is the number of calls of fit() and refine() after which the progress is 1. All
  // arguments but `options` must outlive this object; `report` may be null.
  ViewFitter(const Brdf& brdf, LobeTable& table, const FitOptions& options, std::uint64_t seed,
             int fits, Progress& progress, FitReport* report);

  Slice slice(int t, int p) const;

  // Fits the lobes of view (t, p) and stores them, with weights for each channel if the BRDF is
  // coloured (fit/channel_weights.h). It starts from `start` or, if that is empty, from Töral's
  // guess. Returns the lobes before the table's rounding. Throws Cancelled.
  Mixture fit(int t, int p, Mixture start, std::vector<Mirror> mirrors, int max_iterations);

  // Refines `start` as the lobes of view (t, p) (fit/refinement.h), and stores them.
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
