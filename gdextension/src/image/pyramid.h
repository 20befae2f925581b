#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "image/cube_faces.h"
#include "image/panorama.h"

namespace lobelight {

// Texels along the side of a face, at most.
inline constexpr int kMaxPyramidSize = 2048;
// Samples along the side of a texel, at most.
inline constexpr int kMaxPyramidSamples = 64;

// How a panorama becomes light whose levels are blurred, as runtime/pyramid/pyramid.gd says it to
// the shaders pyramid_panorama and pyramid_round. Variances are per axis, in solid angles of the
// texels in the middle of a face.
struct PyramidOptions {
  int size = 512;            // Texels along the side of a face, a power of two.
  bool is_gaussian = false;  // Whether kernels are Gaussians; discs otherwise.
  bool is_srgb = false;      // Whether the panorama holds sRGB; linear light otherwise.
  bool as_sky = false;       // Whether its texels lie where Godot's sky has them (up to ½° off).
  int samples = 1;           // Along the side of a texel of level 0, where that is not blurred.
  double base_variance = 0.0;         // What level 0 is blurred by; 0 for nothing.
  double level_variance = 5.0 / 6.0;  // A third of what each level is blurred by, of the finer one.
  int threads = 0;                    // Zero: all cores. The light does not depend on it.
};

// Throws std::invalid_argument with one sentence that names the option.
void validate(const PyramidOptions& options);

// The faces of a cube map with all their levels, level 0 first, row by row: red, green, blue and 1
// as half floats, as Godot's Image keeps RGBAH with mipmaps.
struct LightPyramid {
  int size = 0;
  std::array<std::vector<std::uint16_t>, kCubeFaces> faces;
};

// Where a level begins in a face of a LightPyramid, in half floats.
std::size_t level_begin(int size, int level);

// Filters a panorama as the GPU does, with one rounding to half floats for each level. What is
// negative or not finite counts as no light, what is above 65504 as 65504. The panorama must not be
// empty. Throws as validate() does, and Cancelled.
LightPyramid filter_panorama(const Panorama& panorama, const PyramidOptions& options,
                             Progress& progress);

}  // namespace lobelight
