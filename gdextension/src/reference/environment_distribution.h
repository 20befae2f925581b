#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "image/panorama.h"

namespace lobelight {

/// A direction drawn from an environment.
struct EnvironmentSample {
  glm::dvec3 direction;
  glm::dvec3 radiance;
  double pdf;  ///< Per steradian.
};

/// Radiance of a panorama together with a density over directions that follows what stands out of
/// its mean.
class EnvironmentDistribution {
 public:
  /// Takes a copy of the panorama; its negative and non-finite values count as 0.
  explicit EnvironmentDistribution(const Panorama& panorama);

  /// False where nothing stands out of the mean (a constant panorama): then there is no density.
  bool can_sample() const;

  /// `u` in [0, 1)². Only if can_sample().
  EnvironmentSample sample(const glm::dvec2& u) const;

  /// Radiance and density (0 unless can_sample()) at a unit vector.
  EnvironmentSample at(const glm::dvec3& direction) const;

 private:
  EnvironmentSample interpolate(const glm::dvec2& position, const glm::dvec3& direction) const;

  int width_;
  int height_;
  std::vector<glm::vec4> texels_;     // radiance, and the density over the unit square of (u, v)
  std::vector<double> rows_;          // cumulative over the rows, height + 1 values
  std::vector<double> columns_;       // per row cumulative over the columns, width + 1 values each
};

}  // namespace lobelight
