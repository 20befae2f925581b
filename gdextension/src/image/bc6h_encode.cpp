#include "image/bc6h_encode.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/parallel.h"
#include "table/half_float.h"

namespace lobelight {

namespace {

constexpr int kTexels = kBlockTexels;
// Of the largest finite half float.
constexpr int kLargestBits = 0x7bff;
// Bits of half floats from those of unquantised channels: 31 / 64.
constexpr double kUnquantisedPerBit = 64.0 / 31.0;
// What the error of a block's mean counts more than that of a texel.
constexpr double kMeanWeight = 8.0;
// Errors weigh less in bright texels, but never more than in texels of this share of the mean.
constexpr double kDarkest = 0.05;
// Two subsets are tried where one leaves more than this of relative error.
constexpr double kGoodEnough = 1e-3;
constexpr int kTriedPartitions = 4;
constexpr int kRounds = 3;

// The values of half floats by their bits.
const std::vector<float>& half_values() {
  static const std::vector<float> values = [] {
    std::vector<float> made(kLargestBits + 1);
    for (std::size_t bits = 0; bits < made.size(); ++bits) {
      made[bits] = static_cast<float>(double_from_half(static_cast<std::uint16_t>(bits)));
    }
    return made;
  }();
  return values;
}

// What is to be encoded.
struct Target {
  double bits[kTexels][3];   // of half floats
  double light[kTexels][3];  // relative to the block's mean
  double slope[kTexels][3];  // of light by bits
  double weight[kTexels];    // of a texel's squared error
  float unit;                // what light is relative to
};

Target make_target(const std::array<std::uint16_t, 3 * kTexels>& halves) {
  const std::vector<float>& values = half_values();
  Target target{};
  double sum = 0.0;
  for (const std::uint16_t half : halves) sum += static_cast<double>(values[half]);
  target.unit = static_cast<float>(std::max(sum / (3.0 * kTexels), 1e-7));
  for (int t = 0; t < kTexels; ++t) {
    for (int c = 0; c < 3; ++c) {
      const int bits = halves[static_cast<std::size_t>(3 * t + c)];
      const int next = std::min(bits + 16, kLargestBits), before = std::max(bits - 16, 0);
      const double unit = static_cast<double>(target.unit);
      target.bits[t][c] = bits;
      target.light[t][c] = static_cast<double>(values[static_cast<std::size_t>(bits)]) / unit;
      target.weight[t] += target.light[t][c] / 3.0;
      target.slope[t][c] = static_cast<double>(values[static_cast<std::size_t>(next)] -
                                               values[static_cast<std::size_t>(before)]) /
                           (unit * (next - before));
    }
  }
  for (double& weight : target.weight) weight = 1.0 / (weight + kDarkest);
  return target;
}

// A line between two colours, in bits of half floats.
struct Line {
  double ends[2][3];
};

// The line that is nearest to some of the texels, by how steep light is there; and the squared
// error that it leaves.
Line fit_line(const Target& target, std::uint32_t members, double& residual) {
  double weights[kTexels] = {}, mean[3] = {}, mass = 0.0;
  for (int t = 0; t < kTexels; ++t) {
    if ((members >> t & 1) == 0) continue;
    const double slope = target.slope[t][0] + target.slope[t][1] + target.slope[t][2];
    weights[t] = target.weight[t] * slope * slope + 1e-30;
    mass += weights[t];
    for (int c = 0; c < 3; ++c) mean[c] += weights[t] * target.bits[t][c];
  }
  for (double& m : mean) m /= mass;
  double covariance[3][3] = {};
  for (int t = 0; t < kTexels; ++t) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        covariance[i][j] +=
            weights[t] * (target.bits[t][i] - mean[i]) * (target.bits[t][j] - mean[j]);
      }
    }
  }
  // The axis of the largest variance, by powers of the matrix.
  double axis[3] = {1.0, 1.0, 1.0};
  double length = 0.0;
  for (int step = 0; step < 8; ++step) {
    double next[3];
    for (int i = 0; i < 3; ++i) {
      next[i] =
          covariance[i][0] * axis[0] + covariance[i][1] * axis[1] + covariance[i][2] * axis[2];
    }
    length = std::sqrt(next[0] * next[0] + next[1] * next[1] + next[2] * next[2]);
    if (!(length > 1e-30)) break;
    for (int i = 0; i < 3; ++i) axis[i] = next[i] / length;
  }
  if (!(length > 1e-30)) {
    axis[0] = axis[1] = axis[2] = std::sqrt(1.0 / 3.0);
    length = 0.0;
  }
  residual = std::max(covariance[0][0] + covariance[1][1] + covariance[2][2] - length, 0.0) / 9.0;
  double least = std::numeric_limits<double>::max(), most = -least;
  for (int t = 0; t < kTexels; ++t) {
    if (weights[t] == 0.0) continue;
    double along = 0.0;
    for (int c = 0; c < 3; ++c) along += axis[c] * (target.bits[t][c] - mean[c]);
    least = std::min(least, along);
    most = std::max(most, along);
  }
  Line line{};
  for (int c = 0; c < 3; ++c) {
    line.ends[0][c] = std::clamp(mean[c] + least * axis[c], 0.0, double{kLargestBits});
    line.ends[1][c] = std::clamp(mean[c] + most * axis[c], 0.0, double{kLargestBits});
  }
  return line;
}

