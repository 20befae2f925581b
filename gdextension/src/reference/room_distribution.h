#pragma once

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>
#include <vector>

#include "base/progress.h"
#include "image/room.h"
#include "reference/incoming_light.h"
#include "reference/light_clusters.h"

namespace lobelight {

// The light of a room's walls at points within its box, with densities for importance sampling as
// EnvironmentDistribution has them: texels' weights are their brightness above the room's geometric
// mean times their area, and a direction is drawn by choosing a cluster, a texel in it and a place
// under the texel's interpolation tent. A density over a wall's area becomes one over directions by
//   p(direction) = p(area) · r² / cos θ,
// r being the distance to the wall and θ the angle to its normal.
class RoomDistribution : public IncomingLight {
 public:
  // Copies what it needs, as EnvironmentDistribution does. Throws std::invalid_argument when a wall
  // is empty, its sizes do not fit together or the room's size is not positive, and Cancelled when
  // `progress`, which may be null, is cancelled.
  explicit RoomDistribution(const Room& room, const Progress* progress = nullptr);

  // Points lie within the box, not on its walls.
  ClusterChoice choose(const glm::dvec3& point, const Reflectance& reflectance) const override;
  EnvironmentSample sample(const ClusterChoice& choice, const glm::dvec3& point,
                           const glm::dvec2& u) const override;
  EnvironmentSample at(const ClusterChoice& choice, const glm::dvec3& point,
                       const glm::dvec3& direction) const override;

 private:
  struct Wall {
    int width = 0;
    int height = 0;
    // Radiance, and the density over the unit square of (u, v), of all the walls' light.
    std::vector<glm::vec4> texels;
    LightClusters light;
    std::size_t first_cluster = 0;  // In a ClusterChoice, which has those of all walls in turn.
  };

  EnvironmentSample interpolate(const ClusterChoice& choice, const glm::dvec3& point,
                                const WallPosition& place, const glm::dvec3& direction) const;

  Room box_;  // Its walls are empty.
  std::array<Wall, kWalls> walls_;
  std::vector<double> shares_;  // Of the clusters of all walls.
};

}  // namespace lobelight
