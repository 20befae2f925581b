#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <stdexcept>

#include "base/pi.h"
#include "reference/environment_distribution.h"

namespace lobelight {
namespace {

constexpr int kWidth = 24;
constexpr int kHeight = 12;

Panorama random_panorama() {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> uniform;
  Panorama panorama{kWidth, kHeight, {}};
  for (int i = 0; i < kWidth * kHeight * 3; ++i) {
    panorama.rgb.push_back(std::pow(uniform(random), 6.0f));
  }
  // Suns at a pole, on the seam and in the middle.
  for (const int texel : {5, 6 * kWidth, 4 * kWidth + 9}) {
    for (int c = 0; c < 3; ++c) panorama.rgb[static_cast<std::size_t>(3 * texel + c)] = 40.0f;
  }
  return panorama;
}

// Importances that vary from cluster to cluster; some clusters get none.
std::vector<double> uneven(std::size_t count) {
  std::vector<double> importance(count);
  for (std::size_t k = 0; k < count; ++k) {
    importance[k] = k % 5 == 0 ? 0.0 : 1.0 + std::sin(static_cast<double>(k));
  }
  return importance;
}

// ∫ pdf dω over a box of (u, v) by the midpoint rule, dω = 2π² sin θ du dv.
double probability(const EnvironmentDistribution& environment, const ClusterChoice& choice,
                   double u0, double u1, double v0, double v1, int steps) {
  double sum = 0.0;
  for (int j = 0; j < steps; ++j) {
    for (int i = 0; i < steps; ++i) {
      const double u = u0 + (u1 - u0) * (i + 0.5) / steps;
      const double v = v0 + (v1 - v0) * (j + 0.5) / steps;
      sum += environment.at(choice, panorama_direction({u, v})).pdf * std::sin(kPi * v);
    }
  }
  return sum * (u1 - u0) * (v1 - v0) / (steps * steps) * 2.0 * kPi * kPi;
}

TEST_CASE("EnvironmentDistribution: radiance is the panorama's") {
  const Panorama panorama = random_panorama();
  const EnvironmentDistribution environment(panorama);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 direction = panorama_direction({uniform(random), uniform(random)});
    const glm::dvec3 expected = panorama.sample(direction);
    CHECK(glm::length(environment.at({}, direction).radiance - expected) <=
          1e-12 * (1.0 + glm::length(expected)));
    CHECK(environment.at({}, direction).pdf == 0.0);
  }
}

TEST_CASE("EnvironmentDistribution: the density integrates to 1 and samples follow it (chi²)") {
  const EnvironmentDistribution environment(random_panorama());
  const std::size_t count = environment.clusters().size();
  REQUIRE(count > 50);
  for (const auto& importance : {std::vector<double>(count, 1.0), uneven(count)}) {
    const ClusterChoice choice = environment.choose_by(importance);
    REQUIRE(!choice.empty());
    CHECK(probability(environment, choice, 0, 1, 0, 1, 480) == doctest::Approx(1.0).epsilon(1e-4));

    constexpr int kColumns = 16;
    constexpr int kRows = 8;
    constexpr int kSamples = 200000;
    std::vector<int> counts(kColumns * kRows, 0);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < kSamples; ++i) {
      const EnvironmentSample sample =
          environment.sample(choice, {uniform(random), uniform(random)});
      const glm::dvec2 position = panorama_position(sample.direction);
      const int column = static_cast<int>(position.x * kColumns);
      const int row = std::min(static_cast<int>(position.y * kRows), kRows - 1);
      ++counts[static_cast<std::size_t>(row * kColumns + column)];
    }
    double chi2 = 0.0;
    int cells = 0;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        const double expected =
            kSamples * probability(environment, choice, 1.0 * column / kColumns,
                                   1.0 * (column + 1) / kColumns, 1.0 * row / kRows,
                                   1.0 * (row + 1) / kRows, 60);
        const int got = counts[static_cast<std::size_t>(row * kColumns + column)];
        if (expected < 5.0) {
          CHECK(got < 30);
          continue;
        }
        chi2 += (got - expected) * (got - expected) / expected;
        ++cells;
      }
    }
    // Mean `cells`, standard deviation √(2 cells): 5 sigma.
    INFO("chi² ", chi2, " of ", cells, " cells");
    CHECK(chi2 < cells + 5.0 * std::sqrt(2.0 * cells));
  }
}

