#include "image/bc6h.h"

#include <cstdint>
#include <vector>

namespace lobelight {

namespace {

// Bits from the lowest on: channel, colour (w x y z, or d for the partition), and which of its
// bits, a single one or from-to.
const Bc6hMode kModes[kBc6hModes] = {
    {0x00,
     2,
     2,
     10,
     {5, 5, 5},
     true,
     "gy4 by4 bz4 rw0-9 gw0-9 bw0-9 rx0-4 gz4 gy0-3 gx0-4 bz0 gz0-3 bx0-4 bz1 by0-3 ry0-4 bz2 "
     "rz0-4 bz3 dd0-4"},
    {0x01,
     2,
     2,
     7,
     {6, 6, 6},
     true,
     "gy5 gz4 gz5 rw0-6 bz0 bz1 by4 gw0-6 by5 bz2 gy4 bw0-6 bz3 bz5 bz4 rx0-5 gy0-3 gx0-5 gz0-3 "
     "bx0-5 by0-3 ry0-5 rz0-5 dd0-4"},
    {0x02,
     5,
     2,
     11,
     {5, 4, 4},
     true,
     "rw0-9 gw0-9 bw0-9 rx0-4 rw10 gy0-3 gx0-3 gw10 bz0 gz0-3 bx0-3 bw10 bz1 by0-3 ry0-4 bz2 rz0-4 "
     "bz3 dd0-4"},
    {0x06,
     5,
     2,
     11,
     {4, 5, 4},
     true,
     "rw0-9 gw0-9 bw0-9 rx0-3 rw10 gz4 gy0-3 gx0-4 gw10 gz0-3 bx0-3 bw10 bz1 by0-3 ry0-3 bz0 bz2 "
     "rz0-3 gy4 bz3 dd0-4"},
    {0x0a,
     5,
     2,
     11,
     {4, 4, 5},
     true,
     "rw0-9 gw0-9 bw0-9 rx0-3 rw10 by4 gy0-3 gx0-3 gw10 bz0 gz0-3 bx0-4 bw10 by0-3 ry0-3 bz1 bz2 "
     "rz0-3 bz4 bz3 dd0-4"},
    {0x0e,
     5,
     2,
     9,
     {5, 5, 5},
     true,
     "rw0-8 by4 gw0-8 gy4 bw0-8 bz4 rx0-4 gz4 gy0-3 gx0-4 bz0 gz0-3 bx0-4 bz1 by0-3 ry0-4 bz2 "
     "rz0-4 "
     "bz3 dd0-4"},
    {0x12,
     5,
     2,
     8,
     {6, 5, 5},
     true,
     "rw0-7 gz4 by4 gw0-7 bz2 gy4 bw0-7 bz3 bz4 rx0-5 gy0-3 gx0-4 bz0 gz0-3 bx0-4 bz1 by0-3 ry0-5 "
     "rz0-5 dd0-4"},
    {0x16,
     5,
     2,
     8,
     {5, 6, 5},
     true,
     "rw0-7 bz0 by4 gw0-7 gy5 gy4 bw0-7 gz5 bz4 rx0-4 gz4 gy0-3 gx0-5 gz0-3 bx0-4 bz1 by0-3 ry0-4 "
     "bz2 rz0-4 bz3 dd0-4"},
    {0x1a,
     5,
     2,
     8,
     {5, 5, 6},
     true,
     "rw0-7 bz1 by4 gw0-7 by5 gy4 bw0-7 bz5 bz4 rx0-4 gz4 gy0-3 gx0-4 bz0 gz0-3 bx0-5 by0-3 ry0-4 "
     "bz2 rz0-4 bz3 dd0-4"},
    {0x1e,
     5,
     2,
     6,
     {6, 6, 6},
     false,
     "rw0-5 gz4 bz0 bz1 by4 gw0-5 gy5 by5 bz2 gy4 bw0-5 gz5 bz3 bz5 bz4 rx0-5 gy0-3 gx0-5 gz0-3 "
     "bx0-5 by0-3 ry0-5 rz0-5 dd0-4"},
    {0x03, 5, 1, 10, {10, 10, 10}, false, "rw0-9 gw0-9 bw0-9 rx0-9 gx0-9 bx0-9"},
    {0x07, 5, 1, 11, {9, 9, 9}, true, "rw0-9 gw0-9 bw0-9 rx0-8 rw10 gx0-8 gw10 bx0-8 bw10"},
    {0x0b,
     5,
     1,
     12,
     {8, 8, 8},
     true,
     "rw0-9 gw0-9 bw0-9 rx0-7 rw11-10 gx0-7 gw11-10 bx0-7 bw11-10"},
    {0x0f,
     5,
     1,
     16,
     {4, 4, 4},
     true,
     "rw0-9 gw0-9 bw0-9 rx0-3 rw15-10 gx0-3 gw15-10 bx0-3 bw15-10"},
};

// The texels of the second subset, the first texel in the lowest bit, and that subset's anchor.
struct Partition {
  std::uint16_t second;
  int anchor;
};
const Partition kPartitions[kBc6hPartitions] = {
    {0xcccc, 15}, {0x8888, 15}, {0xeeee, 15}, {0xecc8, 15}, {0xc880, 15}, {0xfeec, 15},
    {0xfec8, 15}, {0xec80, 15}, {0xc800, 15}, {0xffec, 15}, {0xfe80, 15}, {0xe800, 15},
    {0xffe8, 15}, {0xff00, 15}, {0xfff0, 15}, {0xf000, 15}, {0xf710, 15}, {0x008e, 2},
    {0x7100, 8},  {0x08ce, 2},  {0x008c, 2},  {0x7310, 8},  {0x3100, 8},  {0x8cce, 15},
    {0x088c, 2},  {0x3110, 8},  {0x6666, 2},  {0x366c, 2},  {0x17e8, 8},  {0x0ff0, 8},
    {0x718e, 2},  {0x399c, 2},
};

constexpr int kWeights3[8] = {0, 9, 18, 27, 37, 46, 55, 64};
constexpr int kWeights4[16] = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};

constexpr int kPartitionField = 12;

// One bit of a block: of the channels of colours, 3 · colour + channel, or of the partition.
struct Place {
  int field;
  int bit;
};

int digits(const char*& text) {
  int number = 0;
  while (*text >= '0' && *text <= '9') number = 10 * number + (*text++ - '0');
  return number;
}

std::vector<Place> read_layout(const char* text) {
  std::vector<Place> places;
  while (*text != '\0') {
    const int channel = text[0] == 'r' ? 0 : text[0] == 'g' ? 1 : 2;
    const int field = text[0] == 'd' ? kPartitionField : 3 * (text[1] - 'w') + channel;
    text += 2;
    const int first = digits(text);
    const int last = *text == '-' ? digits(++text) : first;
    const int step = last < first ? -1 : 1;
    for (int bit = first; bit != last + step; bit += step) places.push_back({field, bit});
    if (*text == ' ') ++text;
  }
  return places;
}

const std::vector<Place>& layout_of(int mode) {
  static const std::array<std::vector<Place>, kBc6hModes> layouts = [] {
    std::array<std::vector<Place>, kBc6hModes> read;
    for (std::size_t n = 0; n < read.size(); ++n) read[n] = read_layout(kModes[n].layout);
    return read;
  }();
  return layouts[static_cast<std::size_t>(mode)];
}

// A block's bits, the lowest first.
class Bits {
 public:
  explicit Bits(std::uint8_t* bytes) : bytes_(bytes) {}
  void write(int value, int count) {
    for (int bit = 0; bit < count; ++bit, ++at_) {
      if ((value >> bit & 1) != 0) {
        bytes_[at_ / 8] = static_cast<std::uint8_t>(bytes_[at_ / 8] | 1 << at_ % 8);
      }
    }
  }

