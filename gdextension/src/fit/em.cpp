#include "fit/em.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "base/vector_math.h"

namespace lobelight {

namespace {

// Nodes are worked on in blocks that stay in the first-level cache. Sums are kept in lanes that are
// added up at the end, in one order: the compiler may then use SIMD registers without reordering
// anything, and results do not depend on how wide these are.
constexpr std::size_t kBlock = 64;
constexpr std::size_t kLanes = 4;

// Least exponent that is told from 0 relative to the largest: e^−500 = 7e-218 is far below the last
// bit of any sum here, and far enough above the subnormal numbers that nothing becomes slow.
constexpr double kLeastExponent = -500.0;
using Lanes = std::array<double, kLanes>;

double total(const Lanes& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }

// The slice's nodes as arrays, weights summing to 1, filled up to whole blocks with weight 0.
struct Nodes {
  std::vector<double> x, y, z, weight;
  std::size_t count = 0;

  explicit Nodes(const Slice& slice) {
    double mass = 0.0;
    for (const double w : slice.weights) mass += w;
    count = (slice.weights.size() + kBlock - 1) / kBlock * kBlock;
    x.assign(count, 0.0);
    y.assign(count, 0.0);
    z.assign(count, 1.0);
    weight.assign(count, 0.0);
    for (std::size_t n = 0; n < slice.weights.size(); ++n) {
      x[n] = slice.directions[n].x;
      y[n] = slice.directions[n].y;
      z[n] = slice.directions[n].z;
      weight[n] = slice.weights[n] / mass;
    }
  }
};

// What the maximisation step needs of one lobe: its share of the mass Σ γ, the vector Σ γ x and,
// about the new mean, Σ γ |x − μ|².
struct Statistics {
  double weight = 0.0;
  glm::dvec3 direction{0.0};
  double spread = 0.0;
};

class Em {
 public:
  Em(const Slice& slice, Mixture start, const EmOptions& options)
      : nodes_(slice),
        options_(options),
        mixture_(std::move(start)),
        statistics_(mixture_.size()),
        responsibility_(mixture_.size() * nodes_.count) {
    clamp_and_normalise();
    symmetrise(mixture_, options_.mirrors);
  }

  const Mixture& mixture() const { return mixture_; }

  // Responsibilities of the current lobes for every node, times the node's weight; returns the
  // log-likelihood Σ_n w_n log Σ_k π_k g(x_n; μ_k, κ_k).
  double expect();

  // New parameters from the responsibilities.
  void maximise();

 private:
  void clamp_and_normalise();
  void gather_directions();
  void gather_spreads();
  void pool_images();

  Nodes nodes_;
  const EmOptions& options_;
  Mixture mixture_;
  std::vector<Statistics> statistics_;
  std::vector<double> responsibility_;  // lobe k's for node n at k · count + n
};

void Em::clamp_and_normalise() {
  double sum = 0.0;
  for (Lobe& lobe : mixture_) {
    if (!(lobe.weight >= options_.weight_floor)) lobe.weight = options_.weight_floor;
    if (!(lobe.gaussian.kappa >= 0.0)) lobe.gaussian.kappa = 0.0;
    lobe.gaussian.kappa = std::min(lobe.gaussian.kappa, options_.kappa_max);
    sum += lobe.weight;
  }
  for (Lobe& lobe : mixture_) lobe.weight /= sum;
}

double Em::expect() {
  const std::size_t lobes = mixture_.size();
  std::vector<double> constant(lobes);
  for (std::size_t k = 0; k < lobes; ++k) {
    constant[k] = std::log(mixture_[k].weight) + log_normalisation(mixture_[k].gaussian.kappa);
  }
  std::vector<std::array<double, kBlock>> term(lobes);
  Lanes log_likelihood{};
  for (std::size_t first = 0; first < nodes_.count; first += kBlock) {
    const double* x = &nodes_.x[first];
    const double* y = &nodes_.y[first];
    const double* z = &nodes_.z[first];
    const double* weight = &nodes_.weight[first];

    // log π_k g_k(x_n), and the largest of them over k: sums are taken relative to it, so that a
    // node far from every lobe does not underflow to 0/0.
    std::array<double, kBlock> largest;
    largest.fill(-1e300);
    for (std::size_t k = 0; k < lobes; ++k) {
      const glm::dvec3 mean = mixture_[k].gaussian.mean;
      const double factor = -0.5 * mixture_[k].gaussian.kappa;
      const double c = constant[k];
      double* out = term[k].data();
      for (std::size_t n = 0; n < kBlock; ++n) {
        const double dx = x[n] - mean.x;
        const double dy = y[n] - mean.y;
        const double dz = z[n] - mean.z;
        const double t = c + factor * (dx * dx + dy * dy + dz * dz);
        out[n] = t;
        largest[n] = largest[n] < t ? t : largest[n];
      }
    }
    std::array<double, kBlock> sum{};
    for (std::size_t k = 0; k < lobes; ++k) {
      double* out = term[k].data();
      for (std::size_t n = 0; n < kBlock; ++n) {
        const double t = out[n] - largest[n];
        out[n] = t < kLeastExponent ? kLeastExponent : t;
      }
      for (std::size_t n = 0; n < kBlock; ++n) {
        const double e = exp_nonpositive(out[n]);
        out[n] = e;
        sum[n] += e;
      }
    }
    std::array<double, kBlock> scale;
    std::array<double, kBlock> contribution;
    for (std::size_t n = 0; n < kBlock; ++n) {
      contribution[n] = weight[n] * (largest[n] + log_of_at_least_one(sum[n]));
      scale[n] = weight[n] / sum[n];
    }
    for (std::size_t n = 0; n < kBlock; n += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        log_likelihood[lane] += contribution[n + lane];
      }
    }
    for (std::size_t k = 0; k < lobes; ++k) {
      double* out = &responsibility_[k * nodes_.count + first];
      const double* e = term[k].data();
      for (std::size_t n = 0; n < kBlock; ++n) out[n] = scale[n] * e[n];
    }
  }
  return total(log_likelihood);
}

void Em::gather_directions() {
  for (std::size_t k = 0; k < mixture_.size(); ++k) {
    const double* r = &responsibility_[k * nodes_.count];
    Lanes weight{}, x{}, y{}, z{};
    for (std::size_t n = 0; n < nodes_.count; n += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        weight[lane] += r[n + lane];
        x[lane] += r[n + lane] * nodes_.x[n + lane];
        y[lane] += r[n + lane] * nodes_.y[n + lane];
        z[lane] += r[n + lane] * nodes_.z[n + lane];
      }
    }
    statistics_[k].weight = total(weight);
    statistics_[k].direction = {total(x), total(y), total(z)};
  }
}