TEST_CASE("EnvironmentDistribution: sample() and at() agree") {
  const EnvironmentDistribution environment(random_panorama());
  const ClusterChoice choice = environment.choose_by(uneven(environment.clusters().size()));
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 5000; ++i) {
    const EnvironmentSample drawn = environment.sample(choice, {uniform(random), uniform(random)});
    const EnvironmentSample found = environment.at(choice, drawn.direction);
    CHECK(drawn.pdf > 0.0);
    CHECK(glm::length(drawn.direction) == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(found.pdf == doctest::Approx(drawn.pdf).epsilon(1e-6));
    CHECK(glm::length(found.radiance - drawn.radiance) <=
          1e-6 * (1.0 + glm::length(drawn.radiance)));
  }
}

TEST_CASE("EnvironmentDistribution: the density reaches as far as a bright texel does") {
  Panorama panorama{16, 8, std::vector<float>(16 * 8 * 3, 0.0f)};
  panorama.rgb[3 * (3 * 16 + 4)] = 100.0f;
  const EnvironmentDistribution environment(panorama);
  REQUIRE(environment.clusters().size() == 1);
  const ClusterChoice choice = environment.choose_by({1.0});
  for (const double du : {-0.95, 0.0, 0.95}) {
    for (const double dv : {-0.95, 0.0, 0.95}) {
      CHECK(environment.at(choice, panorama_direction({(4.5 + du) / 16, (3.5 + dv) / 8})).pdf > 0);
    }
  }
  CHECK(environment.at(choice, panorama_direction({(4.5 + 1.05) / 16, 3.5 / 8})).pdf == 0.0);
}

TEST_CASE("EnvironmentDistribution: a constant panorama has no density") {
  for (const float value : {0.0f, 0.3f, 1.0f, 1e30f}) {
    const EnvironmentDistribution environment({5, 3, std::vector<float>(45, value)});
    CHECK(environment.clusters().empty());
    CHECK(environment.choose_by({}).empty());
  }
}

TEST_CASE("EnvironmentDistribution: no importance, no choice") {
  const EnvironmentDistribution environment(random_panorama());
  const std::size_t count = environment.clusters().size();
  CHECK(environment.choose_by(std::vector<double>(count, 0.0)).empty());
}

TEST_CASE("EnvironmentDistribution: values that are no light count as 0") {
  Panorama panorama{4, 2, std::vector<float>(24, 1.0f)};
  panorama.rgb[0] = std::numeric_limits<float>::quiet_NaN();
  panorama.rgb[4] = std::numeric_limits<float>::infinity();
  panorama.rgb[8] = -3.0f;
  const EnvironmentDistribution environment(panorama);
  const glm::dvec3 radiance = environment.at({}, panorama_direction({0.5 / 4, 0.5 / 2})).radiance;
  CHECK(glm::length(radiance - glm::dvec3(0, 1, 1)) < 1e-12);
}

TEST_CASE("EnvironmentDistribution: infinite light is the brightest, as readers have it") {
  Panorama panorama = random_panorama();
  panorama.rgb[30] = std::numeric_limits<float>::infinity();
  Panorama clean = panorama;
  clean.sanitise();
  const EnvironmentDistribution environment(panorama);
  const EnvironmentDistribution expected(clean);
  REQUIRE(environment.clusters().size() == expected.clusters().size());
  const glm::dvec3 there = panorama_direction({10.5 / panorama.width, 0.5 / panorama.height});
  CHECK(environment.at({}, there).radiance == expected.at({}, there).radiance);
  CHECK(environment.at({}, there).radiance.r > 6e4);
}

TEST_CASE("EnvironmentDistribution: panoramas that do not fit together are refused") {
  CHECK_THROWS_AS(EnvironmentDistribution({0, 0, {}}), std::invalid_argument);
  CHECK_THROWS_AS(EnvironmentDistribution({2, 2, {1.0f}}), std::invalid_argument);
}

}  // namespace
}  // namespace lobelight
