#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "base/simd.h"
#include "fit/slice.h"
#include "sg/mixture.h"

namespace lobelight {

// A slice's nodes in blocks of arrays, for em_pass(): weights sum to 1, and the last block is
// filled up with nodes of weight 0.
class EmNodes {
 public:
  static constexpr std::size_t kBlockSize = 64;
  struct alignas(64) Block {
    std::array<double, kBlockSize> x, y, z, weight;
  };

  // A slice that has mass and is_usable().
  explicit EmNodes(const Slice& slice);

  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  std::vector<Block> blocks_;
};

// The moments of a lobe's share γ of the nodes' mass. They are taken about the lobe's mean μ, so
// that nothing cancels in narrow lobes.
struct EmMoments {
  double weight = 0.0;    // Σ γ
  glm::dvec3 shift{0.0};  // Σ γ (x − μ)
  double spread = 0.0;    // Σ γ |x − μ|²
};

// Working memory of em_pass(); keep it from call to call.
class EmWorkspace {
 public:
  using Column = std::array<double, EmNodes::kBlockSize>;
  // Sums are kept in this many lanes, whatever the width of the processor's registers, and the
  // lanes are added in a fixed order: results are the same on all processors.
  static constexpr std::size_t kLanes = 8;
  using Lanes = std::array<double, kLanes>;

  struct alignas(64) PerLobe {
    Column distance;  // |x − μ|² of the block's nodes
    Column term;      // share of the node's density, relative to the largest
    std::array<Lanes, 5> sums;
    // log2 of the lobe's share of the density is constant + factor · |x − μ|².
    double mean_x, mean_y, mean_z, factor, constant;
  };

  std::vector<PerLobe> lobes;
};

// One pass over the nodes: the expectation step for `mixture` (weights sum to 1) and the moments
// that the maximisation step needs, one for each lobe. Returns the log-likelihood
// Σ_n w_n ln Σ_k π_k g(x_n; μ_k, κ_k) in nats.
double em_pass(const EmNodes& nodes, const Mixture& mixture, std::vector<EmMoments>& moments,
               EmWorkspace& workspace, Simd simd = widest_simd());

}  // namespace lobelight