 private:
  std::uint8_t* bytes_;
  int at_ = 0;
};

class BitReader {
 public:
  explicit BitReader(const std::uint8_t* bytes) : bytes_(bytes) {}
  int read(int count) {
    int value = 0;
    for (int bit = 0; bit < count; ++bit, ++at_) value |= (bytes_[at_ / 8] >> at_ % 8 & 1) << bit;
    return value;
  }

 private:
  const std::uint8_t* bytes_;
  int at_ = 0;
};

bool is_anchor(const Bc6hMode& mode, int partition, int texel) {
  return texel == 0 || (mode.subsets == 2 && texel == bc6h_anchor(partition));
}

}  // namespace

const Bc6hMode& bc6h_mode(int mode) { return kModes[mode]; }

int bc6h_subset(int partition, int texel) { return kPartitions[partition].second >> texel & 1; }

int bc6h_anchor(int partition) { return kPartitions[partition].anchor; }

int bc6h_weight(int subsets, int index) {
  return subsets == 1 ? kWeights4[index] : kWeights3[index];
}

int bc6h_unquantize(int value, int precision) {
  if (precision >= 15 || value == 0) return value;
  if (value == (1 << precision) - 1) return 0xffff;
  return ((value << 16) + 0x8000) >> precision;
}

std::array<std::uint8_t, kBlockBytes> bc6h_pack(const Bc6hBlock& block) {
  const Bc6hMode& mode = kModes[block.mode];
  int fields[kPartitionField + 1] = {};
  for (int colour = 0; colour < 2 * mode.subsets; ++colour) {
    for (int channel = 0; channel < 3; ++channel) {
      const int base = mode.is_delta && colour > 0 ? block.colours[0][channel] : 0;
      fields[3 * colour + channel] = block.colours[colour][channel] - base;
    }
  }
  fields[kPartitionField] = block.partition;

  std::array<std::uint8_t, kBlockBytes> bytes{};
  Bits bits(bytes.data());
  bits.write(mode.number, mode.number_bits);
  // Negative differences have all higher bits set; those that are read are the lowest ones.
  for (const Place& place : layout_of(block.mode)) bits.write(fields[place.field] >> place.bit, 1);
  const int index_bits = bc6h_index_bits(mode.subsets);
  for (int texel = 0; texel < kBlockTexels; ++texel) {
    bits.write(block.indices[texel],
               index_bits - (is_anchor(mode, block.partition, texel) ? 1 : 0));
  }
  return bytes;
}

