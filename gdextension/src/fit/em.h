#pragma once

// Objective: the mixture Σ_k π_k g(x; μ_k, κ_k), Σ_k π_k = 1, that maximises the log-likelihood
//
//   L = Σ_n w_n / W · ln Σ_k π_k g(x_n; μ_k, κ_k),   W = Σ_n w_n
//
// over a slice's nodes x_n of weight w_n. Up to a constant, −L is the Kullback–Leibler divergence
// from the slice, taken as a density, to the mixture: it grows fast where the slice is bright and
// the mixture is not. L does not depend on the total light, so the result is scaled: a lobe's
// weight is π_k · W, and the weights sum to the slice's albedo.
//
// An iteration is one pass over the nodes (fit/em_pass.h), or two if an accelerated step is
// rejected. Iterations end by `tolerance` or at `max_iterations`; the likelihood never falls. The
// result is the same to the last bit for any thread count and any width of SIMD registers.
//
// fit/memory.h bounds the memory.

#include <vector>

#include "base/progress.h"
#include "fit/mirror.h"
#include "fit/slice.h"
#include "sg/mixture.h"

namespace lobelight {

struct EmOptions {
  int max_iterations = 200;
  // Stops when an iteration raises the log-likelihood (mean over the slice's mass, in nats) by less
  // than this. Accelerated, 1e-6 gets as far as EM alone does with 1e-7 in 200 iterations
  // (docs/report/bench).
  double tolerance = 1e-6;
  // Takes longer steps than EM's where they raise the likelihood (fit/em_acceleration.h), which
  // needs a quarter of the iterations. Without it, this is textbook EM.
  bool accelerate = true;
  // The longest accelerated step: means move by at most so many standard deviations, the logarithms
  // of weights and sharpnesses by at most this. 0.3 needs the fewest iterations. With shorter steps
  // lobes stay closer to the start; with 0.05 they get stuck.
  double longest_step = 0.3;
  // Bounds that keep collapsing lobes finite: the least share of the mass, the greatest sharpness.
  double weight_floor = 1e-12;
  double kappa_max = 1e8;
  // Lobes that are to stay each other's mirror images. The start is made symmetric, and each step
  // averages their statistics: the maximisation step of a mixture with tied parameters.
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

// The maximum-likelihood mixture of the slice (Töral 2015, eqs. 2.5 and 2.6), by expectation
// maximisation from `start`. Lobes keep their order. Nodes that is_usable() refuses are ignored. A
// slice without mass gives the start's lobes with weight 0. The start may have any weights and
// sharpnesses; NaN counts as 0. Throws std::invalid_argument if the start has no lobes or a mean
// that is no unit vector, what usable_nodes() throws, and Cancelled.
EmResult run_em(const Slice& slice, Mixture start, const EmOptions& options = {});

}  // namespace lobelight
