#include "image/primaries.h"

#include <cmath>
#include <glm/matrix.hpp>

namespace lobelight {
namespace {

// XYZ of a chromaticity with Y = 1.
glm::dvec3 xyz(const glm::dvec2& c) { return {c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y}; }

// X + Y + Z = 1: finite for y = 0 too.
glm::dvec3 normalised_xyz(const glm::dvec2& c) { return {c.x, c.y, 1.0 - c.x - c.y}; }

// RGB to XYZ: the columns are the primaries, scaled so that (1, 1, 1) is white.
// SMPTE RP 177-1993.
glm::dmat3 to_xyz(const Primaries& p) {
  const glm::dmat3 columns(normalised_xyz(p.red), normalised_xyz(p.green), normalised_xyz(p.blue));
  const glm::dvec3 scale = glm::inverse(columns) * xyz(p.white);
  return {columns[0] * scale.x, columns[1] * scale.y, columns[2] * scale.z};
}

// Cone responses of Bradford's chromatic adaptation (ICC.1:2022, annex E), column by column.
constexpr glm::dmat3 kBradford(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367,
                               1.0296);

glm::dmat3 adaptation(const glm::dvec2& from, const glm::dvec2& to) {
  const glm::dvec3 gain = (kBradford * xyz(to)) / (kBradford * xyz(from));
  const glm::dmat3 scaled(glm::dvec3(gain.x, 0.0, 0.0), glm::dvec3(0.0, gain.y, 0.0),
                          glm::dvec3(0.0, 0.0, gain.z));
  return glm::inverse(kBradford) * scaled * kBradford;
}

}  // namespace

std::optional<glm::dmat3> conversion_to_rec709(const Primaries& primaries) {
  const glm::dmat3 matrix = glm::inverse(to_xyz(kRec709)) *
                            adaptation(primaries.white, kRec709.white) * to_xyz(primaries);
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      // Real spaces stay within a few units; nearly singular ones run away.
      if (!(std::abs(matrix[column][row]) < 100.0)) return std::nullopt;
    }
  }
  return matrix;
}

}  // namespace lobelight
