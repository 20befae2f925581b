#include "fit/slice.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lobelight {

namespace {

constexpr double kGoldenRatioFraction = 0.61803398874989484820;

}  // namespace

double seed_rotation(std::uint64_t seed) {
  const double turns = static_cast<double>(seed % 1048576) * kGoldenRatioFraction;
  return turns - std::floor(turns);
}

Slice sample_slice(const Brdf& brdf, const glm::dvec3& o, int nodes_per_axis, double rotation) {
  // A Kronecker lattice: u.x in equal steps, u.y advancing by the golden ratio from node to node.
  // It fills one quarter of u.y and is reflected into the other three: the samplers map u.y → 1 −
  // u.y and u.y → 1/2 − u.y to mirror images of the slice.
  const int quarter = (nodes_per_axis + 3) / 4;
  const int count = 4 * quarter * quarter;
  const double node_weight = 0.25 / count;

  Slice slice;
  slice.directions.reserve(4 * static_cast<std::size_t>(count));
  slice.weights.reserve(slice.directions.capacity());
  const auto add = [&](double distance, double turn) {
    const auto sample = brdf.sample(o, {distance, turn});
    if (!sample || !is_usable(sample->direction, sample->weight)) return;
    slice.directions.push_back(sample->direction);
    slice.weights.push_back(sample->weight * node_weight);
    slice.albedo += slice.weights.back();
  };
  for (int n = 0; n < count; ++n) {
    const double distance = (n + 0.5) / count;
    const double turned = rotation + n * kGoldenRatioFraction;
    const double turn = 0.25 * (turned - std::floor(turned));
    add(distance, turn);
    add(distance, 0.5 - turn);
    add(distance, 0.5 + turn);
    add(distance, 1.0 - turn);
  }
  return slice;
}

bool is_usable(const glm::dvec3& direction, double weight) {
  // Comparisons with NaN are false, and so is the last one with an infinite component.
  return weight > 0.0 && std::isfinite(weight) &&
         std::abs(glm::dot(direction, direction) - 1.0) <= 1e-6;
}

bool is_usable(const Slice& slice) {
  if (slice.directions.size() != slice.weights.size() || !std::isfinite(slice.albedo)) return false;
  for (std::size_t n = 0; n < slice.weights.size(); ++n) {
    if (!is_usable(slice.directions[n], slice.weights[n])) return false;
  }
  return true;
}

Slice usable_nodes(const Slice& slice) {
  Slice usable;
  const std::size_t count = std::min(slice.directions.size(), slice.weights.size());
  for (std::size_t n = 0; n < count; ++n) {
    if (!is_usable(slice.directions[n], slice.weights[n])) continue;
    usable.directions.push_back(slice.directions[n]);
    usable.weights.push_back(slice.weights[n]);
    usable.albedo += slice.weights[n];
  }
  if (!std::isfinite(usable.albedo)) {
    throw std::invalid_argument("The weights of a slice add up to more than a double holds.");
  }
  return usable;
}

}  // namespace lobelight
