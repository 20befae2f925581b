#include "image/synthetic_panorama.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/pi.h"

namespace lobelight {

namespace {

struct Light {
  glm::dvec2 position;  // u, v
  double radius;        // radians
  glm::dvec3 radiance;
};

// A row of windows, lamps below them, and a few lights hardly larger than a texel (π / 128).
constexpr double kBrightest = 6e4;
const Light kLights[] = {
    {{0.08, 0.30}, 0.20, {9.0, 10.0, 12.0}},
    {{0.27, 0.28}, 0.16, {20.0, 22.0, 26.0}},
    {{0.43, 0.31}, 0.12, {40.0, 42.0, 45.0}},
    {{0.60, 0.26}, 0.22, {6.0, 7.0, 8.0}},
    {{0.81, 0.33}, 0.10, {60.0, 66.0, 75.0}},
    {{0.16, 0.44}, 0.05, {300.0, 260.0, 200.0}},
    {{0.35, 0.46}, 0.04, {500.0, 420.0, 300.0}},
    {{0.52, 0.43}, 0.06, {150.0, 130.0, 100.0}},
    {{0.71, 0.47}, 0.03, {1500.0, 1300.0, 1000.0}},
    {{0.93, 0.45}, 0.04, {700.0, 600.0, 450.0}},
    {{0.49, 0.12}, 0.025, {8000.0, 8000.0, 8000.0}},
    {{0.89, 0.17}, 0.02, {kBrightest, kBrightest, kBrightest}},
    {{0.22, 0.62}, 0.08, {3.0, 2.4, 1.6}},
    {{0.66, 0.70}, 0.15, {1.5, 1.4, 1.2}},
};

}  // namespace

Panorama synthetic_panorama() {
  Panorama panorama;
  panorama.width = 256;
  panorama.height = 128;
  for (int row = 0; row < panorama.height; ++row) {
    for (int column = 0; column < panorama.width; ++column) {
      const glm::dvec2 position((column + 0.5) / panorama.width, (row + 0.5) / panorama.height);
      const glm::dvec3 d = panorama_direction(position);
      // Walls: columns that fade downwards, around a brightness of 1.
      const double wall = std::pow(2.0, d.y + 0.5 * std::sin(24.0 * kPi * position.x) *
                                                  std::sqrt(std::max(0.0, 1.0 - d.y * d.y)));
      glm::dvec3 radiance(wall);
      for (const Light& light : kLights) {
        const double distance = glm::length(d - panorama_direction(light.position));
        if (distance < light.radius) radiance = light.radiance;
      }
      for (int channel = 0; channel < 3; ++channel) {
        panorama.rgb.push_back(static_cast<float>(radiance[channel]));
      }
    }
  }
  return panorama;
}

}  // namespace lobelight
