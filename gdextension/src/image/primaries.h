#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>

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

// The matrix that takes linear colours with `primaries` to linear Rec. 709; white becomes white
// (Bradford adaptation). Empty when the primaries span no colours.
std::optional<glm::dmat3> conversion_to_rec709(const Primaries& primaries);

}  // namespace lobelight
