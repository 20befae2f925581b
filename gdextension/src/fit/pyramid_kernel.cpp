#include "fit/pyramid_kernel.h"

#include <algorithm>
#include <cmath>

#include "base/pi.h"

namespace lobelight {

namespace {

// (1 − t/T)^4 has variance 1 per axis for T = 2 (4 + 2).
constexpr double kReach = 12.0;
constexpr double kFloor = 1e-4;

// The part of K within t = 4 / variance, where the sphere ends.
double mass_on_sphere(double variance) {
  const double end = 4.0 / variance;
  const double z = std::max(0.0, 1.0 - end / kReach);
  const double spread = 1.0 / (1.0 + 0.5 * end);
  return 1.0 - (1.0 - kFloor) * z * z * z * z * z - kFloor * spread * spread;
}

}  // namespace

KernelValue pyramid_kernel(double t) {
  // (5 / (π T)) (1 − t/T)^4 and (1/π) (1 + t/2)⁻³ both have mass 1 and variance 1 per axis.
  constexpr double kScale = (1.0 - kFloor) * 5.0 / (kPi * kReach);
  const double z = std::max(0.0, 1.0 - t / kReach);
  const double z3 = z * z * z;
  const double spread = 1.0 / (1.0 + 0.5 * t);
  const double tail = kFloor / kPi * spread * spread * spread;
  return {kScale * z3 * z + tail, -kScale * 4.0 / kReach * z3 - 1.5 * tail * spread};
}

PyramidLevels pyramid_levels(double variance) {
  const double finer = std::exp2(2.0 * std::floor(0.5 * std::log2(variance)));
  // Rounding may put a level's own variance on either side of it.
  return {finer, std::clamp((variance / finer - 1.0) / 3.0, 0.0, 1.0)};
}

DrawnLobe::DrawnLobe(double variance) {
  const PyramidLevels levels = pyramid_levels(variance);
  inverse_finer_ = 1.0 / levels.finer;
  finer_scale_ = inverse_finer_ / mass_on_sphere(levels.finer);
  coarser_scale_ = 0.25 * inverse_finer_ / mass_on_sphere(4.0 * levels.finer);
  coarser_share_ = levels.coarser_share;
  share_by_log_variance_ = variance * inverse_finer_ / 3.0;
}

DrawnLobe::Value DrawnLobe::at(double squared_chord) const {
  const double t = squared_chord * inverse_finer_;
  const KernelValue finer = pyramid_kernel(t);
  const KernelValue coarser = pyramid_kernel(0.25 * t);
  const double fine = finer_scale_ * finer.density;
  const double coarse = coarser_scale_ * coarser.density;
  return {(1.0 - coarser_share_) * fine + coarser_share_ * coarse,
          ((1.0 - coarser_share_) * finer_scale_ * finer.slope +
           0.25 * coarser_share_ * coarser_scale_ * coarser.slope) *
              inverse_finer_,
          (coarse - fine) * share_by_log_variance_};
}

}  // namespace lobelight
