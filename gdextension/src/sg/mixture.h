#pragma once

#include <vector>

#include "sg/spherical_gaussian.h"

namespace lobelight {

// One lobe: `weight` is its integral over the sphere.
struct Lobe {
  double weight = 0.0;
  SphericalGaussian gaussian;
};

// Σ_k weight_k · g(x; μ_k, κ_k). The weights sum to the directional albedo of what it stands for.
using Mixture = std::vector<Lobe>;

// Value of the mixture at a unit vector, 1/sr.
double evaluate(const Mixture& mixture, const glm::dvec3& direction);

double total_weight(const Mixture& mixture);

}  // namespace lobelight
