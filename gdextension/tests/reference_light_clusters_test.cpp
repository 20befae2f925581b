#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>

#include "image/panorama.h"
#include "reference/light_clusters.h"

namespace lobelight {
namespace {

std::vector<double> random_weights(int width, int height, double empty_share) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> weights(static_cast<std::size_t>(width * height));
  for (double& weight : weights) {
    weight = uniform(random) < empty_share ? 0.0 : std::pow(uniform(random), 4.0);
  }
  return weights;
}

TEST_CASE("make_light_clusters: every texel with weight lies in one cluster, with its share") {
  for (const auto& [width, height] :
       {std::pair(64, 32), std::pair(37, 19), std::pair(1, 1), std::pair(5, 100)}) {
    const std::vector<double> weights = random_weights(width, height, 0.4);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const LightClusters light = make_light_clusters(width, height, weights, 50);
    INFO(width, " x ", height);
    if (total == 0.0) {
      CHECK(light.clusters.empty());
      continue;
    }
    CHECK(light.clusters.size() <= 53);
    std::vector<int> seen(weights.size(), 0);
    double shares = 0.0;
    for (std::size_t k = 0; k < light.clusters.size(); ++k) {
      const LightCluster& cluster = light.clusters[k];
      double weight = 0.0;
      for (std::size_t i = cluster.first; i < cluster.last; ++i) {
        const std::uint32_t texel = light.order[i];
        ++seen[texel];
        weight += weights[texel];
        CHECK(light.cluster_of[texel] == k);
      }
      CHECK(cluster.share == doctest::Approx(weight / total).epsilon(1e-9));
      CHECK(glm::length(cluster.direction) == doctest::Approx(1.0).epsilon(1e-12));
      shares += cluster.share;
    }
    CHECK(shares == doctest::Approx(1.0).epsilon(1e-12));
    for (std::size_t i = 0; i < weights.size(); ++i) CHECK(seen[i] == (weights[i] > 0.0 ? 1 : 0));
  }
}

TEST_CASE("make_light_clusters: no weight, no clusters") {
  CHECK(make_light_clusters(8, 4, std::vector<double>(32, 0.0), 10).clusters.empty());
}

TEST_CASE("make_light_clusters: a sun gets a cluster of its own") {
  std::vector<double> weights(64 * 32, 1.0);
  const std::uint32_t sun = 11 * 64 + 40;
  weights[sun] = 1e6;
  const LightClusters light = make_light_clusters(64, 32, weights, 30);
  const LightCluster& cluster = light.clusters[light.cluster_of[sun]];
  CHECK(cluster.last - cluster.first == 1);
  const glm::dvec3 expected = panorama_direction({40.5 / 64, 11.5 / 32});
  CHECK(glm::length(cluster.direction - expected) < 1e-12);
}

TEST_CASE("make_light_clusters: with enough of them, every texel has its own") {
  const LightClusters light = make_light_clusters(16, 8, std::vector<double>(128, 1.0), 1000);
  CHECK(light.clusters.size() == 128);
}

TEST_CASE("LightClusters::choose: shares within a cluster, and what is left is uniform") {
  const std::vector<double> weights = {1.0, 3.0, 0.0, 4.0};
  const LightClusters light = make_light_clusters(2, 2, weights, 1);
  REQUIRE(light.clusters.size() == 1);
  std::vector<int> counts(4, 0);
  std::vector<double> rests(4, 0.0);
  constexpr int kSteps = 8000;
  for (int i = 0; i < kSteps; ++i) {
    double u = (i + 0.5) / kSteps;
    const std::size_t texel = light.order[light.choose(light.clusters[0], u)];
    CHECK(u >= 0.0);
    CHECK(u < 1.0);
    ++counts[texel];
    rests[texel] += u;
  }
  CHECK(counts == std::vector<int>{1000, 3000, 0, 4000});
  for (const std::size_t texel : {0u, 1u, 3u}) {
    CHECK(rests[texel] / counts[texel] == doctest::Approx(0.5).epsilon(1e-6));
  }
}

}  // namespace
}  // namespace lobelight
