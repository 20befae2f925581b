#pragma once

#include <glm/glm.hpp>

#include "sg/spherical_gaussian.h"

namespace lobelight {

// A lobe of a view o, described by the half-vector h between its mean and o. In this form a lobe
// hardly changes with the view. Reflection at h stretches solid angles by 4 (o·h), so κ (o·h), a
// quarter of the half-vector's own sharpness, does not depend on the view.
struct HalfVectorLobe {
  glm::dvec2 slope{0.0};   // (h_x, h_y) / h_z
  double sharpness = 0.0;  // κ (o·h)
};

// `gaussian.mean` and `o` above the horizon.
HalfVectorLobe to_half_vector(const SphericalGaussian& gaussian, const glm::dvec3& o);

// The lobe of view o: i = 2 (o·h) h − o, κ = sharpness / (o·h). The mean may fall below the
// horizon.
SphericalGaussian from_half_vector(const HalfVectorLobe& lobe, const glm::dvec3& o);

}  // namespace lobelight
