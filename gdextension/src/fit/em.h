#pragma once

#include <vector>

#include "base/progress.h"
#include "fit/mirror.h"
#include "fit/slice.h"
#include "sg/mixture.h"

namespace lobelight {

struct EmOptions {
  int max_iterations = 200;
  // EM stops when an iteration raises the log-likelihood (mean over the slice's mass, in nats) by
  // less than this.
  double tolerance = 1e-7;
  // Bounds that keep collapsing lobes finite: least share of the mass, greatest sharpness.
  double weight_floor = 1e-12;
  double kappa_max = 1e8;
  // Lobes that are each other's mirror images and stay so: their statistics are pooled, which is
  // the maximisation step of a mixture with tied parameters. The start is made symmetric first.
  std::vector<Mirror> mirrors;
  // Asked between iterations whether to stop; may be null.
  const Progress* progress = nullptr;
};

struct EmResult {
  Mixture mixture;                     // weights sum to the slice's albedo
  std::vector<double> log_likelihood;  // of the start, then after each iteration; never falls
  int iterations = 0;
  bool converged = false;  // stopped by the tolerance, not by max_iterations
};

// Maximum-likelihood mixture for the slice (Töral 2015, eqs. 2.5 and 2.6) by expectation
// maximisation from `start`, whose lobes keep their order. Nodes of weight 0 count for nothing; a
// slice without mass gives the start's lobes with weight 0. Throws std::invalid_argument for a
// start without lobes and Cancelled.
EmResult run_em(const Slice& slice, Mixture start, const EmOptions& options = {});

}  // namespace lobelight
