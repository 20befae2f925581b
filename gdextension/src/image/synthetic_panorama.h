#pragma once

#include "image/panorama.h"

namespace lobelight {

// A dark hall with windows and lamps, grey but for the lamps' tints, made up by formula and the
// same everywhere: the brightest texel is 6 · 10⁴ times the median, as in Debevec's Grace
// Cathedral, and there are lights of all sizes from one texel to a tenth of the sky. 256 × 128
// texels.
Panorama synthetic_panorama();

}  // namespace lobelight
