#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "image/panorama.h"

namespace lobelight {

inline constexpr std::size_t kWalls = 6;

// A place on the walls of a box: which wall, in the order +x −x +y −y +z −z, and where on its
// picture, (u, v) in [0, 1]² from the upper left.
struct WallPosition {
  std::size_t wall;
  glm::dvec2 position;
};

// A box about the origin whose walls emit the radiance of pictures.
//
// A point q of a wall has d = q / (size / 2), on a face of the unit cube, and there (s, t) =
//   +x: (−z, −y), −x: (z, −y), +y: (x, z), −y: (x, −z), +z: (x, −y), −z: (−x, −y)   of d;
//   u = (s + 1)/2, v = (t + 1)/2, row 0 at v = 0.
struct Room {
  glm::dvec3 size{1.0};                  // Of the box, in metres, all above 0.
  std::array<Panorama, kWalls> walls{};  // In linear radiance; not panoramas, but pictures.

  // The point of a wall.
  glm::dvec3 point(const WallPosition& position) const;

  // Where the ray from `origin`, within the box, along the unit vector `direction` meets a wall.
  WallPosition meet(const glm::dvec3& origin, const glm::dvec3& direction) const;

  double wall_area(std::size_t wall) const;
};

// The axis across a wall: 0 for ±x, 1 for ±y, 2 for ±z.
constexpr int wall_axis(std::size_t wall) { return static_cast<int>(wall / 2); }

}  // namespace lobelight
