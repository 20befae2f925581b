#pragma once

#include <vector>

#include "base/progress.h"
#include "fit/mixture.h"
#include "fit/slice.h"

namespace lobelight {

struct EmOptions {
  int max_iterations = 200;
  // Stops when an iteration raises the log-likelihood (mean over the slice's mass, in nats) by less
  // than this.
  double tolerance = 1e-7;
  // Bounds that keep collapsing lobes finite: least share of the mass, greatest sharpness.
  double weight_floor = 1e-12;
  double kappa_max = 1e8;
  // Asked to cancel between iterations when not null.
  const Progress* progress = nullptr;
};

struct EmResult {
  Mixture mixture;                     // weights sum to the slice's albedo
  std::vector<double> log_likelihood;  // before the first iteration and after each
  int iterations = 0;
  bool converged = false;  // the tolerance was met within max_iterations
};

// Maximum-likelihood mixture for the slice (Töral 2015, eqs. 2.5 and 2.6) by expectation
// maximisation from `start`, whose lobes keep their order. Throws std::invalid_argument for a start
// without lobes.
EmResult run_em(const Slice& slice, Mixture start, const EmOptions& options = {});

}  // namespace lobelight
