#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "base/pi.h"
#include "brdf/ggx.h"
#include "fit/channel_weights.h"
#include "fit/em.h"
#include "fit/initial_guess.h"
#include "statistics.h"

namespace lobelight {
namespace {

// Nodes of equal solid angle over the whole sphere, weighted by three mixtures of the same lobes.
struct Coloured {
  Slice slice;
  std::vector<glm::dvec3> node_weights;
};

Coloured coloured(const Mixture& lobes, const std::vector<glm::dvec3>& weights) {
  constexpr int kRows = 120;
  Coloured result;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < 2 * kRows; ++column) {
      const double z = (row + 0.5) / kRows * 2.0 - 1.0;
      const double phi = (column + 0.5) / kRows * kPi;
      const double s = std::sqrt(1.0 - z * z);
      const glm::dvec3 d(s * std::cos(phi), s * std::sin(phi), z);
      glm::dvec3 value(0.0);
      for (std::size_t k = 0; k < lobes.size(); ++k) {
        value += weights[k] * density(lobes[k].gaussian, d);
      }
      value *= 2.0 * kPi / (kRows * kRows);
      result.slice.directions.push_back(d);
      result.slice.weights.push_back((value.x + value.y + value.z) / 3.0);
      result.slice.albedo += result.slice.weights.back();
      result.node_weights.push_back(value);
    }
  }
  return result;
}

// Far from the poles, around which the nodes are coarse.
const Mixture kLobes = {
    {0.2, {glm::normalize(glm::dvec3(1.0, 0.0, 0.1)), 100.0}},
    {0.5, {glm::normalize(glm::dvec3(1.0, 0.2, 0.3)), 40.0}},
    {0.3, {glm::normalize(glm::dvec3(1.0, 0.1, -0.4)), 8.0}},
};

TEST_CASE("The weights that coloured nodes were made with are found") {
  const std::vector<glm::dvec3> weights = {{0.3, 0.3, 0.3}, {0.5, 0.1, 0.0}, {0.0, 0.2, 0.9}};
  const Coloured made = coloured(kLobes, weights);
  const auto found = channel_weights(made.slice, made.node_weights, kLobes, 2000);
  REQUIRE(found.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    for (int channel = 0; channel < 3; ++channel) {
      CAPTURE(k);
      CAPTURE(channel);
      CHECK(std::abs(found[k][channel] - weights[k][channel]) < 1e-3);
    }
  }
}

TEST_CASE("Each channel keeps its energy, also after one step") {
  const Coloured made = coloured(kLobes, {{0.7, 0.2, 0.0}, {0.1, 0.1, 0.0}, {0.4, 0.9, 0.0}});
  glm::dvec3 albedo(0.0);
  for (const glm::dvec3& weight : made.node_weights) albedo += weight;
  for (const int iterations : {1, 7, 100}) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& weight :
         channel_weights(made.slice, made.node_weights, kLobes, iterations)) {
      CHECK(glm::all(glm::greaterThanEqual(weight, glm::dvec3(0.0))));
      sum += weight;
    }
    CHECK(sum.x == doctest::Approx(albedo.x).epsilon(1e-12));
    CHECK(sum.y == doctest::Approx(albedo.y).epsilon(1e-12));
    CHECK(sum.z == 0.0);
  }
}

TEST_CASE("Grey nodes give grey weights, those of a converged fit again") {
  const Ggx brdf({0.2, 0.2});
  const glm::dvec3 o(0.6, 0.0, 0.8);
  const Slice slice = sample_slice(brdf, o, 32);
  EmOptions options;
  options.max_iterations = 3000;
  options.tolerance = 1e-11;
  const EmResult fit = run_em(slice, initial_guess(slice, 4), options);
  const auto found = channel_weights(slice, channel_node_weights(brdf, o, slice), fit.mixture);
  for (std::size_t k = 0; k < found.size(); ++k) {
    CHECK(found[k].x == found[k].y);
    CHECK(found[k].y == found[k].z);
    CHECK(found[k].x == doctest::Approx(fit.mixture[k].weight).epsilon(1e-3));
  }
}

TEST_CASE("Lobes far from every node and lobes without weight stay finite") {
  const Coloured made = coloured(kLobes, {{0.3, 0.3, 0.3}, {0.5, 0.1, 0.0}, {0.0, 0.2, 0.9}});
  const Mixture strange = {
      {0.0, {{0.0, 0.0, -1.0}, 1e8}}, {0.0, {{1.0, 0.0, 0.0}, 1e8}}, {1.0, {{0.0, 0.0, 1.0}, 0.0}}};
  for (const glm::dvec3& weight : channel_weights(made.slice, made.node_weights, strange)) {
    for (int channel = 0; channel < 3; ++channel) {
      CHECK(std::isfinite(weight[channel]));
      CHECK(weight[channel] >= 0.0);
    }
  }
  const std::vector<glm::dvec3> dark(made.node_weights.size(), glm::dvec3(0.0));
  for (const glm::dvec3& weight : channel_weights(made.slice, dark, kLobes)) {
    CHECK(weight == glm::dvec3(0.0));
  }
}

TEST_CASE("Channels that share no lobe keep all of their light") {
  // Neither lobe's density is a number at the other's node.
  const std::vector<glm::dvec3> nodes = {{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  for (const double far : {-1000.0, -std::numeric_limits<double>::infinity()}) {
    const auto found = channel_weights(nodes, {0.0, far, far, 0.0}, {0.5, 0.5});
    CHECK(found[0] == glm::dvec3(1.0, 0.0, 0.0));
    CHECK(found[1] == glm::dvec3(0.0, 0.0, 1.0));
  }
  // A node that no lobe reaches, and one whose light is next to none.
  const double nowhere = -std::numeric_limits<double>::infinity();
  const auto found = channel_weights({{1.0, 0.0, 1.0}, {1.0, 1e-310, 1.0}, {1e-310, 1.0, 0.0}},
                                     {0.0, nowhere, 0.0, -1000.0, nowhere, -2000.0}, {1.0, 0.0});
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& weight : found) {
    for (int channel = 0; channel < 3; ++channel) {
      CHECK(std::isfinite(weight[channel]));
      CHECK(weight[channel] >= 0.0);
    }
    sum += weight;
  }
  CHECK(sum.x == doctest::Approx(2.0));
  CHECK(sum.y == doctest::Approx(1.0));
  CHECK(sum.z == doctest::Approx(2.0));
}

}  // namespace
}  // namespace lobelight
