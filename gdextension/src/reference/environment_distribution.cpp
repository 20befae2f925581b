#include "reference/environment_distribution.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "base/pi.h"

namespace lobelight {
namespace {

// So many that what a cluster's mean direction misses is little light; so few that looking at each
// of them costs less than the samples of a pixel.
constexpr std::size_t kClusters = 8192;

double brightness(const glm::vec4& texel) {
  return (static_cast<double>(texel.r) + static_cast<double>(texel.g) +
          static_cast<double>(texel.b)) /
         3.0;
}

// Brightness above the map's geometric mean times the sine of the polar angle, for each texel.
std::vector<double> texel_weights(const std::vector<glm::vec4>& texels, int width, int height,
                                  const Progress* progress) {
  // Black texels count as much darker than any that matters, not as −∞.
  constexpr double kBlack = 1e-30;
  std::vector<double> weights(texels.size());
  const auto sine = [&](std::size_t texel) {
    const std::size_t row = texel / static_cast<std::size_t>(width);
    return std::sin(kPi * (static_cast<double>(row) + 0.5) / height);
  };
  double sum = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    throw_if_cancelled(progress, i);
    sum += std::log(std::max(brightness(texels[i]), kBlack)) * sine(i);
    area += sine(i);
  }
  // Rounding alone must not lift texels of a constant panorama above its mean.
  const double mean = (1.0 + 1e-9) * std::exp(sum / area);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    throw_if_cancelled(progress, i);
    weights[i] = std::max(0.0, brightness(texels[i]) - mean) * sine(i);
  }
  return weights;
}

}  // namespace

EnvironmentDistribution::EnvironmentDistribution(const Panorama& panorama, const Progress* progress)
    : width_(panorama.width), height_(panorama.height) {
  if (width_ < 1 || height_ < 1 ||
      panorama.rgb.size() !=
          3 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {
    throw std::invalid_argument("A panorama needs at least one texel and three values in each.");
  }
  const auto is_light = [](float value) { return value >= 0.0f && std::isfinite(value); };
  if (!std::all_of(panorama.rgb.begin(), panorama.rgb.end(), is_light)) {
    Panorama clean = panorama;
    clean.sanitise();
    *this = EnvironmentDistribution(clean, progress);
    return;
  }
  const std::vector<float>& rgb = panorama.rgb;
  texels_.resize(rgb.size() / 3);
  for (std::size_t i = 0; i < texels_.size(); ++i) {
    throw_if_cancelled(progress, i);
    texels_[i] = {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2], 0.0f};
  }
  const std::vector<double> weights = texel_weights(texels_, width_, height_, progress);
  light_ = make_light_clusters(width_, height_, weights, kClusters, progress);
  if (light_.clusters.empty()) return;
  // A tent of height 1 integrates to 1/(width · height) over the unit square.
  for (std::size_t k = 0; k < light_.order.size(); ++k) {
    const double share = light_.cumulative[k + 1] - light_.cumulative[k];
    texels_[light_.order[k]].a = static_cast<float>(share * static_cast<double>(texels_.size()));
  }
}

ClusterChoice EnvironmentDistribution::choose_by(const std::vector<double>& importance) const {
  std::vector<double> shares;
  shares.reserve(light_.clusters.size());
  for (const LightCluster& cluster : light_.clusters) shares.push_back(cluster.share);
  return choose_in_proportion(importance, shares);
}

ClusterChoice EnvironmentDistribution::choose(const glm::dvec3&,
                                              const Reflectance& reflectance) const {
  std::vector<double> importance;
  importance.reserve(light_.clusters.size());
  for (const LightCluster& cluster : light_.clusters) {
    importance.push_back(reflectance(cluster.direction));
  }
  return choose_by(importance);
}

EnvironmentSample EnvironmentDistribution::sample(const ClusterChoice& choice, const glm::dvec3&,
                                                  const glm::dvec2& u) const {
  return sample(choice, u);
}

EnvironmentSample EnvironmentDistribution::at(const ClusterChoice& choice, const glm::dvec3&,
                                              const glm::dvec3& direction) const {
  return at(choice, direction);
}

EnvironmentSample EnvironmentDistribution::interpolate(const ClusterChoice& choice,
                                                       const glm::dvec2& position,
                                                       const glm::dvec3& direction) const {
  const double x = position.x * width_ - 0.5;
  const double y = glm::clamp(position.y * height_ - 0.5, 0.0, height_ - 1.0);
  const double left = std::floor(x);
  const double top = std::floor(y);
  const std::size_t width = static_cast<std::size_t>(width_);
  const std::size_t column = left < 0.0 ? width - 1 : static_cast<std::size_t>(left);
  const std::size_t next_column = column + 1 < width ? column + 1 : 0;
  const std::size_t row = static_cast<std::size_t>(top);
  const std::size_t next_row = std::min(row + 1, static_cast<std::size_t>(height_) - 1);
  const double weight_x = x - left;
  const double weight_y = y - top;
  const std::size_t texels[4] = {row * width + column, row * width + next_column,
                                 next_row * width + column, next_row * width + next_column};
  const double weights[4] = {(1.0 - weight_x) * (1.0 - weight_y), weight_x * (1.0 - weight_y),
                             (1.0 - weight_x) * weight_y, weight_x * weight_y};
  glm::dvec3 radiance(0.0);
  double density = 0.0;
  for (int k = 0; k < 4; ++k) {
    const glm::vec4& texel = texels_[texels[k]];
    radiance += weights[k] * glm::dvec3(texel);
    if (texel.a > 0.0f && !choice.empty()) {
      density +=
          weights[k] * static_cast<double>(texel.a) * choice.scale[light_.cluster_of[texels[k]]];
    }
  }
  if (!(density > 0.0)) return {direction, radiance, 0.0};
  // dω = 2π² sin θ du dv
  const double sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  return {direction, radiance, density / (2.0 * kPi * kPi * sine)};
}

EnvironmentSample EnvironmentDistribution::at(const ClusterChoice& choice,
                                              const glm::dvec3& direction) const {
  return interpolate(choice, panorama_position(direction), direction);
}

EnvironmentSample EnvironmentDistribution::sample(const ClusterChoice& choice,
                                                  const glm::dvec2& u) const {
  const std::vector<double>& cumulative = choice.cumulative;
  const auto above = std::upper_bound(cumulative.begin() + 1, cumulative.end() - 1, u.x);
  double rest = std::clamp((u.x - above[-1]) / (*above - above[-1]), 0.0, std::nextafter(1.0, 0.0));
  const std::size_t cluster = static_cast<std::size_t>(above - cumulative.begin()) - 1;
  const std::size_t texel = light_.order[light_.choose(light_.clusters[cluster], rest)];
  const std::size_t width = static_cast<std::size_t>(width_);
  const double x = (static_cast<double>(texel % width) + 0.5 + sample_tent(rest)) / width_;
  const double y = (static_cast<double>(texel / width) + 0.5 + sample_tent(u.y)) / height_;
  // Wrapped around the axis; mirrored at the poles, which amounts to the clamped interpolation.
  const glm::dvec2 position(x - std::floor(x), y < 0.0 ? -y : (y > 1.0 ? 2.0 - y : y));
  return interpolate(choice, position, panorama_direction(position));
}

}  // namespace lobelight
