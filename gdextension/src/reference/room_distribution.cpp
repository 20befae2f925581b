#include "reference/room_distribution.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace lobelight {
namespace {

// As of EnvironmentDistribution, for all walls together.
constexpr std::size_t kClusters = 8192;

double brightness(const glm::vec4& texel) {
  return (static_cast<double>(texel.r) + static_cast<double>(texel.g) +
          static_cast<double>(texel.b)) /
         3.0;
}

std::vector<glm::vec4> texels_of(Panorama picture, const Progress* progress) {
  if (picture.width < 1 || picture.height < 1 ||
      picture.rgb.size() !=
          3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height)) {
    throw std::invalid_argument("A wall needs at least one texel and three values in each.");
  }
  picture.sanitise();
  std::vector<glm::vec4> texels(picture.rgb.size() / 3);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    throw_if_cancelled(progress, i);
    texels[i] = {picture.rgb[3 * i], picture.rgb[3 * i + 1], picture.rgb[3 * i + 2], 0.0f};
  }
  return texels;
}

}  // namespace

RoomDistribution::RoomDistribution(const Room& room, const Progress* progress) {
  box_.size = room.size;
  if (!(room.size.x > 0.0 && room.size.y > 0.0 && room.size.z > 0.0)) {
    throw std::invalid_argument("A room's size is positive.");
  }
  // Black texels count as much darker than any that matters, not as −∞.
  constexpr double kBlack = 1e-30;
  double logarithms = 0.0;
  double area = 0.0;
  for (std::size_t w = 0; w < kWalls; ++w) {
    Wall& wall = walls_[w];
    wall.texels = texels_of(room.walls[w], progress);
    wall.width = room.walls[w].width;
    wall.height = room.walls[w].height;
    const double texel_area = box_.wall_area(w) / static_cast<double>(wall.texels.size());
    for (std::size_t i = 0; i < wall.texels.size(); ++i) {
      throw_if_cancelled(progress, i);
      logarithms += std::log(std::max(brightness(wall.texels[i]), kBlack)) * texel_area;
    }
    area += box_.wall_area(w);
  }
  // Rounding alone must not lift texels of constant walls above their mean.
  const double mean = (1.0 + 1e-9) * std::exp(logarithms / area);
  std::array<std::vector<double>, kWalls> weights;
  std::array<double, kWalls> sums{};
  double total = 0.0;
  for (std::size_t w = 0; w < kWalls; ++w) {
    const std::vector<glm::vec4>& texels = walls_[w].texels;
    const double texel_area = box_.wall_area(w) / static_cast<double>(texels.size());
    weights[w].resize(texels.size());
    for (std::size_t i = 0; i < texels.size(); ++i) {
      throw_if_cancelled(progress, i);
      weights[w][i] = std::max(0.0, brightness(texels[i]) - mean) * texel_area;
      sums[w] += weights[w][i];
    }
    total += sums[w];
  }
  for (std::size_t w = 0; w < kWalls; ++w) {
    Wall& wall = walls_[w];
    wall.first_cluster = shares_.size();
    if (!(sums[w] > 0.0)) continue;
    const double wall_share = sums[w] / total;
    const auto count =
        static_cast<std::size_t>(std::ceil(wall_share * static_cast<double>(kClusters)));
    const double tall = glm::length(box_.point({w, {0.0, 1.0}}) - box_.point({w, {0.0, 0.0}}));
    const double wide = glm::length(box_.point({w, {1.0, 0.0}}) - box_.point({w, {0.0, 0.0}}));
    const double texel_side = std::max(tall / wall.height, wide / wall.width);
    const TexelSpace space{
        [this, w](double u, double v) {
          return box_.point({w, {u, v}});
        },
        [texel_side](int size, double) { return texel_side * size; },
        false,
    };
    wall.light = make_light_clusters(wall.width, wall.height, weights[w], count, space, progress);
    for (const LightCluster& cluster : wall.light.clusters) {
      shares_.push_back(wall_share * cluster.share);
    }
    // A tent of height 1 integrates to 1/(width · height) over the unit square.
    for (std::size_t k = 0; k < wall.light.order.size(); ++k) {
      const double share = wall.light.cumulative[k + 1] - wall.light.cumulative[k];
      wall.texels[wall.light.order[k]].a =
          static_cast<float>(wall_share * share * static_cast<double>(wall.texels.size()));
    }
  }
}

