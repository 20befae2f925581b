#pragma once

#include <cstdint>
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

// Samples the slice at nodes_per_axis² nodes (rounded up to a multiple of four per axis), which the
// BRDF's own sampler makes of points that are the same on every call. Nodes below the horizon are
// left out. Where the slice is its own mirror image, so are the nodes: in y = 0 if o_y = 0, in x =
// 0 if o_x = 0. `rotation` ∈ [0, 1) gives other points with the same symmetry.
Slice sample_slice(const Brdf& brdf, const glm::dvec3& o, int nodes_per_axis = 64,
                   double rotation = 0.0);

// The rotation that a recipe's seed stands for.
double seed_rotation(std::uint64_t seed);

// Whether a node can be used in a fit: its weight is finite and above 0, its direction finite and
// of unit length within 1e-6. Measured data may contain anything; sample_slice(), initial_guess()
// and run_em() leave out the other nodes.
bool is_usable(const glm::dvec3& direction, double weight);

// Whether every node is usable and the albedo finite.
bool is_usable(const Slice& slice);

// The usable nodes, and their albedo. Throws std::invalid_argument where the weights add up to more
// than a double holds.
Slice usable_nodes(const Slice& slice);

}  // namespace lobelight
