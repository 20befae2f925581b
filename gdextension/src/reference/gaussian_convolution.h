#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "base/progress.h"
#include "image/panorama.h"
#include "sg/spherical_gaussian.h"

namespace lobelight {

// A panorama under spherical Gaussians of any sharpness: what lobes see of the light when nothing
// is lost in a pyramid of filtered maps. Immutable after construction, so that threads can share
// it.
class GaussianConvolution {
 public:
  // The panorama must not be empty. Takes 76 bytes for each texel of it, its own twelve included.
  // Throws Cancelled when `progress`, which may be null, is cancelled.
  explicit GaussianConvolution(Panorama panorama, const Progress* progress = nullptr);

  // ∫ L(i) g(i; μ, κ) di, L being what Panorama::sample() gives. Within a few per cent next to
  // lights that are much brighter than all else, far less elsewhere.
  glm::dvec3 convolve(const SphericalGaussian& gaussian) const;

 private:
  // The panorama with texels `span` times as wide and as high; radiance averaged over solid angle.
  struct Level {
    int width = 0;
    int height = 0;
    double angle = 0.0;     // of a texel's height
    double variance = 0.0;  // per axis: what the texels' positions do not show of L
    std::vector<glm::dvec3> radiance;
    std::vector<glm::dvec3> direction;  // of texels' centres, those of their light where coarse
    std::vector<double> solid_angle;    // of a row's texels
  };

  // The level of twice the texels' height, from the finest and the next finer one.
  static Level coarser(const Level& finest, const Level& finer, const Progress* progress);
  static void set_solid_angles(Level& level);

  glm::dvec3 sum(const Level& level, const SphericalGaussian& gaussian) const;
  glm::dvec3 sample(const SphericalGaussian& gaussian) const;

  Panorama panorama_;
  std::vector<Level> levels_;  // fine to coarse
};

}  // namespace lobelight
