#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/progress.h"

namespace lobelight {

// The first points of Sobol's (0,2)-sequence in base 2, with a nested uniform scramble applied on
// look-up: every scramble of the set is a (0, m, 2)-net again, and averages over scrambles are
// unbiased.
class SobolPoints {
 public:
  // `count`: 1 to 2^31 points. Throws Cancelled when `progress`, which may be null, is cancelled.
  explicit SobolPoints(std::size_t count, const Progress* progress = nullptr);

  std::size_t size() const { return points_.size(); }

  // Point `index` in [0, 1)², scrambled by `seed`.
  glm::dvec2 scrambled(std::size_t index, std::uint64_t seed) const;

 private:
  std::vector<glm::uvec2> points_;  // 32-bit fractions, their bits reversed for the scramble.
};

// Mixes a 64-bit number so that neighbouring inputs give unrelated outputs.
std::uint64_t mix_bits(std::uint64_t value);

}  // namespace lobelight
