#include "fit/em_pass.h"

#include <cmath>

#include "base/pack.h"

namespace lobelight {

namespace {

constexpr double kLn2 = detail::kLn2;

// Terms smaller than 2 to this power, relative to the largest, count as this small. 2^−720 = 2e-217
// is far below the last bit of any sum here, and far above the subnormal numbers, which are slow.
constexpr double kLeastExponent = -720.0;

constexpr std::size_t kBlockSize = EmNodes::kBlockSize;
constexpr std::size_t kLanes = EmWorkspace::kLanes;
using Column = EmWorkspace::Column;
using Lanes = EmWorkspace::Lanes;

double total(const Lanes& v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

// One block: adds to the lobes' sums and to `log_likelihood`, which is in units of ln 2. Width is
// how many doubles a register holds.
template <int Width>
LOBELIGHT_ALWAYS_INLINE void work_on_block(const EmNodes::Block& block, EmWorkspace::PerLobe* lobes,
                                           std::size_t count, Lanes& log_likelihood) {
  using Reals = Pack<Width>;
  constexpr std::size_t kStep = Width;
  constexpr int kAtOnce = 8;  // packs for which the exponential is worked out in turn

  // log2 of π_k g_k(x_n), and the largest of them over k: sums are taken relative to it, so that a
  // node far from every lobe does not underflow to 0/0.
  alignas(64) Column largest;
  largest.fill(-1e300);
  for (std::size_t k = 0; k < count; ++k) {
    EmWorkspace::PerLobe& lobe = lobes[k];
    const double mean_x = lobe.mean_x, mean_y = lobe.mean_y, mean_z = lobe.mean_z;
    const double factor = lobe.factor, constant = lobe.constant;
    for (std::size_t n = 0; n < kBlockSize; n += kStep) {
      const Reals dx = load<Width>(&block.x[n]) - mean_x;
      const Reals dy = load<Width>(&block.y[n]) - mean_y;
      const Reals dz = load<Width>(&block.z[n]) - mean_z;
      const Reals distance = dx * dx + dy * dy + dz * dz;
      const Reals t = distance * factor + constant;
      store<Width>(distance, &lobe.distance[n]);
      store<Width>(t, &lobe.term[n]);
      store<Width>(larger<Width>(t, load<Width>(&largest[n])), &largest[n]);
    }
  }
  alignas(64) Column sum{};
  for (std::size_t k = 0; k < count; ++k) {
    EmWorkspace::PerLobe& lobe = lobes[k];
    for (std::size_t n = 0; n < kBlockSize; n += kAtOnce * kStep) {
      Reals e[kAtOnce];
      for (int i = 0; i < kAtOnce; ++i) {
        const std::size_t at = n + static_cast<std::size_t>(i) * kStep;
        const Reals t = load<Width>(&lobe.term[at]) - load<Width>(&largest[at]);
        e[i] = larger<Width>(Reals{} + kLeastExponent, t);
      }
      exp2_nonpositive<Width, kAtOnce>(e);
      for (int i = 0; i < kAtOnce; ++i) {
        const std::size_t at = n + static_cast<std::size_t>(i) * kStep;
        store<Width>(e[i], &lobe.term[at]);
        store<Width>(load<Width>(&sum[at]) + e[i], &sum[at]);
      }
    }
  }
  alignas(64) Column scale;
  for (std::size_t n = 0; n < kBlockSize; n += kStep) {
    const Reals weight = load<Width>(&block.weight[n]);
    Reals log_sum, reciprocal;
    log2_and_reciprocal<Width>(load<Width>(&sum[n]), log_sum, reciprocal);
    double* lane = &log_likelihood[n % kLanes];
    store<Width>(load<Width>(lane) + weight * (load<Width>(&largest[n]) + log_sum), lane);
    store<Width>(weight * reciprocal, &scale[n]);
  }
  for (std::size_t k = 0; k < count; ++k) {
    EmWorkspace::PerLobe& lobe = lobes[k];
    const double mean_x = lobe.mean_x, mean_y = lobe.mean_y, mean_z = lobe.mean_z;
    for (std::size_t lane = 0; lane < kLanes; lane += kStep) {
      Reals weight = load<Width>(&lobe.sums[0][lane]);
      Reals x = load<Width>(&lobe.sums[1][lane]);
      Reals y = load<Width>(&lobe.sums[2][lane]);
      Reals z = load<Width>(&lobe.sums[3][lane]);
      Reals spread = load<Width>(&lobe.sums[4][lane]);
      for (std::size_t n = lane; n < kBlockSize; n += kLanes) {
        const Reals share = load<Width>(&scale[n]) * load<Width>(&lobe.term[n]);
        weight += share;
        x += share * (load<Width>(&block.x[n]) - mean_x);
        y += share * (load<Width>(&block.y[n]) - mean_y);
        z += share * (load<Width>(&block.z[n]) - mean_z);
        spread += share * load<Width>(&lobe.distance[n]);
      }
      store<Width>(weight, &lobe.sums[0][lane]);
      store<Width>(x, &lobe.sums[1][lane]);
      store<Width>(y, &lobe.sums[2][lane]);
      store<Width>(z, &lobe.sums[3][lane]);
      store<Width>(spread, &lobe.sums[4][lane]);
    }
  }
}

template <int Width>
LOBELIGHT_ALWAYS_INLINE double work_on_all(const EmNodes& nodes, EmWorkspace& workspace) {
  alignas(64) Lanes log_likelihood{};
  for (const EmNodes::Block& block : nodes.blocks()) {
    work_on_block<Width>(block, workspace.lobes.data(), workspace.lobes.size(), log_likelihood);
  }
  return total(log_likelihood);
}

double pass_baseline(const EmNodes& nodes, EmWorkspace& workspace) {
  return work_on_all<2>(nodes, workspace);
}

#if LOBELIGHT_SIMD_VARIANTS
__attribute__((target("avx2"))) double pass_avx2(const EmNodes& nodes, EmWorkspace& workspace) {
  return work_on_all<4>(nodes, workspace);
}

__attribute__((target(LOBELIGHT_AVX512))) double pass_avx512(const EmNodes& nodes,
                                                             EmWorkspace& workspace) {
  return work_on_all<8>(nodes, workspace);
}
#endif

}  // namespace

EmNodes::EmNodes(const Slice& slice) {
  const std::size_t count = slice.weights.size();
  double mass = 0.0;
  for (const double weight : slice.weights) mass += weight;
  blocks_.resize((count + kBlockSize - 1) / kBlockSize);
  for (std::size_t n = 0; n < blocks_.size() * kBlockSize; ++n) {
    Block& block = blocks_[n / kBlockSize];
    const std::size_t at = n % kBlockSize;
    const bool exists = n < count;
    const glm::dvec3 direction = exists ? slice.directions[n] : glm::dvec3(0.0, 0.0, 1.0);
    block.x[at] = direction.x;
    block.y[at] = direction.y;
    block.z[at] = direction.z;
    block.weight[at] = exists ? slice.weights[n] / mass : 0.0;
  }
}

double em_pass(const EmNodes& nodes, const Mixture& mixture, std::vector<EmMoments>& moments,
               EmWorkspace& workspace, Simd simd) {
  workspace.lobes.resize(mixture.size());
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const SphericalGaussian& gaussian = mixture[k].gaussian;
    EmWorkspace::PerLobe& lobe = workspace.lobes[k];
    lobe.mean_x = gaussian.mean.x;
    lobe.mean_y = gaussian.mean.y;
    lobe.mean_z = gaussian.mean.z;
    lobe.factor = -0.5 / kLn2 * gaussian.kappa;
    lobe.constant = (std::log(mixture[k].weight) + log_normalisation(gaussian.kappa)) / kLn2;
    lobe.sums = {};
  }

  double log_likelihood = 0.0;
#if LOBELIGHT_SIMD_VARIANTS
  if (simd == Simd::avx512) {
    log_likelihood = pass_avx512(nodes, workspace);
  } else if (simd == Simd::avx2) {
    log_likelihood = pass_avx2(nodes, workspace);
  } else {
    log_likelihood = pass_baseline(nodes, workspace);
  }
#else
  static_cast<void>(simd);
  log_likelihood = pass_baseline(nodes, workspace);
#endif

  moments.resize(mixture.size());
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const auto& sums = workspace.lobes[k].sums;
    moments[k].weight = total(sums[0]);
    moments[k].shift = {total(sums[1]), total(sums[2]), total(sums[3])};
    moments[k].spread = total(sums[4]);
  }
  return kLn2 * log_likelihood;
}

}  // namespace lobelight
