#include "fit/pyramid_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

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

// Of faces of 1, 2, 4 and 8 texels, as the filter's levels were made to have them.
constexpr DrawnHarmonics kCoarse[] = {
    {1.0, 0.0482, 0.0307, 0.0224, 0.0026, -0.0069, -0.0076, -0.0048, -0.0015, 0.001, 0.0025},
    {1.0, 0.2497, -0.0172, -0.0311, -0.0037, 0.0102, 0.0112, 0.007, 0.0022, -0.0015, -0.0037},
    {1.0, 0.7252, 0.3748, 0.138, 0.0249, -0.0136, -0.0184, -0.0118, -0.0037, 0.0026, 0.0063},
    {1.0, 0.9432, 0.8243, 0.6538, 0.4715, 0.3101, 0.184, 0.0941, 0.0348, -0.0011, -0.0203}};
constexpr int kFinestFace = 8;  // faces of 2^8 texels

DrawnHarmonics kernel_harmonics(double variance) {
  // The midpoint rule over what the kernel reaches, in squared chords.
  constexpr int kNodes = 2000;
  const double end = std::min(4.0, 1.5 * kReach * variance);
  DrawnHarmonics sum{};
  for (int n = 0; n < kNodes; ++n) {
    const double squared = end * (n + 0.5) / kNodes;
    const double density = pyramid_kernel(squared / variance).density;
    const double cosine = 1.0 - 0.5 * squared;
    double before = 1.0, value = cosine;
    sum[0] += density;
    for (int l = 1; l <= kHarmonicDegrees; ++l) {
      sum[static_cast<std::size_t>(l)] += density * value;
      const double next = ((2.0 * l + 1.0) * cosine * value - l * before) / (l + 1.0);
      before = value;
      value = next;
    }
  }
  for (std::size_t l = sum.size(); l-- > 0;) sum[l] /= sum[0];
  return sum;
}

// Of faces of 2^n texels.
std::array<DrawnHarmonics, kFinestFace + 1> level_harmonics() {
  std::array<DrawnHarmonics, kFinestFace + 1> levels{};
  for (std::size_t n = 0; n < levels.size(); ++n) {
    levels[n] = n < std::size(kCoarse)
                    ? kCoarse[n]
                    : kernel_harmonics(4.0 * std::exp2(-2.0 * static_cast<double>(n)));
  }
  return levels;
}

}  // namespace

DrawnHarmonics drawn_harmonics(double variance) {
  static const auto levels = level_harmonics();
  const PyramidLevels found =
      pyramid_levels(std::clamp(variance, 4.0 * std::exp2(-2.0 * kFinestFace), 4.0));
  const auto finer = static_cast<std::size_t>(std::lround(1.0 - 0.5 * std::log2(found.finer)));
  const std::size_t coarser = finer > 0 ? finer - 1 : 0;
  DrawnHarmonics drawn{};
  for (std::size_t l = 0; l < drawn.size(); ++l) {
    drawn[l] =
        (1.0 - found.coarser_share) * levels[finer][l] + found.coarser_share * levels[coarser][l];
  }
  return drawn;
}

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
