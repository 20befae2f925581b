#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/progress.h"

namespace lobelight {

// Largest panorama that is read: texels in all (16384 × 16384; 3 GiB of floats) and along a side.
inline constexpr std::int64_t kMaxPanoramaTexels = std::int64_t{1} << 28;
inline constexpr std::int64_t kMaxPanoramaSide = 65536;

// What graphics cards take as a texture, along a side.
inline constexpr std::int64_t kMaxTextureSide = 16384;

// The largest half float: more light than that no texture of halves holds.
inline constexpr float kLargestHalf = 65504.0f;

// A latitude-longitude map of linear radiance.
struct Panorama {
  int width = 0;           // Texels around the vertical axis.
  int height = 0;          // Texels from straight up (row 0) to straight down.
  std::vector<float> rgb;  // width · height · 3 values, row by row, as the file holds them.

  // What its reader has to say of it: each a predicate that begins in the small ("was converted
  // from CIE XYZ to Rec. 709"), to be put behind the file's name. Warnings are for what will
  // hardly look as it should.
  std::vector<std::string> notes = {};
  std::vector<std::string> warnings = {};

  // Radiance from `direction` (a unit vector, y up): bilinear, texel centres at (i + ½)/width and
  // (j + ½)/height, wrapped around the axis, clamped at the poles. Values count as sanitise() makes
  // them, an infinite one as 65504. The panorama must not be empty.
  glm::dvec3 sample(const glm::dvec3& direction) const;

  // Sets negative values and NaN to 0, and infinite ones, which overflowed, to the largest finite
  // value or 65504, whichever is more. Returns how many texels had one, and notes it.
  std::size_t sanitise();

  // Multiplies a sanitised panorama by 2^`exposure` and caps it at 65504. Returns how many texels
  // were capped, and warns of the light that goes.
  std::size_t expose(double exposure);

  // Multiplies a sanitised panorama by 2^`exposure`; finite values stay finite.
  void brighten(double exposure);

  // How many texels are brighter than 65504, and for them a warning: what light is lost where that
  // is the limit, and which exposure instead of `exposure` keeps it.
  std::size_t warn_of_limit(double exposure);
};

// Position of `direction` (a unit vector) on a panorama, as Godot's PanoramaSkyMaterial has it:
//   u = fract(atan2(d.x, −d.z)/2π),  v = acos(d.y)/π;  u in [0, 1), v in [0, 1] from the top.
glm::dvec2 panorama_position(const glm::dvec3& direction);

// The unit vector at (u, v), the inverse of panorama_position.
glm::dvec3 panorama_direction(const glm::dvec2& position);

// Warns of a picture that is not twice as wide as high: it is hardly a panorama.
void check_proportions(Panorama& panorama);

// Throws ImageError (with `name` for the file) unless the size is at least 1 × 1 and within the
// limits above and that of the caller.
void check_panorama_size(std::int64_t width, std::int64_t height, const std::string& name,
                         std::int64_t max_side = kMaxPanoramaSide);

// Reads an OpenEXR or a Radiance (.hdr) file; its content says which, not its name.
// `path` is UTF-8; `layer` as for decode_exr(), Radiance files have none. Pictures with more than
// `max_side` texels along a side are refused before they are decoded. Throws ImageError, and
// Cancelled when `progress`, which may be null, is cancelled.
Panorama load_panorama(const std::string& path, const std::string& layer = "",
                       std::int64_t max_side = kMaxPanoramaSide,
                       const Progress* progress = nullptr);

// The same for a file that is already in memory; `name` stands for it in messages.
Panorama decode_panorama(const std::vector<std::uint8_t>& bytes, const std::string& name,
                         const std::string& layer = "", std::int64_t max_side = kMaxPanoramaSide,
                         const Progress* progress = nullptr);

// The layers of such a file; "" alone for a Radiance file. Throws ImageError.
std::vector<std::string> panorama_layers(const std::string& path);

}  // namespace lobelight