// A block in the making: the lines of its subsets and its indices, in a mode.
class Fit {
 public:
  Fit(const Target& target, int mode, int partition, const Line* lines)
      : target_(target), mode_(bc6h_mode(mode)) {
    block_.mode = mode;
    block_.partition = partition;
    for (int s = 0; s < mode_.subsets; ++s) lines_[s] = lines[s];
    orient();
    best_.mode = mode;
    best_.partition = partition;
    for (int round = 0; round < kRounds; ++round) {
      quantise();
      choose_indices();
      const double error = measure();
      if (error < error_) {
        error_ = error;
        best_ = block_;
      } else if (round > 0) {
        break;
      }
      if (round + 1 < kRounds) improve_lines();
    }
  }

  double error() const { return error_; }
  const Bc6hBlock& block() const { return best_; }

 private:
  int subset_of(int texel) const {
    return mode_.subsets == 2 ? bc6h_subset(block_.partition, texel) : 0;
  }

  // Turns lines round whose anchor is nearer to the second colour.
  void orient() {
    for (int s = 0; s < mode_.subsets; ++s) {
      const int anchor = s == 0 ? 0 : bc6h_anchor(block_.partition);
      double near[2] = {};
      for (int e = 0; e < 2; ++e) {
        for (int c = 0; c < 3; ++c) {
          const double off =
              target_.slope[anchor][c] * (target_.bits[anchor][c] - lines_[s].ends[e][c]);
          near[e] += off * off;
        }
      }
      if (near[1] < near[0]) std::swap(lines_[s].ends[0], lines_[s].ends[1]);
    }
  }

  // The colours of the mode that are nearest to the lines' ends, and what they stand for.
  void quantise() {
    const int largest = (1 << mode_.precision) - 1;
    for (int c = 0; c < 3; ++c) {
      for (int colour = 0; colour < 2 * mode_.subsets; ++colour) {
        const double wanted = lines_[colour / 2].ends[colour % 2][c] * kUnquantisedPerBit;
        int value = static_cast<int>(wanted * (largest + 1) / 65536.0);
        value = std::clamp(value, 0, largest);
        // By what they stand for, one more or less may be nearer.
        int nearest = value;
        for (int other = std::max(value - 1, 0); other <= std::min(value + 1, largest); ++other) {
          if (std::abs(bc6h_unquantize(other, mode_.precision) - wanted) <
              std::abs(bc6h_unquantize(nearest, mode_.precision) - wanted)) {
            nearest = other;
          }
        }
        if (mode_.is_delta && colour > 0) {
          const int base = block_.colours[0][c], reach = 1 << (mode_.delta_bits[c] - 1);
          nearest =
              std::clamp(nearest, std::max(base - reach, 0), std::min(base + reach - 1, largest));
        }
        block_.colours[colour][c] = nearest;
        unquantised_[colour][c] = bc6h_unquantize(nearest, mode_.precision);
      }
    }
    const std::vector<float>& values = half_values();
    const int count = 1 << bc6h_index_bits(mode_.subsets);
    for (int s = 0; s < mode_.subsets; ++s) {
      for (int index = 0; index < count; ++index) {
        const int weight = bc6h_weight(mode_.subsets, index);
        for (int c = 0; c < 3; ++c) {
          const int bits = bc6h_between(unquantised_[2 * s][c], unquantised_[2 * s + 1][c], weight);
          palette_[s][index][c] =
              static_cast<double>(values[static_cast<std::size_t>(bits)] / target_.unit);
        }
      }
    }
  }

