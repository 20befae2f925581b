#pragma once

// Objective: the mixture Σ_k π_k g(x; μ_k, κ_k), Σ_k π_k = 1, that maximises the log-likelihood
//
//   L = Σ_n w_n / W · ln Σ_k π_k g(x_n; μ_k, κ_k),   W = Σ_n w_n
//
// over a slice's nodes x_n of weight w_n. Up to a constant, −L is the Kullback–Leibler divergence
// from the slice, as a density, to the mixture: what is bright must be covered, and what is dark
// may be. It says nothing of how much light there is; that is why the result's weights are scaled:
// a lobe's weight is π_k · W, the part of the directional albedo that it stands for, and the
// weights sum to the albedo that the quadrature gives.
//
// Each iteration is one pass over the nodes (fit/em_pass.h), two where an accelerated step was of
// no use. It stops by `tolerance` or at `max_iterations`; the likelihood never falls on the way.
// The result is the same to the last bit for any thread count and any width of SIMD registers.
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
  // Steps longer than EM's where they raise the likelihood (fit/em_acceleration.h): a quarter of
  // the iterations. Without, this is EM as in the textbook.
  bool accelerate = true;
  // How far an accelerated step may go: means by so many standard deviations, weights and
  // sharpnesses by so much in their logarithm. 0.3 needs the fewest iterations. With shorter steps
  // lobes end up closer to where they began; with 0.05 they get stuck.
  double longest_step = 0.3;
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
// maximisation from `start`, whose lobes keep their order. Nodes that is_usable() refuses count for
// nothing; a slice without mass gives the start's lobes with weight 0. A start may hold any weights
// and sharpnesses: what is not a number counts as 0. Throws std::invalid_argument for a start
// without lobes or with means that are not unit vectors, and as usable_nodes() does, and Cancelled.
EmResult run_em(const Slice& slice, Mixture start, const EmOptions& options = {});

}  // namespace lobelight
