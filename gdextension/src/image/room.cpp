#include "image/room.h"

#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace lobelight {
namespace {

// The axes along which a wall's u and v run, and which way.
struct WallAxes {
  int s_axis;
  double s_sign;
  int t_axis;
  double t_sign;
};

constexpr std::array<WallAxes, kWalls> kAxes = {{
    {2, -1.0, 1, -1.0},
    {2, 1.0, 1, -1.0},
    {0, 1.0, 2, 1.0},
    {0, 1.0, 2, -1.0},
    {0, 1.0, 1, -1.0},
    {0, -1.0, 1, -1.0},
}};

}  // namespace

glm::dvec3 Room::point(const WallPosition& position) const {
  const WallAxes& axes = kAxes[position.wall];
  glm::dvec3 d(0.0);
  d[wall_axis(position.wall)] = position.wall % 2 == 0 ? 1.0 : -1.0;
  d[axes.s_axis] = axes.s_sign * (2.0 * position.position.x - 1.0);
  d[axes.t_axis] = axes.t_sign * (2.0 * position.position.y - 1.0);
  return 0.5 * size * d;
}

WallPosition Room::meet(const glm::dvec3& origin, const glm::dvec3& direction) const {
  std::size_t wall = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const bool is_positive = direction[axis] > 0.0;
    const double plane = (is_positive ? 0.5 : -0.5) * size[axis];
    const double distance = (plane - origin[axis]) / direction[axis];
    if (distance < nearest) {
      nearest = distance;
      wall = static_cast<std::size_t>(2 * axis + (is_positive ? 0 : 1));
    }
  }
  const glm::dvec3 d = (origin + nearest * direction) / (0.5 * size);
  const WallAxes& axes = kAxes[wall];
  const glm::dvec2 st(axes.s_sign * d[axes.s_axis], axes.t_sign * d[axes.t_axis]);
  return {wall, glm::clamp(0.5 * st + 0.5, 0.0, 1.0)};
}

double Room::wall_area(std::size_t wall) const {
  return size.x * size.y * size.z / size[wall_axis(wall)];
}

}  // namespace lobelight
