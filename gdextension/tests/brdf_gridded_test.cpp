#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "brdf/gridded.h"
#include "statistics.h"

namespace lobelight {
namespace {

constexpr GridSize kSize{5, 4};

std::vector<float> random_values(std::size_t count, std::uint64_t seed) {
  testing::Uniform uniform(seed);
  std::vector<float> values(count);
  for (float& value : values) value = static_cast<float>(uniform.next());
  return values;
}

TEST_CASE("A gridded function is bilinear between its values") {
  const std::vector<float> values = random_values(2 * kSize.values(), 1);
  const GriddedFunction function(kSize, values);
  const auto at = [&](std::size_t slice, std::size_t row, std::size_t column) {
    return static_cast<double>(values[(slice * 4 + row) * 5 + column]);
  };
  CHECK(function.value({0.0, 0.0}, 1) == at(1, 0, 0));
  CHECK(function.value({1.0, 1.0}, 1) == at(1, 3, 4));
  CHECK(function.value({0.25, 1.0 / 3.0}, 0) == doctest::Approx(at(0, 1, 1)));
  CHECK(function.value({0.375, 0.5}, 0) ==
        doctest::Approx(0.25 * (at(0, 1, 1) + at(0, 1, 2) + at(0, 2, 1) + at(0, 2, 2))));
  CHECK(function.value({-3.0, 7.0}, 0) == at(0, 3, 0));
  CHECK(function.value({std::nan(""), 0.0}, 0) == at(0, 0, 0));
}

TEST_CASE("Parameters between nodes blend their slices, parameters beyond are clamped") {
  const ParameterGrid grid({0.0, 1.0, 3.0}, {-1.0, 1.0});
  CHECK(grid.slices() == 6);
  const Blend inner = grid.locate(2.5, -0.5);
  CHECK(inner.slice == std::array<std::size_t, 4>{2, 3, 4, 5});
  CHECK(inner.share[0] == doctest::Approx(0.25 * 0.75));
  CHECK(inner.share[1] == doctest::Approx(0.25 * 0.25));
  CHECK(inner.share[2] == doctest::Approx(0.75 * 0.75));
  CHECK(inner.share[3] == doctest::Approx(0.75 * 0.25));
  const Blend outer = grid.locate(99.0, -99.0);
  CHECK(outer.slice[0] == 4);
  CHECK(outer.share[0] == 1.0);
  CHECK(ParameterGrid({5.0}, {5.0}).locate(0.0, 9.0).share[0] == 1.0);
  CHECK_THROWS_AS(ParameterGrid({}, {0.0}), std::invalid_argument);
  CHECK_THROWS_AS(ParameterGrid({0.0, 0.0}, {0.0}), std::invalid_argument);
  CHECK_THROWS_AS(ParameterGrid({0.0}, {1.0, std::nan("")}), std::invalid_argument);
}

TEST_CASE("Blended densities integrate to 1 and agree with their marginal") {
  const ParameterGrid grid({0.0, 1.0}, {0.0, 1.0});
  const GriddedDistribution distribution(kSize, random_values(4 * kSize.values(), 2));
  const Blend blend = grid.locate(0.3, 0.8);
  constexpr int kCells = 300;
  double mass = 0.0;
  for (int r = 0; r < kCells; ++r) {
    for (int c = 0; c < kCells; ++c) {
      mass += distribution.density({(c + 0.5) / kCells, (r + 0.5) / kCells}, blend);
    }
    CHECK(distribution.marginal_cdf((r + 1.0) / kCells, blend) ==
          doctest::Approx(mass / (kCells * kCells)).epsilon(1e-4));
  }
  CHECK(mass / (kCells * kCells) == doctest::Approx(1.0).epsilon(1e-4));
}

TEST_CASE("Sampling and inversion undo each other to rounding") {
  const ParameterGrid grid({0.0, 1.0}, {0.0, 1.0});
  std::vector<float> values = random_values(4 * kSize.values(), 3);
  // Cells whose density falls to 0 at one side or altogether.
  for (const std::size_t n : {0, 1, 2, 7, 20, 25, 59, 60, 61, 65}) values[n] = 0.0F;
  const GriddedDistribution distribution(kSize, values);
  testing::Uniform uniform(4);
  double worst = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const glm::dvec2 u = uniform.next2();
    const Blend blend = grid.locate(uniform.next(), n % 3 == 0 ? 0.0 : uniform.next());
    const glm::dvec2 point = distribution.sample(u, blend);
    CHECK(distribution.density(point, blend) > 0.0);
    const glm::dvec2 back = distribution.invert(point, blend);
    worst = std::max({worst, std::abs(back.x - u.x), std::abs(back.y - u.y)});
  }
  CHECK(worst < 1e-12);
}

TEST_CASE("Samples are distributed as the density says") {
  const ParameterGrid grid({0.0, 1.0}, {0.0, 1.0});
  const GriddedDistribution distribution(kSize, random_values(4 * kSize.values(), 5));
  const Blend blend = grid.locate(0.6, 0.1);
  constexpr int kBins = 8;
  constexpr int kSamples = 100000;
  std::vector<int> counts(kBins * kBins, 0);
  testing::Uniform uniform(6);
  for (int n = 0; n < kSamples; ++n) {
    const glm::dvec2 point = distribution.sample(uniform.next2(), blend);
    ++counts[static_cast<std::size_t>(point.y * kBins) * kBins +
             static_cast<std::size_t>(point.x * kBins)];
  }
  double statistic = 0.0;
  for (int bin = 0; bin < kBins * kBins; ++bin) {
    constexpr int kCells = 32;
    double expected = 0.0;
    for (int cell = 0; cell < kCells * kCells; ++cell) {
      const double x = (bin % kBins + (cell % kCells + 0.5) / kCells) / kBins;
      const double y = (bin / kBins + (cell / kCells + 0.5) / kCells) / kBins;
      expected += distribution.density({x, y}, blend);
    }
    expected *= static_cast<double>(kSamples) / (kCells * kCells * kBins * kBins);
    const double difference = counts[static_cast<std::size_t>(bin)] - expected;
    statistic += difference * difference / expected;
  }
  CHECK(testing::chi_square_tail(statistic, kBins * kBins - 1) > testing::significance(1));
}

TEST_CASE("A slice of zeros is the uniform density; wrong sizes are refused") {
  const GriddedDistribution distribution(kSize, std::vector<float>(kSize.values(), 0.0F));
  const Blend only = ParameterGrid({0.0}, {0.0}).locate(0.0, 0.0);
  CHECK(distribution.density({0.3, 0.9}, only) == doctest::Approx(1.0));
  CHECK(distribution.sample({0.3, 0.9}, only).x == doctest::Approx(0.3));
  CHECK_THROWS_AS(GriddedFunction({1, 4}, std::vector<float>(4)), std::invalid_argument);
  CHECK_THROWS_AS(GriddedFunction({2, 2}, std::vector<float>(5)), std::invalid_argument);
  CHECK_THROWS_AS(GriddedDistribution({2, 2}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace lobelight
