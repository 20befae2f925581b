#pragma once

// The kernel that is drawn in place of a spherical Gaussian of variance V. The shader looks the
// environment's pyramid up at the level of that variance, and the pyramid's levels are blurred by
// discs, not by Gaussians (runtime/shaders/environment.gdshaderinc and pyramid_round.gdshader of
// the addon).
//
// Level l is blurred by V_l = (2 · 2^l / S)² per axis, the finest levels by a little less. S, the
// texels along a side of a face, is a power of two, so V_l takes the same values for all sizes.
// Between two levels the sampler mixes linearly: V is drawn as (1 − f) K(V_l) + f K(4 V_l), where V
// = (1 − f) V_l + f · 4 V_l. All levels have the same kernel K, each with its own width.

#include <array>

namespace lobelight {

// A model of K with variance 1 per axis: its density in the plane at the squared distance t, and
// the derivative dK/dt.
//
// The real kernel of level l is a chain of discs of variance 5/8, 5/32, 5/128 … and the tent of the
// bilinear lookup, of variance 1/6, in texels squared. A disc's density is (1 − t/T)⁰ up to its
// edge; chains of discs come close to higher powers. (1 − t/T)⁴ has the fourth moment of the chain
// (E r⁴ / (E r²)² = 12/7; a Gaussian has 2), and the mass within any radius differs from the
// chain's by at most 0.01. A share of 1e-4 of the mass is spread out as (1 + t/2)⁻³, so that the
// density is nowhere 0: where a slice reaches beyond every lobe, the likelihood falls much, but
// stays finite.
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

// By which factor the light's spherical harmonics of each degree shrink when they are looked up
// through a lobe of this variance, as it is drawn, for variances from (2/256)² to 4. The coarsest
// levels, with faces of 8 texels or fewer, are blurred by discs of their own (COARSE_DISCS in the
// addon's runtime/pyramid/pyramid.gd), not by K.
inline constexpr int kHarmonicDegrees = 10;
using DrawnHarmonics = std::array<double, kHarmonicDegrees + 1>;
DrawnHarmonics drawn_harmonics(double variance);

// A lobe as it is drawn, as a density on the sphere. Distances are chords: areas by chord are those
// of the plane, so K stays normalised. The part of K beyond the sphere (chords above 2) is made up
// for.
class DrawnLobe {
 public:
  explicit DrawnLobe(double variance);

  // The density at the squared chord r² from the mean, and its derivatives by r² and by the
  // logarithm of the variance. The second derivative jumps where the variance is exactly a level's.
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
