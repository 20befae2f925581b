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

// Kernels that reach this far, in radians, take all texels there are.
inline constexpr double kMostReach = 1.5;

// What a level is blurred by, as pyramid.gd hands it to the shader.
struct LevelKernel {
  bool is_gaussian;  // a disc otherwise
  double variance;   // in the middle of a face, in solid angles of the finer level's texels there
  double shrinking;  // what it has more towards the corners, times 1 − m³
  double slope;      // what a disc weighs more at its rim than in its middle
};

// Of the coarsest levels, by the texels along the side of a face: COARSE_DISCS in
// runtime/pyramid/pyramid.gd. Null for other levels.
inline const LevelKernel* coarse_disc(int size) {
  static constexpr LevelKernel kDiscs[] = {{false, 0.7939, 0.0, 0.0},
                                           {false, 2.3639, 0.4549, 0.0},
                                           {false, 4.3997, 0.4158, -0.9311},
                                           {false, 3.5345, 0.3712, -0.6316}};
  switch (size) {
    case 1:
      return &kDiscs[0];
    case 2:
      return &kDiscs[1];
    case 4:
      return &kDiscs[2];
    case 8:
      return &kDiscs[3];
    default:
      return nullptr;
  }
}

// The variance of the tent by which levels are looked up, in texels.
inline constexpr double kTentVariance = 1.0 / 6.0;

// The weight of a disc of some radius at a distance, with a rim `step` wide.
inline double disc_weight(double radius, double distance, double step, double slope) {
  const double rim = std::clamp((radius - distance) / step + 0.5, 0.0, 1.0);
  const double share = std::min(distance / radius, 1.0);
  return rim * (1.0 + slope * share * share);
}

}  // namespace lobelight
