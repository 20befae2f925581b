#include "fit/view_fitter.h"

#include <utility>

#include "fit/channel_weights.h"
#include "fit/continuation.h"
#include "fit/initial_guess.h"
#include "fit/refinement.h"

namespace lobelight {

ViewFitter::ViewFitter(const Brdf& brdf, LobeTable& table, const FitOptions& options,
                       std::uint64_t seed, int fits, Progress& progress, FitReport* report)
    : brdf_(brdf),
      table_(table),
      nodes_per_axis_(options.nodes_per_axis),
      em_(options.em),
      rotation_(seed_rotation(seed)),
      fits_(fits),
      progress_(progress),
      report_(report) {
  em_.progress = &progress;
}

Slice ViewFitter::slice(int t, int p) const {
  return sample_slice(brdf_, table_.view(t, p), nodes_per_axis_, rotation_);
}

Mixture ViewFitter::fit(int t, int p, Mixture start, std::vector<Mirror> mirrors,
                        int max_iterations) {
  progress_.throw_if_cancelled();
  const Slice slice = this->slice(t, p);
  if (start.empty()) start = initial_guess(slice, table_.lobes());
  EmOptions em = em_;
  em.mirrors = std::move(mirrors);
  em.max_iterations = max_iterations;
  EmResult result = run_em(slice, std::move(start), em);
  table_.set_mixture_at_view(t, p, result.mixture);
  if (table_.has_second_texels()) {
    const auto nodes = channel_node_weights(brdf_, table_.view(t, p), slice);
    table_.set_channel_weights_at_view(t, p, channel_weights(slice, nodes, result.mixture));
  }
  if (report_ && t == 0 && p == 0) report_->first_view_curve = result.log_likelihood;
  finish(t, p, result.iterations, result.log_likelihood);
  return std::move(result.mixture);
}

void ViewFitter::refine(int t, int p, Mixture start, const std::vector<Mirror>& mirrors,
                        int max_iterations) {
  progress_.throw_if_cancelled();
  const Slice slice = this->slice(t, p);
  lift_above_horizon(start);
  RefinementOptions refinement;
  refinement.max_iterations = max_iterations;
  refinement.weight_floor = em_.weight_floor;
  refinement.kappa_max = em_.kappa_max;
  refinement.mirrors = mirrors;
  refinement.progress = &progress_;
  const RefinementResult result = lobelight::refine(slice, std::move(start), refinement);
  table_.set_mixture_at_view(t, p, result.mixture);
  if (table_.has_second_texels()) {
    std::vector<double> weights;
    for (const Lobe& lobe : result.mixture) weights.push_back(lobe.weight);
    table_.set_channel_weights_at_view(
        t, p,
        channel_weights(channel_node_weights(brdf_, table_.view(t, p), slice),
                        drawn_log_densities(slice, result.mixture), weights));
  }
  finish(t, p, result.iterations, result.log_likelihood);
}

void ViewFitter::finish(int t, int p, int iterations, const std::vector<double>& log_likelihood) {
  if (report_) {
    const auto view = static_cast<std::size_t>(p * table_.views().x + t);
    report_->iterations[view] += iterations;
    if (!log_likelihood.empty()) report_->log_likelihood[view] = log_likelihood.back();
  }
  progress_.set(static_cast<double>(++finished_) / fits_);
}

}  // namespace lobelight
