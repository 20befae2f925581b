#pragma once

#include <glm/glm.hpp>

#include "sg/spherical_gaussian.h"

namespace lobelight {

// A lobe of a view o by the half-vector between its mean and o: in these coordinates it hardly
// changes with the view. Mirroring at h stretches solid angles by 4 (o·h), variances across the
// plane of incidence and along it together, so κ (o·h) is the part of κ that does not depend on the
// view (a quarter of the half-vector's own sharpness).
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
