#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fit/mirror.h"
#include "fit/view_fitter.h"

namespace lobelight {

// Fits a table so that lobe k of neighbouring views is the same lobe: first the pole, then column
// by column outwards, every view from lobes near its own; then what wandered on the way is
// smoothed.

// What a view's fit starts from, and what ties its lobes.
struct ViewStart {
  Mixture lobes;
  std::vector<Mirror> mirrors;
};

// Called for t = 1, 2 … of one column, with the lobes of the view before as they were fitted.
using NextStart = std::function<ViewStart(int t, const Mixture& previous)>;

// The starts of column p; `pole_mirrors` tie the lobes at the pole. Called from many threads.
using ColumnStarts = std::function<NextStart(int p, const std::vector<Mirror>& pole_mirrors)>;

// Every view from its neighbour's lobes, which hardly move in half-vector form.
ColumnStarts neighbours_lobes(const LobeTable& table);

struct Continuation {
  const Brdf& brdf;
  std::uint64_t seed = 0;
  int threads = 0;      // zero or negative: every core
  bool refine = false;  // whether views are refined in the end (fit/refinement.h)
  FitOptions options;
};

// Fits all of `table`, its pole from `pole` or, where that is empty, from Töral's guess. The result
// does not depend on the number of threads. `report`, which may be null, has a place for each view.
// Throws Cancelled.
void continue_over_views(const Continuation& how, Mixture pole, const ColumnStarts& starts,
                         LobeTable& table, Progress& progress, FitReport* report);

// What EmOptions::longest_step is at most while lobes are carried on from view to view: short
// steps, so that lobes stay what they are.
constexpr double kContinuationStep = 0.1;

// Lobes that start below the horizon, where a slice has no mass, are put just above it.
void lift_above_horizon(Mixture& mixture);

}  // namespace lobelight
