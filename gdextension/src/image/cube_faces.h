#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace lobelight {

inline constexpr int kCubeFaces = 6;

// The direction of the position `p` in [−1, 1]² on a face of a cube map, of length √(1 + |p|²), x
// to the right and y down as images of cube maps have them (OpenGL 4.6, table 8.19); faces in the
// order +X −X +Y −Y +Z −Z. The same as lobelight_face_direction() in
// shaders/cube_faces.gdshaderinc.
inline glm::dvec3 face_direction(int face, const glm::dvec2& p) {
  switch (face) {
    case 0:
      return {1.0, -p.y, -p.x};
    case 1:
      return {-1.0, -p.y, p.x};
    case 2:
      return {p.x, 1.0, p.y};
    case 3:
      return {p.x, -1.0, -p.y};
    case 4:
      return {p.x, -p.y, 1.0};
    default:
      return {-p.x, -p.y, -1.0};
  }
}

// The middle of a texel of a face with `size` texels along its side.
inline glm::dvec2 texel_middle(int column, int row, int size) {
  return {(column + 0.5) * (2.0 / size) - 1.0, (row + 0.5) * (2.0 / size) - 1.0};
}

}  // namespace lobelight
