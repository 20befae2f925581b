#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "base/progress.h"

namespace lobelight {

// A square of texels of a picture that is sampled as a whole.
struct LightCluster {
  // The weighted mean of its texels' directions, a unit vector; on a flat picture, of their places.
  glm::dvec3 direction;
  double share;       // Of all weight; the shares sum to 1.
  std::size_t first;  // Its texels in LightClusters::order: first to last − 1.
  std::size_t last;
};

// The weights of a picture's texels in clusters that are small where the weight is large: cells of
// a quadtree, compare Agarwal et al. 2003, "Structured importance sampling of environment maps".
struct LightClusters {
  std::vector<LightCluster> clusters;     // Empty when no texel has weight.
  std::vector<std::uint16_t> cluster_of;  // For each texel; meaningless where it has no weight.
  std::vector<std::uint32_t> order;       // The texels with weight, along the quadtree.
  std::vector<double> cumulative;         // Of their shares, order.size() + 1 values from 0 to 1.

  // Index into `order`, drawn within one cluster in proportion to the weights; u in [0, 1) becomes
  // what is left of it for further choices.
  std::size_t choose(const LightCluster& cluster, double& u) const;
};

// What a picture's texels are in space.
struct TexelSpace {
  std::function<glm::dvec3(double u, double v)> place;
  // How large a square of `size` texels a side is whose middle is at `v`.
  std::function<double(int size, double v)> extent;
  bool is_sphere;  // Whether places are unit vectors.
};

// `weights`: width · height values ≥ 0, row by row. `count`: clusters wanted, 1 to 65000; fewer
// when there are fewer texels with weight, a few more because a cell has four children. Throws
// Cancelled when `progress`, which may be null, is cancelled.
LightClusters make_light_clusters(int width, int height, const std::vector<double>& weights,
                                  std::size_t count, const TexelSpace& space,
                                  const Progress* progress = nullptr);

// The same for a panorama.
LightClusters make_light_clusters(int width, int height, const std::vector<double>& weights,
                                  std::size_t count, const Progress* progress = nullptr);

}  // namespace lobelight
