#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "image/panorama.h"

namespace lobelight {

// CIE 1931 chromaticities (x, y) of an RGB space.
struct Primaries {
  glm::dvec2 red;
  glm::dvec2 green;
  glm::dvec2 blue;
  glm::dvec2 white;
};

// ITU-R BT.709, which sRGB shares.
inline constexpr Primaries kRec709 = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

// Tristimulus values as an RGB space: the matrix to CIE XYZ is the identity.
inline constexpr Primaries kCieXyz = {{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}, {1.0 / 3.0, 1.0 / 3.0}};

// The matrix that takes linear colours with `primaries` to linear Rec. 709. White becomes white
// (Bradford adaptation), except where the primaries are those of CIE XYZ: tristimulus values are
// what they are whatever is called white, and (0.9505, 1, 1.0891) is Rec. 709's. Empty when the
// primaries span no colours.
std::optional<glm::dmat3> conversion_to_rec709(const Primaries& primaries);

// Converts the colours of `image` from `primaries`, if these are others than Rec. 709's, and notes
// it; `source` is what the file calls them. An infinite channel stays infinite. Throws ImageError,
// with `name` for the file, when the primaries span no colours.
void convert_to_rec709(Panorama& image, const Primaries& primaries, const std::string& source,
                       const std::string& name);

}  // namespace lobelight
