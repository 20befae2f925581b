#pragma once

#include <glm/glm.hpp>

namespace lobelight {

// Two unit vectors that complete a unit vector z to a right-handed orthonormal frame (x, y, z).
struct Frame {
  glm::dvec3 x;
  glm::dvec3 y;
};

// Without branches or cancellation: Duff et al. 2017, "Building an orthonormal basis, revisited",
// JCGT 6(1), listing 3.
inline Frame frame_around(const glm::dvec3& z) {
  const double sign = z.z < 0.0 ? -1.0 : 1.0;
  const double a = -1.0 / (sign + z.z);
  const double b = z.x * z.y * a;
  return {{1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}};
}

}  // namespace lobelight
