#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>

#include "base/progress.h"
#include "brdf/brdf.h"
#include "image/panorama.h"
#include "reference/incoming_light.h"
#include "reference/sobol.h"

namespace lobelight {

// The frame of a surface point: orthonormal, right-handed, in world space.
struct SurfaceFrame {
  glm::dvec3 tangent;
  glm::dvec3 bitangent;
  glm::dvec3 normal;
  glm::dvec3 point{0.0};  // Matters to light that is near.
};

// Reflected radiance with its standard error, per channel.
struct RadianceEstimate {
  glm::dvec3 radiance;
  glm::dvec3 standard_error;
};

// Estimates L_o(o) = ∫ L_i(i) ρ(i, o) (n·i) di over the hemisphere above a surface by sampling.
// Immutable after construction, so that threads can share it. Keeps a reference to the BRDF.
class Integrator {
 public:
  // `samples`: BRDF samples per estimate, and as many of the environment; rounded up to a power of
  // two, at least 16. Throws Cancelled when `progress`, which may be null, is cancelled.
  Integrator(std::shared_ptr<const IncomingLight> light, const Brdf& brdf, int samples,
             const Progress* progress = nullptr);

  // In the light of a panorama.
  Integrator(const Panorama& panorama, const Brdf& brdf, int samples,
             const Progress* progress = nullptr);

  // `view`: unit vector from the surface towards the viewer, in world space. Equal seeds give
  // equal results; different seeds, independent ones. 0 below the horizon. Throws Cancelled when
  // `progress`, which may be null, is cancelled.
  RadianceEstimate integrate(const glm::dvec3& view, const SurfaceFrame& frame, std::uint64_t seed,
                             const Progress* progress = nullptr) const;

 private:
  ClusterChoice choose_clusters(const glm::dvec3& o, const SurfaceFrame& frame) const;
  glm::dvec3 batch(const glm::dvec3& o, const SurfaceFrame& frame, const ClusterChoice& choice,
                   std::uint64_t seed, const Progress* progress) const;

  const Brdf& brdf_;
  std::shared_ptr<const IncomingLight> light_;
  SobolPoints points_;
};

}  // namespace lobelight
