#include "fit/channel_weights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lobelight {

namespace {

// Iteration stops when no weight, as a share of its channel's albedo, changes by more than this.
constexpr double kTolerance = 1e-6;

// Lobes of weight 0 start with this share instead: EM never changes a weight of 0.
constexpr double kLeastShare = 1e-9;

// Keeps quotients finite where a node's share of the mass is near the smallest double.
constexpr double kLeastSum = std::numeric_limits<double>::min();

}  // namespace

std::vector<glm::dvec3> channel_node_weights(const Brdf& brdf, const glm::dvec3& o,
                                             const Slice& slice) {
  std::vector<glm::dvec3> weights;
  weights.reserve(slice.weights.size());
  for (std::size_t n = 0; n < slice.weights.size(); ++n) {
    const glm::dvec3 rgb = brdf.evaluate_rgb(slice.directions[n], o);
    const double mean = (rgb.x + rgb.y + rgb.z) / 3.0;
    weights.push_back(mean > 0.0 ? rgb * (slice.weights[n] / mean) : glm::dvec3(0.0));
  }
  return weights;
}

std::vector<glm::dvec3> channel_weights(const std::vector<glm::dvec3>& node_weights,
                                        const std::vector<double>& log_densities,
                                        const std::vector<double>& start, int iterations) {
  const std::size_t nodes = node_weights.size();
  const std::size_t lobes = start.size();
  std::vector<glm::dvec3> result(lobes, glm::dvec3(0.0));
  glm::dvec3 mass(0.0);
  for (const glm::dvec3& weight : node_weights) mass += weight;
  double start_sum = 0.0;
  for (const double weight : start) start_sum += weight;

  // Only the ratios of the densities at a node matter. They are scaled so that the largest is 1,
  // which avoids 0/0.
  std::vector<double> density(log_densities.size());
  for (std::size_t n = 0; n < nodes; ++n) {
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < lobes; ++k) {
      largest = std::max(largest, log_densities[k * nodes + n]);
    }
    for (std::size_t k = 0; k < lobes; ++k) {
      // If every density is 0, the lobes share the node equally.
      const double difference = log_densities[k * nodes + n] - largest;
      density[k * nodes + n] = std::isfinite(largest) ? std::exp(difference) : 1.0;
    }
  }

  std::vector<double> share(lobes);
  std::vector<double> next(lobes);
  std::vector<double> quotient(nodes);
  for (int channel = 0; channel < 3; ++channel) {
    if (!(mass[channel] > 0.0)) continue;
    for (std::size_t k = 0; k < lobes; ++k) {
      share[k] = std::max(start_sum > 0.0 ? start[k] / start_sum : 0.0, kLeastShare);
    }
    for (int iteration = 0; iteration < iterations; ++iteration) {
      std::fill(quotient.begin(), quotient.end(), 0.0);
      for (std::size_t k = 0; k < lobes; ++k) {
        for (std::size_t n = 0; n < nodes; ++n) quotient[n] += share[k] * density[k * nodes + n];
      }
      for (std::size_t n = 0; n < nodes; ++n) {
        // The share of a lobe that has no node in this channel ends as 0, and so does the sum at
        // nodes that only it reaches, where the channel is black.
        const double weight = node_weights[n][channel];
        quotient[n] =
            weight > 0.0 ? weight / std::max(mass[channel] * quotient[n], kLeastSum) : 0.0;
      }
      double moved = 0.0;
      double total = 0.0;
      for (std::size_t k = 0; k < lobes; ++k) {
        double sum = 0.0;
        for (std::size_t n = 0; n < nodes; ++n) sum += density[k * nodes + n] * quotient[n];
        next[k] = share[k] * sum;
        total += next[k];
        moved = std::max(moved, std::abs(next[k] - share[k]));
      }
      for (std::size_t k = 0; k < lobes; ++k) share[k] = next[k] / total;
      if (moved < kTolerance) break;
    }
    for (std::size_t k = 0; k < lobes; ++k) result[k][channel] = share[k] * mass[channel];
  }
  return result;
}

std::vector<glm::dvec3> channel_weights(const Slice& slice,
                                        const std::vector<glm::dvec3>& node_weights,
                                        const Mixture& mixture, int iterations) {
  const std::size_t nodes = slice.directions.size();
  std::vector<double> log_densities(mixture.size() * nodes);
  std::vector<double> start;
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const double constant = log_normalisation(mixture[k].gaussian.kappa);
    for (std::size_t n = 0; n < nodes; ++n) {
      const glm::dvec3 d = slice.directions[n] - mixture[k].gaussian.mean;
      log_densities[k * nodes + n] = constant - 0.5 * mixture[k].gaussian.kappa * glm::dot(d, d);
    }
    start.push_back(mixture[k].weight);
  }
  return channel_weights(node_weights, log_densities, start, iterations);
}

}  // namespace lobelight