  // The indices that leave the least error, texel by texel, each in view of what the others leave
  // of the mean.
  void choose_indices() {
    const int count = 1 << bc6h_index_bits(mode_.subsets);
    double off[kTexels][3] = {}, sum[3] = {};
    for (int sweep = 0; sweep < 3; ++sweep) {
      // The first looks at single texels only.
      const double share = sweep == 0 ? 0.0 : kMeanWeight / kTexels;
      for (int t = 0; t < kTexels; ++t) {
        const int s = subset_of(t);
        const bool is_anchor = t == 0 || (mode_.subsets == 2 && t == bc6h_anchor(block_.partition));
        double least = std::numeric_limits<double>::max();
        int chosen = 0;
        for (int index = 0; index < (is_anchor ? count / 2 : count); ++index) {
          double error = 0.0;
          for (int c = 0; c < 3; ++c) {
            const double here = palette_[s][index][c] - target_.light[t][c];
            const double all = sum[c] - off[t][c] + here;
            error += target_.weight[t] * here * here + share * all * all;
          }
          if (error < least) {
            least = error;
            chosen = index;
          }
        }
        block_.indices[t] = chosen;
        for (int c = 0; c < 3; ++c) {
          const double here = palette_[s][chosen][c] - target_.light[t][c];
          sum[c] += here - off[t][c];
          off[t][c] = here;
        }
      }
    }
  }

  double measure() const {
    double error = 0.0, sum[3] = {};
    for (int t = 0; t < kTexels; ++t) {
      for (int c = 0; c < 3; ++c) {
        const double off = palette_[subset_of(t)][block_.indices[t]][c] - target_.light[t][c];
        error += target_.weight[t] * off * off;
        sum[c] += off;
      }
    }
    for (const double off : sum) error += kMeanWeight / kTexels * off * off;
    return error;
  }

  // A step of Gauss and Newton towards the ends that leave the least error with these indices; the
  // mean is left to the indices.
  void improve_lines() {
    const std::vector<float>& values = half_values();
    for (int s = 0; s < mode_.subsets; ++s) {
      for (int c = 0; c < 3; ++c) {
        double aa = 0.0, ab = 0.0, bb = 0.0, ax = 0.0, bx = 0.0;
        for (int t = 0; t < kTexels; ++t) {
          if (subset_of(t) != s) continue;
          const int weight = bc6h_weight(mode_.subsets, block_.indices[t]);
          const int bits = bc6h_between(unquantised_[2 * s][c], unquantised_[2 * s + 1][c], weight);
          const int next = std::min(bits + 8, kLargestBits), before = std::max(bits - 8, 0);
          const double slope = static_cast<double>((values[static_cast<std::size_t>(next)] -
                                                    values[static_cast<std::size_t>(before)]) /
                                                   target_.unit) /
                               (next - before);
          const double root = std::sqrt(target_.weight[t]);
          const double b = root * slope * weight / 64.0, a = root * slope - b;
          const double off = root * (target_.light[t][c] - palette_[s][block_.indices[t]][c]);
          aa += a * a;
          ab += a * b;
          bb += b * b;
          ax += a * off;
          bx += b * off;
        }
        // Where all indices are alike, both ends go the same way.
        const double ridge = 1e-4 * (aa + bb) + 1e-30;
        aa += ridge;
        bb += ridge;
        const double determinant = aa * bb - ab * ab;
        const double steps[2] = {(bb * ax - ab * bx) / determinant,
                                 (aa * bx - ab * ax) / determinant};
        for (int e = 0; e < 2; ++e) {
          const double now = unquantised_[2 * s + e][c] / kUnquantisedPerBit;
          lines_[s].ends[e][c] = std::clamp(now + steps[e], 0.0, double{kLargestBits});
        }
      }
    }
  }

  const Target& target_;
  const Bc6hMode& mode_;
  Line lines_[2] = {};
  Bc6hBlock block_;
  int unquantised_[4][3] = {};
  double palette_[2][16][3] = {};
  Bc6hBlock best_;
  double error_ = std::numeric_limits<double>::max();
};

