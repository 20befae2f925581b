#pragma once

#include <vector>

#include "base/progress.h"
#include "reference/gaussian_convolution.h"
#include "table/lobe_table.h"

namespace lobelight {

// The sphere of render_sphere() as a table's lobes, coloured where the table is, see it, each lobe
// under the light exactly: the table's own error, without that of the run time's pyramid. size² · 3
// values of linear radiance, row by row from the top, background 0. Throws Cancelled.
std::vector<float> render_table(const GaussianConvolution& light, const LobeTable& table, int size,
                                int threads, Progress& progress);

// The peak signal-to-noise ratio of two pictures of the sphere, in dB, as ./dev compare has it:
// over the pixels with x² + y² < 0.9995, exposed so that the reference's median is 0.18, clamped,
// to the power of 1/2.2. Infinite for equal pictures. Throws std::invalid_argument where the median
// of the reference is 0 or a pixel is not finite.
double sphere_psnr(const std::vector<float>& picture, const std::vector<float>& reference,
                   int size);

}  // namespace lobelight
