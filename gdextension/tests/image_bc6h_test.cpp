#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "image/bc6h_encode.h"
#include "table/half_float.h"
#include "watched_progress.h"

namespace lobelight {
namespace {

using Texels = std::array<std::uint16_t, 3 * kBlockTexels>;

// Colours of 16 texels from a function of the place in [0, 3]².
template <class Light>
Texels make_texels(const Light& light) {
  Texels texels;
  for (int t = 0; t < kBlockTexels; ++t) {
    for (int c = 0; c < 3; ++c) {
      texels[static_cast<std::size_t>(3 * t + c)] = half_from_double(light(t % 4, t / 4, c));
    }
  }
  return texels;
}

// The root of the mean squared error beside the mean of the light, and the error of the mean.
struct Error {
  double texels, mean;
};

Error error_of(const Texels& texels) {
  const Texels decoded = bc6h_unpack(encode_bc6h(texels).data());
  double squares = 0.0, off = 0.0, sum = 0.0;
  for (std::size_t n = 0; n < texels.size(); ++n) {
    const double difference = double_from_half(decoded[n]) - double_from_half(texels[n]);
    squares += difference * difference;
    off += difference;
    sum += double_from_half(texels[n]);
  }
  const double count = 3.0 * kBlockTexels;
  return {std::sqrt(squares / count) / (sum / count), std::abs(off) / sum};
}

}  // namespace

TEST_CASE("BC6H: what is packed is unpacked, in every mode and partition") {
  std::mt19937 random(7);
  for (int number = 0; number < kBc6hModes; ++number) {
    const Bc6hMode& mode = bc6h_mode(number);
    for (int partition = 0; partition < (mode.subsets == 2 ? kBc6hPartitions : 1); ++partition) {
      Bc6hBlock block;
      block.mode = number;
      block.partition = partition;
      const int largest = (1 << mode.precision) - 1;
      const auto pick = [&](int from, int to) {
        return from + static_cast<int>(random() % static_cast<unsigned>(to - from + 1));
      };
      for (int colour = 0; colour < 2 * mode.subsets; ++colour) {
        for (int c = 0; c < 3; ++c) {
          int from = 0, to = largest;
          if (mode.is_delta && colour > 0) {
            const int reach = 1 << (mode.delta_bits[c] - 1);
            from = std::max(0, block.colours[0][c] - reach);
            to = std::min(largest, block.colours[0][c] + reach - 1);
          }
          block.colours[colour][c] = pick(from, to);
        }
      }
      const int indices = 1 << bc6h_index_bits(mode.subsets);
      for (int t = 0; t < kBlockTexels; ++t) {
        const bool is_anchor = t == 0 || (mode.subsets == 2 && t == bc6h_anchor(partition));
        block.indices[t] = pick(0, (is_anchor ? indices / 2 : indices) - 1);
      }
      const Texels texels = bc6h_unpack(bc6h_pack(block).data());
      bool is_same = true;
      for (int t = 0; t < kBlockTexels; ++t) {
        const int s = mode.subsets == 2 ? bc6h_subset(partition, t) : 0;
        for (int c = 0; c < 3; ++c) {
          const int bits =
              bc6h_between(bc6h_unquantize(block.colours[2 * s][c], mode.precision),
                           bc6h_unquantize(block.colours[2 * s + 1][c], mode.precision),
                           bc6h_weight(mode.subsets, block.indices[t]));
          is_same = is_same && texels[static_cast<std::size_t>(3 * t + c)] == bits;
        }
      }
      CAPTURE(number);
      CAPTURE(partition);
      CHECK(is_same);
    }
  }
}

TEST_CASE("encode_bc6h: even light, gradients and edges") {
  for (const double value : {1e-4, 0.7, 3000.0}) {
    const Texels even = make_texels([=](int, int, int c) { return value * (1.0 + 0.3 * c); });
    CHECK(error_of(even).texels < 0.001);
  }
  const Texels dark = make_texels([](int, int, int) { return 0.0; });
  CHECK(bc6h_unpack(encode_bc6h(dark).data()) == dark);
  // A quarter brighter across the block, of one tint.
  const Error gradient = error_of(
      make_texels([](int x, int y, int c) { return (1.0 + 0.05 * x + 0.03 * y) * (1.0 + c); }));
  CHECK(gradient.texels < 0.01);
  CHECK(gradient.mean < 0.001);
  // A coloured edge, which takes two subsets.
  const Error edge = error_of(make_texels([](int x, int y, int c) {
    return x < 2 ? (1.0 + 0.02 * y) * (3.0 - c) : (0.2 + 0.01 * y) * (1.0 + c);
  }));
  CHECK(edge.texels < 0.04);
  // A light 1000 times as bright as what is about it.
  const Error spot = error_of(
      make_texels([](int x, int y, int) { return x == 1 && y == 2 ? 1000.0 : 1.0 + 0.1 * x; }));
  CHECK(spot.mean < 0.002);
}

TEST_CASE("encode_bc6h_face: all levels, the same on any number of threads, and cancel") {
  constexpr int kSize = 16;
  std::vector<std::uint16_t> halves;
  std::mt19937 random(3);
  for (int side = kSize; side > 0; side >>= 1) {
    for (int n = 0; n < side * side; ++n) {
      for (int c = 0; c < 4; ++c) {
        halves.push_back(half_from_double(1.0 + 0.3 * c + 1e-9 * static_cast<double>(random())));
      }
    }
  }
  Progress progress;
  const std::vector<std::uint8_t> one = encode_bc6h_face(halves.data(), kSize, 1, progress);
  // Blocks of the levels 16, 8, 4, 2 and 1.
  CHECK(one.size() == kBlockBytes * (16 + 4 + 1 + 1 + 1));
  CHECK(progress.fraction() == doctest::Approx(1.0));
  for (const int threads : {2, 5}) {
    CHECK(encode_bc6h_face(halves.data(), kSize, threads, progress) == one);
  }
  // The last level is one texel.
  const Texels last = bc6h_unpack(&one[one.size() - kBlockBytes]);
  for (int c = 0; c < 3; ++c) {
    const double value = double_from_half(last[static_cast<std::size_t>(c)]);
    CHECK(value ==
          doctest::Approx(double_from_half(halves[halves.size() - 4 + static_cast<std::size_t>(c)]))
              .epsilon(0.002));
  }
  testing::WatchedProgress stopped(1);
  CHECK_THROWS_AS(encode_bc6h_face(halves.data(), kSize, 1, stopped), Cancelled);
}

TEST_CASE("encode_bc6h_face: what is negative or no number becomes sound") {
  const std::vector<std::uint16_t> halves = {0xc000, 0x7c00, 0x7e00, 0x3c00};
  Progress progress;
  const std::vector<std::uint8_t> bytes = encode_bc6h_face(halves.data(), 1, 1, progress);
  const Texels texels = bc6h_unpack(bytes.data());
  CHECK(texels[0] == 0);
  CHECK(double_from_half(texels[1]) == doctest::Approx(65504.0).epsilon(0.01));
  CHECK(double_from_half(texels[2]) <= 65504.0);
}

}  // namespace lobelight
