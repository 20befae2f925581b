#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "image/bc6h.h"

namespace lobelight {

// The best block that was found for 16 texels, row by row: the bits of half floats, red, green and
// blue, from 0 to 65504.
//
// What counts is the linear error, relative to the light of the whole block and not to that of each
// texel, and that of the block's mean more than that of single texels: levels of light are never
// seen but mixed, by bilinear lookups and by several lobes. Encoders for pictures weigh the
// logarithm of each texel instead.
std::array<std::uint8_t, kBlockBytes> encode_bc6h(
    const std::array<std::uint16_t, 3 * kBlockTexels>& halves);

// A face of `size` texels with all its levels, as Godot's Image keeps RGBAH with mipmaps, in
// blocks, as it keeps BPTC_RGBFU with mipmaps; `size` is a power of two. The result does not depend
// on the threads. Throws Cancelled.
std::vector<std::uint8_t> encode_bc6h_face(const std::uint16_t* halves, int size, int threads,
                                           Progress& progress);

}  // namespace lobelight
