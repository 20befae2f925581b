#include "table/half_vector.h"

#include <algorithm>

namespace lobelight {

namespace {

// o·h is the cosine of half the angle between mean and view. Interpolated lobes can turn it towards
// zero and below; the shader's decoding uses the same bound.
constexpr double kMinODotH = 1e-4;

}  // namespace

HalfVectorLobe to_half_vector(const SphericalGaussian& gaussian, const glm::dvec3& o) {
  const glm::dvec3 h = glm::normalize(gaussian.mean + o);
  return {{h.x / h.z, h.y / h.z}, gaussian.kappa * glm::dot(o, h)};
}

SphericalGaussian from_half_vector(const HalfVectorLobe& lobe, const glm::dvec3& o) {
  const glm::dvec3 h = glm::normalize(glm::dvec3(lobe.slope, 1.0));
  const double o_dot_h = std::max(glm::dot(o, h), kMinODotH);
  return {glm::normalize(2.0 * o_dot_h * h - o), lobe.sharpness / o_dot_h};
}

}  // namespace lobelight
