#include "reference/gaussian_convolution.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "base/pi.h"

namespace lobelight {

namespace {

// Texels are summed where the lobe's standard deviation spans at least this many of them; what is
// left out of a Gaussian sampled that densely is below 1e-8 of it.
constexpr double kTexelsPerDeviation = 2.0;

// Where a lobe is cut off, in standard deviations: e^{-5²/2} = 4e-6.
constexpr double kCutOff = 5.0;

// Nodes of a lobe that is narrower than that, on rings at equal distances.
constexpr int kRings = 16;
constexpr int kNodesPerRing = 16;

// Added to the brightness of texels when their light's centre is taken, for those without light.
constexpr double kDark = 1e-12;

}  // namespace

GaussianConvolution::GaussianConvolution(Panorama panorama, const Progress* progress)
    : panorama_(std::move(panorama)) {
  panorama_.sanitise();
  Level level;
  level.width = panorama_.width;
  level.height = panorama_.height;
  level.angle = kPi / level.height;
  // Bilinear interpolation spreads a texel by a triangle of variance angle² / 6.
  level.variance = level.angle * level.angle / 6.0;
  level.radiance.reserve(panorama_.rgb.size() / 3);
  level.direction.reserve(panorama_.rgb.size() / 3);
  const float* texel = panorama_.rgb.data();
  for (int row = 0; row < level.height; ++row) {
    throw_if_cancelled(progress);
    for (int column = 0; column < level.width; ++column, texel += 3) {
      level.radiance.emplace_back(texel[0], texel[1], texel[2]);
      level.direction.push_back(
          panorama_direction({(column + 0.5) / level.width, (row + 0.5) / level.height}));
    }
  }
  set_solid_angles(level);
  levels_.push_back(std::move(level));
  while (levels_.back().width % 2 == 0 && levels_.back().height % 2 == 0 &&
         levels_.back().height >= 16) {
    levels_.push_back(coarser(levels_.front(), levels_.back(), progress));
  }
}

void GaussianConvolution::set_solid_angles(Level& level) {
  for (int row = 0; row < level.height; ++row) {
    level.solid_angle.push_back(2.0 * kPi / level.width *
                                (std::cos(row * level.angle) - std::cos((row + 1) * level.angle)));
  }
}

GaussianConvolution::Level GaussianConvolution::coarser(const Level& finest, const Level& finer,
                                                        const Progress* progress) {
  Level level;
  level.width = finer.width / 2;
  level.height = finer.height / 2;
  level.angle = 2.0 * finer.angle;
  // The texels that became one lie this far from its centre.
  level.variance =
      finest.variance + (level.angle * level.angle - finest.angle * finest.angle) / 12.0;
  const std::size_t texels =
      static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height);
  level.radiance.reserve(texels);
  level.direction.reserve(texels);
  for (int row = 0; row < level.height; ++row) {
    throw_if_cancelled(progress);
    for (int column = 0; column < level.width; ++column) {
      glm::dvec3 sum(0.0);
      double mass = 0.0;
      // A small light stays where it is, not in the middle of a coarse texel.
      glm::dvec3 centre(0.0);
      for (int part = 0; part < 4; ++part) {
        const auto r = static_cast<std::size_t>(2 * row + part / 2);
        const auto c = static_cast<std::size_t>(2 * column + part % 2);
        const double weight = finer.solid_angle[r];
        const std::size_t texel = r * static_cast<std::size_t>(finer.width) + c;
        const glm::dvec3& radiance = finer.radiance[texel];
        sum += weight * radiance;
        mass += weight;
        centre += weight * (radiance.r + radiance.g + radiance.b + kDark) * finer.direction[texel];
      }
      level.radiance.push_back(sum / mass);
      level.direction.push_back(glm::normalize(centre));
    }
  }
  set_solid_angles(level);
  return level;
}

glm::dvec3 GaussianConvolution::convolve(const SphericalGaussian& gaussian) const {
  const double deviation = 1.0 / std::sqrt(std::max(gaussian.kappa, 1e-3));
  const Level* chosen = nullptr;
  for (const Level& level : levels_) {
    if (kTexelsPerDeviation * level.angle <= deviation) chosen = &level;
  }
  return chosen ? sum(*chosen, gaussian) : sample(gaussian);
}

glm::dvec3 GaussianConvolution::sum(const Level& level, const SphericalGaussian& gaussian) const {
  // Variances add: the Gaussian is widened by what lies between the texels' centres.
  const double kappa = 1.0 / (1.0 / std::max(gaussian.kappa, 1e-3) + level.variance);
  const double reach = kCutOff / std::sqrt(kappa);
  const glm::dvec2 centre = panorama_position(gaussian.mean);
  const double polar = kPi * centre.y;

  const int first = std::max(0, static_cast<int>((polar - reach) / level.angle));
  const int last = std::min(level.height - 1, static_cast<int>((polar + reach) / level.angle));
  // How far a cap of radius `reach` goes around the axis; all around where it holds a pole.
  int half_width = level.width;
  if (polar - reach > 0.0 && polar + reach < kPi && reach < 0.5 * kPi) {
    const double turn = std::asin(std::min(1.0, std::sin(reach) / std::sin(polar)));
    half_width = static_cast<int>(turn / (2.0 * kPi) * level.width) + 1;
  }
  const int middle = static_cast<int>(centre.x * level.width);
  const int columns = std::min(level.width, 2 * half_width + 1);

  glm::dvec3 light(0.0);
  double mass = 0.0;
  for (int row = first; row <= last; ++row) {
    for (int n = 0; n < columns; ++n) {
      const int column = ((middle - columns / 2 + n) % level.width + level.width) % level.width;
      const auto texel = static_cast<std::size_t>(row * level.width + column);
      const glm::dvec3 away = level.direction[texel] - gaussian.mean;
      const double share = level.solid_angle[static_cast<std::size_t>(row)] *
                           std::exp(-0.5 * kappa * glm::dot(away, away));
      light += share * level.radiance[texel];
      mass += share;
    }
  }
  return light / mass;
}

glm::dvec3 GaussianConvolution::sample(const SphericalGaussian& gaussian) const {
  glm::dvec3 light(0.0);
  double mass = 0.0;
  for (int ring = 0; ring < kRings; ++ring) {
    // In standard deviations from the mean, where 1 − e^{−r²/2} of the lobe's mass lies within.
    const double r = kCutOff * (ring + 0.5) / kRings;
    const double outside = std::exp(-0.5 * r * r);
    for (int node = 0; node < kNodesPerRing; ++node) {
      // Every ring is turned against the one before.
      const double turn = (node + 0.5 * (ring % 2)) / kNodesPerRing;
      light += r * outside * panorama_.sample(lobelight::sample(gaussian, {1.0 - outside, turn}));
      mass += r * outside;
    }
  }
  return light / mass;
}

}  // namespace lobelight
