#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "brdf/brdf.h"
#include "image/panorama.h"
#include "reference/integrator.h"

namespace lobelight {

struct SurfaceOptions {
  int width = 0;  // In pixels, at least 1.
  int height = 0;
  // BRDF samples a pixel, and as many of the environment: see Integrator.
  int samples = 2048;
  std::uint64_t seed = 0;  // Different seeds give independent noise.
  int threads = 0;         // 0: all cores. The picture does not depend on it.
};

// Linear radiance of the pixels that show a surface, 0 of the others.
struct SurfaceImage {
  int width = 0;
  int height = 0;
  std::vector<float> radiance;        // width · height · 3, row by row from the top.
  std::vector<float> standard_error;  // Of the same layout.
};

// The surface that a pixel (column, row) shows; empty where it shows none.
using SurfaceAt = std::function<std::optional<SurfaceFrame>(int column, int row)>;

// The orthonormal frame about a normal whose tangent is as near as can be to the one given; lengths
// do not matter. Empty where the normal has none, a number is not finite, or they are parallel.
std::optional<SurfaceFrame> frame_about(const glm::dvec3& normal, const glm::dvec3& tangent);

// Renders a surface of which every pixel is seen from the direction `view` (a unit vector towards
// the viewer) and lit by the whole `light`: nothing of the surface shadows another part of it,
// and light is reflected once. Calls `surface` from several threads at once. Throws Cancelled when
// `progress` is cancelled, and std::invalid_argument for an empty picture.
SurfaceImage render_surface(std::shared_ptr<const IncomingLight> light, const Brdf& brdf,
                            const glm::dvec3& view, const SurfaceAt& surface,
                            const SurfaceOptions& options, Progress& progress);

// The same in the light of a panorama; std::invalid_argument also for an empty one.
SurfaceImage render_surface(const Panorama& panorama, const Brdf& brdf, const glm::dvec3& view,
                            const SurfaceAt& surface, const SurfaceOptions& options,
                            Progress& progress);

}  // namespace lobelight
