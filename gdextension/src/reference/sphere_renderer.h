#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "brdf/brdf.h"
#include "image/panorama.h"
#include "image/room.h"
#include "reference/integrator.h"

namespace lobelight {

struct SphereOptions {
  int size = 256;  // Width and height in pixels, 1 to 8192.
  // BRDF samples a pixel, and as many of the environment; 16 to 2^24. 2048 agree with twice as many
  // by more than 56 dB on every map tried, down to widths of (0.01, 0.2); strips narrower than that
  // (0.001, 0.2) need 16 times as many for 55 dB.
  int samples = 2048;
  std::uint64_t seed = 0;  // Different seeds give independent noise.
  int threads = 0;         // 0: all cores. The picture does not depend on it.
};

// A unit sphere from +z, orthographic. Linear radiance, background 0.
struct SphereImage {
  int size = 0;
  std::vector<float> radiance;        // size · size · 3, row by row from the top.
  std::vector<float> standard_error;  // Of the same layout.
};

// Throws std::invalid_argument with a sentence that names the option and its range.
void validate(const SphereOptions& options);

// The frame of the sphere at pixel (column, row): x = (2c+1)/size − 1, y = 1 − (2r+1)/size,
// n = (x, y, √(1−x²−y²)), tangent = normalize((0,1,0) × n). Empty beside the sphere.
std::optional<SurfaceFrame> sphere_frame(int column, int row, int size);

// Renders the sphere lit by `panorama`. Throws Cancelled when `progress` is cancelled, and
// std::invalid_argument for an empty panorama or invalid options.
SphereImage render_sphere(const Panorama& panorama, const Brdf& brdf, const SphereOptions& options,
                          Progress& progress);

// A sphere in a room: it hides nothing of the walls.
struct RoomSphere {
  glm::dvec3 centre{0.0};
  double radius = 1.0;
};

// Throws std::invalid_argument with a sentence that names what does not hold: the room's size and
// the radius are positive, and the sphere lies within the box.
void validate(const Room& room, const RoomSphere& sphere);

// Renders the same picture of a sphere lit by the walls of `room`, each point as it sees them:
// centre + radius · n. Throws as render_sphere() does, and what validate() throws.
SphereImage render_sphere(const Room& room, const RoomSphere& sphere, const Brdf& brdf,
                          const SphereOptions& options, Progress& progress);

}  // namespace lobelight
