#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fit/mirror.h"
#include "fit/view_fitter.h"

namespace lobelight {

// Fits a table so that lobe k of neighbouring views is the same lobe. The pole (the view along the
// normal) is fitted first. Then each column of views is fitted from the pole outwards, every view
// starting from lobes close to its own. Last, the columns are smoothed, because lobes may have
// drifted on the way.

// The lobes that a view's fit starts from, and which of them are to stay mirror images.
struct ViewStart {
  Mixture lobes;
  std::vector<Mirror> mirrors;
};

// Called for t = 1, 2 … of a column with the fitted lobes of the view before.
using NextStart = std::function<ViewStart(int t, const Mixture& previous)>;

// Makes the starts of column p; `pole_mirrors` are the mirror images at the pole. Called from many
// threads.
using ColumnStarts = std::function<NextStart(int p, const std::vector<Mirror>& pole_mirrors)>;

// Starts every view from its neighbour's lobes: in half-vector form they hardly move.
ColumnStarts neighbours_lobes(const LobeTable& table);

struct Continuation {
  const Brdf& brdf;
  std::uint64_t seed = 0;
  int threads = 0;      // zero or negative: every core
  bool refine = false;  // whether views are refined in the end (fit/refinement.h)
  FitOptions options;
};

// Fits all of `table`. The pole's fit starts from `pole` or, if that is empty, from Töral's guess
// (fit/initial_guess.h). The result does not depend on the number of threads. `report` may be null;
// otherwise it has an element for each view. Throws Cancelled.
void continue_over_views(const Continuation& how, Mixture pole, const ColumnStarts& starts,
                         LobeTable& table, Progress& progress, FitReport* report);

// The limit of EmOptions::longest_step in a continuation: with short steps a lobe stays the same
// lobe from view to view.
constexpr double kContinuationStep = 0.1;

// Moves means that are below the horizon to just above it: a slice has no mass below.
void lift_above_horizon(Mixture& mixture);

}  // namespace lobelight