void Em::gather_spreads() {
  for (std::size_t k = 0; k < mixture_.size(); ++k) {
    const double* r = &responsibility_[k * nodes_.count];
    const glm::dvec3 mean = mixture_[k].gaussian.mean;
    Lanes spread{};
    for (std::size_t n = 0; n < nodes_.count; n += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double dx = nodes_.x[n + lane] - mean.x;
        const double dy = nodes_.y[n + lane] - mean.y;
        const double dz = nodes_.z[n + lane] - mean.z;
        spread[lane] += r[n + lane] * (dx * dx + dy * dy + dz * dz);
      }
    }
    statistics_[k].spread = total(spread);
  }
}

void Em::pool_images() {
  for (const Mirror& mirror : options_.mirrors) {
    const std::vector<Statistics> before = statistics_;
    for (std::size_t k = 0; k < statistics_.size(); ++k) {
      const Statistics& other = before[static_cast<std::size_t>(mirror.image[k])];
      Statistics& own = statistics_[k];
      own.weight = 0.5 * (own.weight + other.weight);
      own.direction = 0.5 * (own.direction + reflected(other.direction, mirror.axis));
      own.spread = 0.5 * (own.spread + other.spread);
    }
  }
}

void Em::maximise() {
  gather_directions();
  pool_images();
  for (std::size_t k = 0; k < mixture_.size(); ++k) {
    // A lobe without mass, or with mass that cancels, keeps its mean.
    const double length = glm::length(statistics_[k].direction);
    if (length > 1e-300) mixture_[k].gaussian.mean = statistics_[k].direction / length;
  }
  // A second pass about the new means: 1 − R̄ = Σ γ |x − μ|² / 2 Σ γ, exact for unit vectors, where
  // 1 − |Σ γ x| / Σ γ would cancel.
  gather_spreads();
  pool_images();
  for (std::size_t k = 0; k < mixture_.size(); ++k) {
    const Statistics& s = statistics_[k];
    mixture_[k].weight = s.weight;
    if (s.weight > options_.weight_floor) {
      mixture_[k].gaussian.kappa = kappa_from_one_minus_mean_resultant(0.5 * s.spread / s.weight);
    }
  }
  clamp_and_normalise();
}

}  // namespace

EmResult run_em(const Slice& slice, Mixture start, const EmOptions& options) {
  if (start.empty()) throw std::invalid_argument("run_em needs at least one lobe to start from.");
  EmResult result;
  if (!(slice.albedo > 0.0)) {
    for (Lobe& lobe : start) lobe.weight = 0.0;
    result.mixture = std::move(start);
    result.converged = true;
    return result;
  }

  Em em(slice, std::move(start), options);
  result.log_likelihood.push_back(em.expect());
  while (result.iterations < options.max_iterations && !result.converged) {
    if (options.progress) options.progress->throw_if_cancelled();
    em.maximise();
    result.log_likelihood.push_back(em.expect());
    ++result.iterations;
    const double gain = result.log_likelihood.back() - *(result.log_likelihood.end() - 2);
    result.converged = gain < options.tolerance;
  }
  result.mixture = em.mixture();
  for (Lobe& lobe : result.mixture) lobe.weight *= slice.albedo;
  return result;
}

}  // namespace lobelight