// The best fit so far.
struct Best {
  Bc6hBlock block;
  double error = std::numeric_limits<double>::max();

  void offer(const Fit& fit) {
    if (fit.error() < error) {
      error = fit.error();
      block = fit.block();
    }
  }
};

struct Split {
  int partition;
  double residual;
  Line lines[2];
};

void try_two_subsets(const Target& target, Best& best) {
  std::array<Split, kBc6hPartitions> splits{};
  for (int partition = 0; partition < kBc6hPartitions; ++partition) {
    std::uint32_t second = 0;
    for (int t = 0; t < kTexels; ++t) {
      second |= static_cast<std::uint32_t>(bc6h_subset(partition, t)) << t;
    }
    double residuals[2];
    Split& split = splits[static_cast<std::size_t>(partition)];
    split.partition = partition;
    split.lines[0] = fit_line(target, ~second & 0xffffu, residuals[0]);
    split.lines[1] = fit_line(target, second, residuals[1]);
    split.residual = residuals[0] + residuals[1];
  }
  std::stable_sort(splits.begin(), splits.end(),
                   [](const Split& a, const Split& b) { return a.residual < b.residual; });
  for (int n = 0; n < kTriedPartitions; ++n) {
    const Split& split = splits[static_cast<std::size_t>(n)];
    for (int mode = 0; mode < kBc6hModes; ++mode) {
      if (bc6h_mode(mode).subsets == 2) best.offer(Fit(target, mode, split.partition, split.lines));
    }
  }
}

}  // namespace

std::array<std::uint8_t, kBlockBytes> encode_bc6h(
    const std::array<std::uint16_t, 3 * kTexels>& halves) {
  const Target target = make_target(halves);
  double residual = 0.0;
  const Line line = fit_line(target, 0xffffu, residual);
  Best best;
  for (int mode = 0; mode < kBc6hModes; ++mode) {
    if (bc6h_mode(mode).subsets == 1) best.offer(Fit(target, mode, 0, &line));
  }
  if (best.error > 3 * kTexels * kGoodEnough * kGoodEnough) try_two_subsets(target, best);
  return bc6h_pack(best.block);
}

std::vector<std::uint8_t> encode_bc6h_face(const std::uint16_t* halves, int size, int threads,
                                           Progress& progress) {
  std::vector<std::uint8_t> bytes;
  std::size_t all = 0;
  for (int side = size; side > 0; side >>= 1) {
    const auto blocks = static_cast<std::size_t>((side + 3) / 4);
    all += blocks * blocks;
  }
  bytes.resize(all * kBlockBytes);
  std::atomic<std::size_t> done{0};
  std::uint8_t* target = bytes.data();
  for (int side = size; side > 0; side >>= 1) {
    const int blocks = (side + 3) / 4;
    parallel_for(static_cast<std::size_t>(blocks), threads, progress, [&](std::size_t row) {
      for (int column = 0; column < blocks; ++column) {
        std::array<std::uint16_t, 3 * kTexels> texels;
        for (int t = 0; t < kTexels; ++t) {
          // Beyond the smallest levels' edges the last texels go on.
          const int x = std::min(4 * column + t % 4, side - 1);
          const int y = std::min(4 * static_cast<int>(row) + t / 4, side - 1);
          const std::uint16_t* texel =
              halves + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                            static_cast<std::size_t>(x));
          for (int c = 0; c < 3; ++c) {
            // Light is neither negative nor infinite.
            const int bits = texel[c] > 0x8000 ? 0 : std::min<int>(texel[c], kLargestBits);
            texels[static_cast<std::size_t>(3 * t + c)] = static_cast<std::uint16_t>(bits);
          }
        }
        const auto block = encode_bc6h(texels);
        std::copy(
            block.begin(), block.end(),
            target + (row * static_cast<std::size_t>(blocks) + static_cast<std::size_t>(column)) *
                         kBlockBytes);
      }
      progress.set(static_cast<double>(done += static_cast<std::size_t>(blocks)) /
                   static_cast<double>(all));
    });
    const auto texels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    halves += 4 * texels;
    target += static_cast<std::size_t>(blocks) * static_cast<std::size_t>(blocks) * kBlockBytes;
  }
  return bytes;
}

}  // namespace lobelight
