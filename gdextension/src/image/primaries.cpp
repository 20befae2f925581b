#include "image/primaries.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "image/image_error.h"

namespace lobelight {
namespace {

// Rounded chromaticities of Rec. 709, and those that ICC profiles of sRGB state for D50, give a
// conversion that differs from the identity by less than this.
constexpr double kSameColours = 0.005;

// Chromaticities are written with three decimals, sometimes.
constexpr double kSameChromaticity = 1e-3;

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

bool are_same(const glm::dvec2& a, const glm::dvec2& b) {
  return glm::length(a - b) < kSameChromaticity;
}

bool are_cie_xyz(const Primaries& primaries) {
  return are_same(primaries.red, kCieXyz.red) && are_same(primaries.green, kCieXyz.green) &&
         are_same(primaries.blue, kCieXyz.blue);
}

// Tristimulus values without the rounding of a third.
glm::dmat3 cie_xyz_to_xyz(const Primaries& primaries) {
  return are_same(primaries.white, kCieXyz.white) ? glm::dmat3(1.0) : to_xyz(primaries);
}

bool is_identity(const glm::dmat3& matrix) {
  double difference = 0.0;
  for (int column = 0; column < 3; ++column) {
    const glm::dvec3 deviation = glm::abs(matrix[column] - glm::dmat3(1.0)[column]);
    difference = std::max({difference, deviation.x, deviation.y, deviation.z});
  }
  return difference < kSameColours;
}

}  // namespace

std::optional<glm::dmat3> conversion_to_rec709(const Primaries& primaries) {
  const glm::dmat3 xyz = are_cie_xyz(primaries)
                             ? cie_xyz_to_xyz(primaries)
                             : adaptation(primaries.white, kRec709.white) * to_xyz(primaries);
  const glm::dmat3 matrix = glm::inverse(to_xyz(kRec709)) * xyz;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      // Real spaces stay within a few units; nearly singular ones run away.
      if (!(std::abs(matrix[column][row]) < 100.0)) return std::nullopt;
    }
  }
  return matrix;
}

void convert_to_rec709(Panorama& image, const Primaries& primaries, const std::string& source,
                       const std::string& name) {
  const std::optional<glm::dmat3> conversion = conversion_to_rec709(primaries);
  if (!conversion) throw ImageError(name, "has " + source + " that span no colours");
  if (is_identity(*conversion)) return;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    float* rgb = &image.rgb[i];
    glm::dvec3 colour;
    for (int c = 0; c < 3; ++c) {
      // Infinity minus infinity would be no number.
      colour[c] = static_cast<double>(rgb[c] == kInfinity ? kLargestHalf : rgb[c]);
    }
    const glm::vec3 converted(*conversion * colour);
    for (int c = 0; c < 3; ++c) {
      if (rgb[c] != kInfinity) rgb[c] = converted[c];
    }
  }
  image.notes.push_back("was converted from " +
                        (are_cie_xyz(primaries) ? "CIE XYZ" : "its " + source) + " to Rec. 709");
}

}  // namespace lobelight
