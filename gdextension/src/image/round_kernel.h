#pragma once

#include <algorithm>

namespace lobelight {

// The round kernels that levels of a pyramid of light are blurred with: the constants of
// shaders/round_kernel.gdshaderinc.

// A Gaussian ends at this many standard deviations R,
inline constexpr double kKernelReach = 3.0;
// and what is left has this share of its variance per axis: 1 − R²/2 e^(−R²/2) / (1 − e^(−R²/2)).
inline constexpr double kReachedShare = 0.94945;
// The rim of a disc falls off linearly over one texel of the finer level. In squares of it, the rim
// adds this much to the disc's variance per axis, R²/4.
inline constexpr double kRimVariance = 0.104;

// The variance of the tent by which levels are looked up, in texels.
inline constexpr double kTentVariance = 1.0 / 6.0;

// The weight of a disc of some radius at a distance, with a rim `step` wide.
inline double disc_weight(double radius, double distance, double step) {
  return std::clamp((radius - distance) / step + 0.5, 0.0, 1.0);
}

}  // namespace lobelight
