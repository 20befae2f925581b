#pragma once

#include <vector>

#include "base/progress.h"
#include "fit/mirror.h"
#include "fit/slice.h"
#include "sg/mixture.h"

namespace lobelight {

// EM fits Gaussians, but what is drawn are levels of a pyramid (fit/pyramid_kernel.h). Refinement
// starts from EM's lobes and maximises the log-likelihood of fit/em.h
//
//   L = Σ_n w_n / W · ln Σ_k π_k q(x_n; μ_k, 1/κ_k),
//
// for the densities q that are drawn. Likelihood suits what is seen: if the mixture is p + e
// instead of p, L falls by ∫ e²/2p, which weighs errors much as squared differences of
// gamma-encoded pixels do. L-BFGS moves the means and the logarithms of variances and weights, for
// a few iterations only, so that the lobes of neighbouring views stay close.
struct RefinementOptions {
  int max_iterations = 20;
  // Stops when an iteration raises the log-likelihood (nats) by less than this.
  double tolerance = 1e-6;
  // Bounds as in EmOptions.
  double weight_floor = 1e-12;
  double kappa_max = 1e8;
  // Mirror images, as in EmOptions: the start is made symmetric, and steps follow the symmetric
  // part of the gradient.
  std::vector<Mirror> mirrors;
  // Asked between iterations whether to stop; may be null.
  const Progress* progress = nullptr;
};

struct RefinementResult {
  Mixture mixture;                     // weights sum to the slice's albedo
  std::vector<double> log_likelihood;  // of the start, then after each iteration; never falls
  int iterations = 0;
};

// The likelihood of a mixture near `start` as a function of 5 numbers for each lobe: the shift of
// its mean (3 numbers, in standard deviations of the start; the shifted mean is made a unit vector
// again), and the changes of the logarithms of variance and weight. All 0 is the start, made valid
// and symmetric.
class RefinementObjective {
 public:
  // The slice has mass and is_usable(), and outlives this object, as do the options.
  RefinementObjective(const Slice& slice, Mixture start, const RefinementOptions& options);

  std::size_t size() const { return 5 * start_.size(); }

  // −L at x, and its gradient; infinity where a mean is below the horizon.
  double operator()(const std::vector<double>& x, std::vector<double>& gradient) const;

  // The lobes at x; weights sum to 1.
  Mixture mixture(const std::vector<double>& x) const;

 private:
  void make_symmetric(std::vector<double>& x) const;

  const Slice& slice_;
  const RefinementOptions& options_;
  Mixture start_;
};

// As run_em(): refines `start`, whose lobes keep their order, above the horizon. A slice without
// mass gives the start with weights 0. Throws std::invalid_argument as usable_nodes() does, and
// Cancelled.
RefinementResult refine(const Slice& slice, Mixture start, const RefinementOptions& options = {});

// The logarithms of the lobes' densities, as they are drawn, at the slice's nodes, lobe by lobe:
// the argument of channel_weights().
std::vector<double> drawn_log_densities(const Slice& slice, const Mixture& mixture);

}  // namespace lobelight
