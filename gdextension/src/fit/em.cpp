#include "fit/em.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fit/em_acceleration.h"
#include "fit/em_pass.h"

namespace lobelight {

namespace {

// A mixture, its log-likelihood, and the mixture that an EM step gives.
struct State {
  Mixture mixture;
  double log_likelihood = 0.0;
  Mixture next;
};

class Em {
 public:
  Em(const Slice& slice, const EmOptions& options) : nodes_(slice), options_(options) {}

  // First makes `mixture` valid: within the bounds, weights summing to 1, mirror images alike.
  State at(Mixture mixture);

 private:
  void clamp_and_normalise(Mixture& mixture) const;
  void pool_images();
  Mixture maximised(const Mixture& mixture);

  EmNodes nodes_;
  const EmOptions& options_;
  std::vector<EmMoments> moments_;
  EmWorkspace workspace_;
};

void Em::clamp_and_normalise(Mixture& mixture) const {
  double sum = 0.0;
  for (Lobe& lobe : mixture) {
    if (!(lobe.weight >= options_.weight_floor)) lobe.weight = options_.weight_floor;
    if (!(lobe.gaussian.kappa >= 0.0)) lobe.gaussian.kappa = 0.0;
    lobe.gaussian.kappa = std::min(lobe.gaussian.kappa, options_.kappa_max);
    sum += lobe.weight;
  }
  for (Lobe& lobe : mixture) lobe.weight /= sum;
}

State Em::at(Mixture mixture) {
  State state;
  clamp_and_normalise(mixture);
  symmetrise(mixture, options_.mirrors);
  state.log_likelihood = em_pass(nodes_, mixture, moments_, workspace_);
  state.next = maximised(mixture);
  state.mixture = std::move(mixture);
  return state;
}

// Tied lobes have means that are each other's images, and so have moments about them.
void Em::pool_images() {
  for (const Mirror& mirror : options_.mirrors) {
    const std::vector<EmMoments> before = moments_;
    for (std::size_t k = 0; k < moments_.size(); ++k) {
      const EmMoments& other = before[static_cast<std::size_t>(mirror.image[k])];
      EmMoments& own = moments_[k];
      own.weight = 0.5 * (own.weight + other.weight);
      own.shift = 0.5 * (own.shift + reflected(other.shift, mirror.axis));
      own.spread = 0.5 * (own.spread + other.spread);
    }
  }
}

Mixture Em::maximised(const Mixture& mixture) {
  pool_images();
  Mixture next = mixture;
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const EmMoments& s = moments_[k];
    Lobe& lobe = next[k];
    lobe.weight = s.weight;
    // A lobe without mass, or whose nodes cancel, keeps its mean.
    const glm::dvec3 mean = mixture[k].gaussian.mean;
    const glm::dvec3 sum = s.weight * mean + s.shift;
    const double length = glm::length(sum);
    if (length > 1e-300) lobe.gaussian.mean = sum / length;
    if (s.weight > options_.weight_floor) {
      // About the new mean μ + δ: Σ γ |x − μ − δ|² = Σ γ |x − μ|² − 2 δ · Σ γ (x − μ) + |δ|² Σ γ.
      // 1 − R̄ = Σ γ |x − μ|² / 2 Σ γ is exact for unit vectors; 1 − |Σ γ x| / Σ γ would cancel.
      const glm::dvec3 moved = lobe.gaussian.mean - mean;
      const double spread =
          s.spread - 2.0 * glm::dot(moved, s.shift) + s.weight * glm::dot(moved, moved);
      lobe.gaussian.kappa = kappa_from_one_minus_mean_resultant(0.5 * spread / s.weight);
    }
  }
  clamp_and_normalise(next);
  return next;
}

}  // namespace

EmResult run_em(const Slice& slice, Mixture start, const EmOptions& options) {
  if (start.empty()) throw std::invalid_argument("run_em needs at least one lobe to start from.");
  for (const Lobe& lobe : start) {
    if (!is_usable(lobe.gaussian.mean, 1.0)) {
      throw std::invalid_argument("run_em needs a start whose means are unit vectors.");
    }
  }
  if (!is_usable(slice)) return run_em(usable_nodes(slice), std::move(start), options);
  EmResult result;
  if (!(slice.albedo > 0.0)) {
    for (Lobe& lobe : start) {
      lobe.weight = 0.0;
      // NaN fails the first comparison.
      const double kappa = lobe.gaussian.kappa;
      lobe.gaussian.kappa = kappa >= 0.0 ? std::min(kappa, options.kappa_max) : 0.0;
    }
    result.mixture = std::move(start);
    result.converged = true;
    return result;
  }

  Em em(slice, options);
  EmAcceleration acceleration(options.longest_step);
  State state = em.at(std::move(start));
  result.log_likelihood.push_back(state.log_likelihood);
  while (result.iterations < options.max_iterations && !result.converged) {
    if (options.progress) options.progress->throw_if_cancelled();
    State next =
        em.at(options.accelerate ? acceleration.propose(state.mixture, state.next) : state.next);
    // An accelerated step may lower the likelihood; then EM's own, which never does, is taken.
    if (options.accelerate && !(next.log_likelihood >= state.log_likelihood)) {
      next = em.at(state.next);
    }
    const double gain = next.log_likelihood - state.log_likelihood;
    state = std::move(next);
    result.log_likelihood.push_back(state.log_likelihood);
    ++result.iterations;
    result.converged = gain < options.tolerance;
  }
  result.mixture = std::move(state.mixture);
  for (Lobe& lobe : result.mixture) lobe.weight *= slice.albedo;
  return result;
}

}  // namespace lobelight