std::array<std::uint16_t, 3 * kBlockTexels> bc6h_unpack(const std::uint8_t* bytes) {
  std::array<std::uint16_t, 3 * kBlockTexels> halves{};
  BitReader reader(bytes);
  int number = reader.read(2);
  if (number > 1) number |= reader.read(3) << 2;
  int found = 0;
  while (found < kBc6hModes && kModes[found].number != number) ++found;
  if (found == kBc6hModes) return halves;
  const Bc6hMode& mode = kModes[found];
  int fields[kPartitionField + 1] = {};
  for (const Place& place : layout_of(found)) fields[place.field] |= reader.read(1) << place.bit;

  int unquantised[4][3] = {};
  for (int colour = 0; colour < 2 * mode.subsets; ++colour) {
    for (int channel = 0; channel < 3; ++channel) {
      int value = fields[3 * colour + channel];
      if (mode.is_delta && colour > 0) {
        const int sign = 1 << (mode.delta_bits[channel] - 1);
        value = (fields[channel] + (value ^ sign) - sign) & ((1 << mode.precision) - 1);
      }
      unquantised[colour][channel] = bc6h_unquantize(value, mode.precision);
    }
  }
  const int partition = fields[kPartitionField];
  for (int texel = 0; texel < kBlockTexels; ++texel) {
    const int index =
        reader.read(bc6h_index_bits(mode.subsets) - (is_anchor(mode, partition, texel) ? 1 : 0));
    const int subset = mode.subsets == 2 ? bc6h_subset(partition, texel) : 0;
    for (int channel = 0; channel < 3; ++channel) {
      halves[static_cast<std::size_t>(3 * texel + channel)] = static_cast<std::uint16_t>(
          bc6h_between(unquantised[2 * subset][channel], unquantised[2 * subset + 1][channel],
                       bc6h_weight(mode.subsets, index)));
    }
  }
  return halves;
}

}  // namespace lobelight
