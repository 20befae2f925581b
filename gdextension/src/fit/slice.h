#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "brdf/brdf.h"

namespace lobelight {

// A BRDF slice times cosine, ρ(i, o)(n·i) for one fixed view o, as a quadrature: for any f,
// ∫ ρ(i, o) i_z f(i) di ≈ Σ_n weights[n] · f(directions[n]).
struct Slice {
  std::vector<glm::dvec3> directions;  // unit, above the horizon
  std::vector<double> weights;         // > 0, one for each direction
  double albedo = 0.0;                 // sum of the weights: the directional albedo of the view
};

// nodes_per_axis² nodes (rounded up to a multiple of four per axis) drawn through the BRDF's own
// sampler from points that are the same on every call; fewer come back where some fall below the
// horizon. The nodes are their own mirror image wherever the slice is: in y = 0 when o_y = 0, in
// x = 0 when o_x = 0. `rotation` ∈ [0, 1) turns the points among themselves and keeps that.
Slice sample_slice(const Brdf& brdf, const glm::dvec3& o, int nodes_per_axis = 64,
                   double rotation = 0.0);

}  // namespace lobelight
