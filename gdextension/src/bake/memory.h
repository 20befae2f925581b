#pragma once

#include <cstddef>

#include "bake/bake.h"
#include "bake/sphere.h"

namespace lobelight {

// The limit: bakes that need more memory are refused before they begin.
constexpr std::size_t kMemoryLimit = std::size_t{8} << 30;

// Texels of the largest picture that the engine's Image holds (Image::MAX_PIXELS).
constexpr std::size_t kMaxImageTexels = std::size_t{1} << 28;

// A bound of the bytes that a bake has allocated at any time, its result in the engine's arrays
// included: fit_memory_bound(), the texels twice, and
// - of measurements: 6 times their file, and what colours take;
// - of "lobes": "auto": 76 bytes for each texel of an environment as it is looked at;
// - of sets: 176 bytes for each texel of the tables that are fitted at the same time;
// - of pictures: 48 bytes for each pixel and 50 for each of the environment's texels, or of six
//   walls as large as the one that is given.
// Not counted are threads' stacks and, while an environment is read, its file and picture: 12 bytes
// for each of its texels, of which kMaxPanoramaTexels is the limit.
std::size_t memory_bound(const TableRequest& request);
std::size_t memory_bound(const SetRecipe& recipe);
std::size_t memory_bound(const SphereRequest& request, int environment_width = 0,
                         int environment_height = 0);

// Throws std::invalid_argument with one sentence that names key and value where the bound is above
// the limit or the result is larger than an image.
void check_memory(const TableRequest& request);
void check_memory(const SetRecipe& recipe);
void check_memory(const SphereRequest& request, int environment_width = 0,
                  int environment_height = 0);

}  // namespace lobelight
