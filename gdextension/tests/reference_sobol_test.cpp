#include <doctest/doctest.h>

#include <set>
#include <stdexcept>

#include "reference/sobol.h"

namespace lobelight {
namespace {

// Whether every box of size 2^−a × 2^−(m−a) holds exactly one of the 2^m points.
bool is_net(const SobolPoints& points, int m, std::uint64_t seed) {
  const std::size_t count = std::size_t{1} << m;
  for (int a = 0; a <= m; ++a) {
    const double wide = static_cast<double>(std::size_t{1} << a);
    const double tall = static_cast<double>(std::size_t{1} << (m - a));
    std::set<std::size_t> boxes;
    for (std::size_t k = 0; k < count; ++k) {
      const glm::dvec2 p = points.scrambled(k, seed);
      if (!(p.x >= 0.0 && p.x < 1.0 && p.y >= 0.0 && p.y < 1.0)) return false;
      boxes.insert(static_cast<std::size_t>(p.x * wide) * count +
                   static_cast<std::size_t>(p.y * tall));
    }
    if (boxes.size() != count) return false;
  }
  return true;
}

TEST_CASE("SobolPoints: every scramble is a (0, m, 2)-net") {
  for (const int m : {0, 1, 2, 5, 8, 10}) {
    const SobolPoints points(std::size_t{1} << m);
    for (const std::uint64_t seed : {0u, 1u, 77u}) {
      INFO("m ", m, " seed ", seed);
      CHECK(is_net(points, m, mix_bits(seed)));
    }
  }
}

TEST_CASE("SobolPoints: scrambles differ, equal seeds agree") {
  const SobolPoints points(256);
  int same = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    CHECK(points.scrambled(k, 5) == points.scrambled(k, 5));
    same += points.scrambled(k, mix_bits(5)) == points.scrambled(k, mix_bits(6)) ? 1 : 0;
  }
  CHECK(same == 0);
}

TEST_CASE("SobolPoints: over many scrambles a point is uniform") {
  const SobolPoints points(8);
  constexpr int kScrambles = 20000;
  // Standard deviation of the mean of uniform numbers: 1/√12/√n = 0.002; of their squares, 0.0021.
  for (const std::size_t k : {0u, 3u, 7u}) {
    glm::dvec2 sum(0.0);
    glm::dvec2 squares(0.0);
    for (std::uint64_t seed = 0; seed < kScrambles; ++seed) {
      const glm::dvec2 p = points.scrambled(k, mix_bits(seed));
      sum += p;
      squares += p * p;
    }
    for (int axis = 0; axis < 2; ++axis) {
      CHECK(sum[axis] / kScrambles == doctest::Approx(1.0 / 2).epsilon(0.02));
      CHECK(squares[axis] / kScrambles == doctest::Approx(1.0 / 3).epsilon(0.03));
    }
  }
}

TEST_CASE("SobolPoints: counts out of range are refused") {
  CHECK_THROWS_AS(SobolPoints(0), std::invalid_argument);
}

}  // namespace
}  // namespace lobelight
