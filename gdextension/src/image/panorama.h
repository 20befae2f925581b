#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace lobelight {

/// Largest panorama that is read, in texels (a 16384 × 16384 square; 3 GiB of floats).
inline constexpr std::size_t kMaxPanoramaTexels = std::size_t{1} << 28;

/// A latitude-longitude map of linear radiance.
struct Panorama {
  int width = 0;           ///< Texels around the vertical axis.
  int height = 0;          ///< Texels from straight up (row 0) to straight down.
  std::vector<float> rgb;  ///< width · height · 3 values, row by row, as the file holds them.

  /// Radiance from `direction` (a unit vector, y up): bilinear, texel centres at (i + ½)/width and
  /// (j + ½)/height, wrapped around the axis, clamped at the poles. A negative or non-finite value
  /// counts as 0. The panorama must not be empty.
  glm::dvec3 sample(const glm::dvec3& direction) const;

  /// Sets the negative and the non-finite values to 0. Returns how many texels had one.
  std::size_t sanitise();
};

/// Position of `direction` (a unit vector) on a panorama, as Godot's PanoramaSkyMaterial has it:
///   u = fract(atan2(d.x, −d.z)/2π),  v = acos(d.y)/π;  u in [0, 1), v in [0, 1] from the top.
glm::dvec2 panorama_position(const glm::dvec3& direction);

/// The unit vector at (u, v), the inverse of panorama_position.
glm::dvec3 panorama_direction(const glm::dvec2& position);

/// Reads an OpenEXR or a Radiance (.hdr) file; its content says which, not its name.
/// `path` is UTF-8. Throws ImageError.
Panorama load_panorama(const std::string& path);

/// The same for a file that is already in memory; `name` stands for it in messages.
Panorama decode_panorama(const std::vector<std::uint8_t>& bytes, const std::string& name);

}  // namespace lobelight
