#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "base/progress.h"
#include "image/panorama.h"
#include "reference/incoming_light.h"
#include "reference/light_clusters.h"

namespace lobelight {

// A panorama's radiance, with densities over directions for importance sampling.
//
// A texel's weight is its brightness above the map's typical one (the geometric mean, which a sun
// does not move) times its solid angle. The rest is left out because samples of the BRDF cover it
// better: compare Karlík et al. 2019, "MIS compensation: optimizing sampling techniques in multiple
// importance sampling", section 5. A direction is drawn by choosing a cluster, a texel in it and a
// place under the texel's interpolation tent; so the density is the bilinear interpolation of
// weights, just as the radiance is that of values, and positive wherever a bright texel reaches.
class EnvironmentDistribution : public IncomingLight {
 public:
  // Copies what it needs, 38 bytes for each texel while it is made and 30 later. Values
  // that are no light count as Panorama::sanitise() makes them. Throws std::invalid_argument when
  // the panorama is empty or its sizes do not fit together, and Cancelled when `progress`, which
  // may be null, is cancelled.
  explicit EnvironmentDistribution(const Panorama& panorama, const Progress* progress = nullptr);

  // Empty for a constant panorama, where nothing stands out.
  const std::vector<LightCluster>& clusters() const { return light_.clusters; }

  // Chooses clusters in proportion to `importance` (one value ≥ 0 each) times their share of the
  // light. Empty when all products are 0.
  ClusterChoice choose_by(const std::vector<double>& importance) const;

  // Draws a direction; u in [0, 1)². The choice must not be empty.
  EnvironmentSample sample(const ClusterChoice& choice, const glm::dvec2& u) const;

  // Radiance and density (0 if the choice is empty) at a unit vector.
  EnvironmentSample at(const ClusterChoice& choice, const glm::dvec3& direction) const;

  // The light is far away: the point does not matter.
  ClusterChoice choose(const glm::dvec3& point, const Reflectance& reflectance) const override;
  EnvironmentSample sample(const ClusterChoice& choice, const glm::dvec3& point,
                           const glm::dvec2& u) const override;
  EnvironmentSample at(const ClusterChoice& choice, const glm::dvec3& point,
                       const glm::dvec3& direction) const override;

 private:
  EnvironmentSample interpolate(const ClusterChoice& choice, const glm::dvec2& position,
                                const glm::dvec3& direction) const;

  int width_;
  int height_;
  std::vector<glm::vec4> texels_;  // Radiance, and the density over the unit square of (u, v).
  LightClusters light_;
};

}  // namespace lobelight
