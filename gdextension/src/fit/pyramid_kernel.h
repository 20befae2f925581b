#pragma once

// What is drawn where a table says "spherical Gaussian of variance V": the environment's pyramid,
// made by discs, looked up at the level of that variance (the addon's
// runtime/shaders/environment.gdshaderinc and pyramid_round.gdshader).
//
// Level l blurs by V_l = (2 · 2^l / S)² per axis and a little less at the finest levels: faces have
// S texels a side, a power of two, so that all sizes share one ladder of variances. Between two
// levels the sampler mixes linearly: V is drawn as (1 − f) K(V_l) + f K(4 V_l),
// V = (1 − f) V_l + f · 4 V_l. All levels have the same kernel K but for its width.

#include <array>

namespace lobelight {

// K at the squared distance t, in variances, and dK/dt: a density in the plane with variance 1 per
// axis.
//
// Level l is the environment blurred by discs of variance 5/8, 5/32, 5/128 … and by the tent of the
// bilinear lookup, 1/6, in texels squared. A disc's density in the plane is a power of 1 − t/T with
// exponent 0; sums of discs are close to higher powers. The exponent 4 has K's fourth moment
// (E r⁴ / (E r²)² = 12/7; a Gaussian has 2) and no share of its mass is further than 0.01 from K's.
// 1e-4 of the mass is spread out as (1 + t/2)⁻³, so that a slice that reaches beyond every lobe
// costs much, but not everything.
struct KernelValue {
  double density = 0.0;
  double slope = 0.0;
};
KernelValue pyramid_kernel(double t);

// The two levels that a variance is looked up in.
struct PyramidLevels {
  double finer = 0.0;          // V_l ≤ variance; the coarser level's is 4 V_l
  double coarser_share = 0.0;  // f ∈ [0, 1)
};
PyramidLevels pyramid_levels(double variance);

// What is left of the light's spherical harmonics of each degree in a lobe of a variance as it is
// drawn, for variances from (2/256)² to 4. The coarsest levels, whose faces have 8 texels or fewer,
// are blurred by discs of their own (COARSE_DISCS in the addon's runtime/pyramid/pyramid.gd), not
// by K.
inline constexpr int kHarmonicDegrees = 10;
using DrawnHarmonics = std::array<double, kHarmonicDegrees + 1>;
DrawnHarmonics drawn_harmonics(double variance);

// A lobe as it is drawn, as a density on the sphere: distances are chords, in which the area of the
// sphere is that of the plane, so that K's norm holds; what would lie beyond the sphere (chords
// above 2) is made up for.
class DrawnLobe {
 public:
  explicit DrawnLobe(double variance);

  // The density at the squared chord r² from the mean, its derivative by r² and by the logarithm of
  // the variance. The latter jumps where the variance is a level's.
  struct Value {
    double density = 0.0;
    double by_distance = 0.0;
    double by_log_variance = 0.0;
  };
  Value at(double squared_chord) const;

 private:
  double inverse_finer_;  // 1 / V_l
  double finer_scale_;    // the levels' norms on the sphere
  double coarser_scale_;
  double coarser_share_;
  double share_by_log_variance_;
};

}  // namespace lobelight
