#include "fit/slice.h"

#include <cmath>

namespace lobelight {

namespace {

constexpr double kGoldenRatioFraction = 0.61803398874989484820;

}  // namespace

Slice sample_slice(const Brdf& brdf, const glm::dvec3& o, int nodes_per_axis, double rotation) {
  // Rings of equal mass in u.x. Along each ring one quadrant of u.y is stratified, turned by the
  // golden ratio from ring to ring so that the strata do not line up, and reflected into the other
  // three: the samplers map u.y → 1 − u.y and u.y → 1/2 − u.y to reflections of the slice.
  const int quarter = (nodes_per_axis + 3) / 4;
  const int rings = 4 * quarter;
  const double node_weight = 1.0 / (static_cast<double>(rings) * rings);

  Slice slice;
  slice.directions.reserve(static_cast<std::size_t>(rings) * static_cast<std::size_t>(rings));
  slice.weights.reserve(slice.directions.capacity());
  const auto add = [&](double ring, double turn) {
    const auto sample = brdf.sample(o, {ring, turn});
    if (!sample || !(sample->weight > 0.0)) return;
    slice.directions.push_back(sample->direction);
    slice.weights.push_back(sample->weight * node_weight);
    slice.albedo += slice.weights.back();
  };
  for (int r = 0; r < rings; ++r) {
    const double ring = (r + 0.5) / rings;
    const double turned = rotation + r * kGoldenRatioFraction;
    const double shift = turned - std::floor(turned);
    for (int a = 0; a < quarter; ++a) {
      const double turn = 0.25 * (a + shift) / quarter;
      add(ring, turn);
      add(ring, 0.5 - turn);
      add(ring, 0.5 + turn);
      add(ring, 1.0 - turn);
    }
  }
  return slice;
}

}  // namespace lobelight
