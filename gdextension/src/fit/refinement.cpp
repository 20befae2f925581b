#include "fit/refinement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "fit/lbfgs.h"
#include "fit/pyramid_kernel.h"

namespace lobelight {

namespace {

// Wider lobes than this variance are all but uniform.
constexpr double kWidest = 16.0;

double squared_chord(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = a - b;
  return glm::dot(d, d);
}

double variance_of(const SphericalGaussian& gaussian) {
  return 1.0 / std::max(gaussian.kappa, 1.0 / kWidest);
}

// Per lobe: what the pass over the nodes needs, and the sums that it collects.
struct Drawn {
  DrawnLobe lobe;
  glm::dvec3 mean;
  double weight;
  DrawnLobe::Value value{};   // at the present node
  double density_sum = 0.0;   // Σ_n c_n q, c_n = w_n / (W Σ_k π_k q_k)
  double variance_sum = 0.0;  // Σ_n c_n ∂q / ∂ log V
  glm::dvec3 mean_sum{0.0};   // Σ_n c_n ∂q / ∂μ
};

}  // namespace

RefinementObjective::RefinementObjective(const Slice& slice, Mixture start,
                                         const RefinementOptions& options)
    : slice_(slice), options_(options), start_(std::move(start)) {
  symmetrise(start_, options_.mirrors);
  double sum = 0.0;
  for (Lobe& lobe : start_) {
    // NaN fails the first comparison.
    if (!(lobe.weight >= options_.weight_floor)) lobe.weight = options_.weight_floor;
    if (!(lobe.gaussian.kappa >= 1.0 / kWidest)) lobe.gaussian.kappa = 1.0 / kWidest;
    lobe.gaussian.kappa = std::min(lobe.gaussian.kappa, options_.kappa_max);
    sum += lobe.weight;
  }
  for (Lobe& lobe : start_) lobe.weight /= sum;
}

Mixture RefinementObjective::mixture(const std::vector<double>& x) const {
  Mixture mixture = start_;
  double sum = 0.0;
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const double* own = &x[5 * k];
    SphericalGaussian& gaussian = mixture[k].gaussian;
    const double deviation = 1.0 / std::sqrt(gaussian.kappa);
    gaussian.mean = glm::normalize(gaussian.mean + deviation * glm::dvec3(own[0], own[1], own[2]));
    gaussian.kappa =
        std::clamp(gaussian.kappa * std::exp(-own[3]), 1.0 / kWidest, options_.kappa_max);
    mixture[k].weight = std::max(mixture[k].weight * std::exp(own[4]), options_.weight_floor);
    sum += mixture[k].weight;
  }
  for (Lobe& lobe : mixture) lobe.weight /= sum;
  return mixture;
}

void RefinementObjective::make_symmetric(std::vector<double>& x) const {
  for (const Mirror& mirror : options_.mirrors) {
    for (std::size_t k = 0; k < start_.size(); ++k) {
      const auto other = static_cast<std::size_t>(mirror.image[k]);
      if (other < k) continue;  // done with it
      for (std::size_t i = 0; i < 5; ++i) {
        const double sign = i == static_cast<std::size_t>(mirror.axis) ? -1.0 : 1.0;
        const double mean = 0.5 * (x[5 * k + i] + sign * x[5 * other + i]);
        x[5 * k + i] = mean;
        // A lobe that is its own image has no component across the plane by now.
        x[5 * other + i] = sign * mean;
      }
    }
  }
}

double RefinementObjective::operator()(const std::vector<double>& x,
                                       std::vector<double>& gradient) const {
  const Mixture mixture = this->mixture(x);
  std::vector<Drawn> drawn;
  drawn.reserve(mixture.size());
  for (const Lobe& lobe : mixture) {
    if (!(lobe.gaussian.mean.z > 0.0)) return std::numeric_limits<double>::infinity();
    drawn.push_back({DrawnLobe(variance_of(lobe.gaussian)), lobe.gaussian.mean, lobe.weight});
  }

  double log_likelihood = 0.0;
  for (std::size_t n = 0; n < slice_.weights.size(); ++n) {
    const glm::dvec3& direction = slice_.directions[n];
    double density = 0.0;
    for (Drawn& lobe : drawn) {
      lobe.value = lobe.lobe.at(squared_chord(direction, lobe.mean));
      density += lobe.weight * lobe.value.density;
    }
    const double share = slice_.weights[n] / slice_.albedo;
    log_likelihood += share * std::log(density);
    const double scale = share / density;
    for (Drawn& lobe : drawn) {
      lobe.density_sum += scale * lobe.value.density;
      lobe.variance_sum += scale * lobe.value.by_log_variance;
      // ∂|x − μ|² / ∂μ = −2 (x − μ)
      lobe.mean_sum -= 2.0 * scale * lobe.value.by_distance * (direction - lobe.mean);
    }
  }

  double weighted_sum = 0.0;
  for (const Drawn& lobe : drawn) weighted_sum += lobe.weight * lobe.density_sum;
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    const Drawn& lobe = drawn[k];
    const SphericalGaussian& start = start_[k].gaussian;
    double* own = &gradient[5 * k];
    // ∂μ / ∂shift for μ = (μ₀ + σ shift) / |μ₀ + σ shift|.
    const double deviation = 1.0 / std::sqrt(start.kappa);
    const double length =
        glm::length(start.mean + deviation * glm::dvec3(x[5 * k], x[5 * k + 1], x[5 * k + 2]));
    const glm::dvec3 tangential = lobe.mean_sum - lobe.mean * glm::dot(lobe.mean, lobe.mean_sum);
    const glm::dvec3 by_shift = lobe.weight * deviation / length * tangential;
    for (int i = 0; i < 3; ++i) own[i] = -by_shift[i];
    own[3] = -lobe.weight * lobe.variance_sum;
    own[4] = -lobe.weight * (lobe.density_sum - weighted_sum);
  }
  make_symmetric(gradient);
  return -log_likelihood;
}

RefinementResult refine(const Slice& slice, Mixture start, const RefinementOptions& options) {
  if (!is_usable(slice)) return refine(usable_nodes(slice), std::move(start), options);
  RefinementResult result;
  if (!(slice.albedo > 0.0)) {
    result.mixture = std::move(start);
    for (Lobe& lobe : result.mixture) lobe.weight = 0.0;
    return result;
  }
  const RefinementObjective objective(slice, std::move(start), options);
  LbfgsOptions lbfgs;
  lbfgs.max_iterations = options.max_iterations;
  lbfgs.tolerance = options.tolerance;
  lbfgs.progress = options.progress;
  const LbfgsResult minimum =
      minimise(std::cref(objective), std::vector<double>(objective.size()), lbfgs);
  result.mixture = objective.mixture(minimum.x);
  symmetrise(result.mixture, options.mirrors);
  for (Lobe& lobe : result.mixture) lobe.weight *= slice.albedo;
  for (const double value : minimum.values) result.log_likelihood.push_back(-value);
  result.iterations = static_cast<int>(minimum.values.size()) - 1;
  return result;
}

std::vector<double> drawn_log_densities(const Slice& slice, const Mixture& mixture) {
  std::vector<double> log_densities;
  log_densities.reserve(slice.directions.size() * mixture.size());
  for (const Lobe& lobe : mixture) {
    const DrawnLobe drawn(variance_of(lobe.gaussian));
    for (const glm::dvec3& direction : slice.directions) {
      const double squared = squared_chord(direction, lobe.gaussian.mean);
      log_densities.push_back(std::log(drawn.at(squared).density));
    }
  }
  return log_densities;
}

}  // namespace lobelight