// A cluster's light falls off as its solid angle does, by cos θ / r².
ClusterChoice RoomDistribution::choose(const glm::dvec3& point,
                                       const Reflectance& reflectance) const {
  std::vector<double> importance;
  importance.reserve(shares_.size());
  for (std::size_t w = 0; w < kWalls; ++w) {
    for (const LightCluster& cluster : walls_[w].light.clusters) {
      const glm::dvec3 way = cluster.direction - point;
      const double distance = glm::length(way);
      const double across = std::abs(way[wall_axis(w)]);
      importance.push_back(reflectance(way / distance) * across / (distance * distance * distance));
    }
  }
  return choose_in_proportion(importance, shares_);
}

EnvironmentSample RoomDistribution::interpolate(const ClusterChoice& choice,
                                                const glm::dvec3& point, const WallPosition& place,
                                                const glm::dvec3& direction) const {
  const Wall& wall = walls_[place.wall];
  const double x = glm::clamp(place.position.x * wall.width - 0.5, 0.0, wall.width - 1.0);
  const double y = glm::clamp(place.position.y * wall.height - 0.5, 0.0, wall.height - 1.0);
  const auto width = static_cast<std::size_t>(wall.width);
  const auto column = static_cast<std::size_t>(x);
  const auto row = static_cast<std::size_t>(y);
  const std::size_t next_column = std::min(column + 1, width - 1);
  const std::size_t next_row = std::min(row + 1, static_cast<std::size_t>(wall.height) - 1);
  const double weight_x = x - static_cast<double>(column);
  const double weight_y = y - static_cast<double>(row);
  const std::size_t texels[4] = {row * width + column, row * width + next_column,
                                 next_row * width + column, next_row * width + next_column};
  const double weights[4] = {(1.0 - weight_x) * (1.0 - weight_y), weight_x * (1.0 - weight_y),
                             (1.0 - weight_x) * weight_y, weight_x * weight_y};
  glm::dvec3 radiance(0.0);
  double density = 0.0;
  for (int k = 0; k < 4; ++k) {
    const glm::vec4& texel = wall.texels[texels[k]];
    radiance += weights[k] * glm::dvec3(texel);
    if (texel.a > 0.0f && !choice.empty()) {
      const std::size_t cluster = wall.first_cluster + wall.light.cluster_of[texels[k]];
      density += weights[k] * static_cast<double>(texel.a) * choice.scale[cluster];
    }
  }
  if (!(density > 0.0)) return {direction, radiance, 0.0};
  const int axis = wall_axis(place.wall);
  const double cosine = std::abs(direction[axis]);
  const double distance =
      std::abs((box_.point(place)[axis] - point[axis]) / std::max(cosine, 1e-12));
  return {direction, radiance,
          density / box_.wall_area(place.wall) * distance * distance / std::max(cosine, 1e-12)};
}

EnvironmentSample RoomDistribution::at(const ClusterChoice& choice, const glm::dvec3& point,
                                       const glm::dvec3& direction) const {
  return interpolate(choice, point, box_.meet(point, direction), direction);
}

EnvironmentSample RoomDistribution::sample(const ClusterChoice& choice, const glm::dvec3& point,
                                           const glm::dvec2& u) const {
  const std::vector<double>& cumulative = choice.cumulative;
  const auto above = std::upper_bound(cumulative.begin() + 1, cumulative.end() - 1, u.x);
  double rest = std::clamp((u.x - above[-1]) / (*above - above[-1]), 0.0, std::nextafter(1.0, 0.0));
  const std::size_t chosen = static_cast<std::size_t>(above - cumulative.begin()) - 1;
  std::size_t w = kWalls - 1;
  while (walls_[w].first_cluster > chosen || walls_[w].light.clusters.empty()) --w;
  const Wall& wall = walls_[w];
  const LightCluster& cluster = wall.light.clusters[chosen - wall.first_cluster];
  const std::size_t texel = wall.light.order[wall.light.choose(cluster, rest)];
  const std::size_t width = static_cast<std::size_t>(wall.width);
  const double x = (static_cast<double>(texel % width) + 0.5 + sample_tent(rest)) / wall.width;
  const double y = (static_cast<double>(texel / width) + 0.5 + sample_tent(u.y)) / wall.height;
  // Mirrored at the edges, which amounts to the clamped interpolation.
  const auto mirrored = [](double place) {
    return place < 0.0 ? -place : (place > 1.0 ? 2.0 - place : place);
  };
  const WallPosition place{w, {mirrored(x), mirrored(y)}};
  return interpolate(choice, point, place, glm::normalize(box_.point(place) - point));
}

}  // namespace lobelight
