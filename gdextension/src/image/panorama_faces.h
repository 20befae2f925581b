#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "image/panorama.h"
#include "image/pyramid.h"

namespace lobelight {

// The light of a panorama by direction, as shaders/panorama.gdshaderinc has it. `panorama` must
// outlive it.
class PanoramaLight {
 public:
  PanoramaLight(const Panorama& panorama, bool is_srgb, bool as_sky)
      : panorama_(panorama), is_srgb_(is_srgb), as_sky_(as_sky) {}

  // Bilinearly from the direction d, which need not be a unit vector.
  glm::dvec3 sample(const glm::dvec3& d) const;

  // The mean of sample() within these angles to each side of d, which is exact.
  glm::dvec3 mean(const glm::dvec3& d, double azimuth, double polar) const;

 private:
  // In texels, whose middles are whole numbers.
  glm::dvec2 position(const glm::dvec3& d) const;
  glm::dvec3 texel(int column, int row) const;

  const Panorama& panorama_;
  bool is_srgb_;
  bool as_sky_;
};

// Where Godot's sky shows what lies at the unit vector d of a panorama.
glm::dvec3 sky_direction(const glm::dvec3& d);

// A texel of level 0 of the pyramid, before it is rounded: shaders/pyramid_panorama.gdshader.
glm::dvec3 level_0_texel(const PanoramaLight& light, const PyramidOptions& options, int face,
                         int column, int row);

}  // namespace lobelight
