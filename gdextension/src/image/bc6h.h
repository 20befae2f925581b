#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lobelight {

// BC6H (BPTC_RGBFU in Godot): blocks of 4 × 4 texels of unsigned half floats in 16 bytes. Khronos
// Data Format Specification 1.3, chapter 20.

inline constexpr int kBlockTexels = 16;
inline constexpr std::size_t kBlockBytes = 16;

// How a block is laid out: one of 14 modes.
struct Bc6hMode {
  int number;         // the low bits of a block
  int number_bits;    // 2 or 5
  int subsets;        // texels belong to one of so many lines between two colours
  int precision;      // bits of a colour's channel
  int delta_bits[3];  // of the other colours' channels, if they are differences to the first
  bool is_delta;
  const char* layout;  // the bits after the number, see bc6h.cpp
};
inline constexpr int kBc6hModes = 14;
const Bc6hMode& bc6h_mode(int mode);

// Which of two subsets a texel (row by row) belongs to, and the texel whose index has one bit less
// in the second subset; in the first that is texel 0.
inline constexpr int kBc6hPartitions = 32;
int bc6h_subset(int partition, int texel);
int bc6h_anchor(int partition);

// Bits of an index, and the weight of a subset's second colour, of 64.
inline int bc6h_index_bits(int subsets) { return subsets == 1 ? 4 : 3; }
int bc6h_weight(int subsets, int index);

// What a block says.
struct Bc6hBlock {
  int mode = 0;
  int partition = 0;
  int colours[4][3] = {};  // of the first subset, then of the second, each of `precision` bits
  int indices[kBlockTexels] = {};
};

// A channel of a colour of `precision` bits as a whole number from 0 to 65535.
int bc6h_unquantize(int value, int precision);

// The bits of the half float that lies between two unquantised channels.
inline int bc6h_between(int first, int second, int weight) {
  return (((first * (64 - weight) + second * weight + 32) >> 6) * 31) >> 6;
}

// The colours must be within what the mode's differences hold, and the anchors' indices below half
// of the largest.
std::array<std::uint8_t, kBlockBytes> bc6h_pack(const Bc6hBlock& block);

// The bits of half floats: red, green and blue of each texel, row by row. Reserved modes are black.
std::array<std::uint16_t, 3 * kBlockTexels> bc6h_unpack(const std::uint8_t* bytes);

}  // namespace lobelight
