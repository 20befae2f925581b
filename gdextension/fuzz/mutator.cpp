#include "mutator.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace lobelight::fuzz {

namespace {

constexpr std::size_t kMostAccepted = 256;
constexpr std::size_t kMostFar = 4096;
constexpr std::size_t kRoomToGrow = 4096;
constexpr std::size_t kLongestCopy = 64;

// Fields of a header lie near the beginning of all formats here.
constexpr std::size_t kHeader = 400;

// Numbers at the edges of their types.
constexpr std::array<std::uint64_t, 16> kWhole{
    0,     1,     2,          127,        128,        255,        256,        32767,
    65535, 65536, 0x7fffffff, 0x80000000, 0xffffffff, 1ULL << 32, 1ULL << 62, ~0ULL};
constexpr std::array<float, 9> kReal{0.0F,
                                     -0.0F,
                                     -1.0F,
                                     std::numeric_limits<float>::infinity(),
                                     -std::numeric_limits<float>::infinity(),
                                     std::numeric_limits<float>::quiet_NaN(),
                                     std::numeric_limits<float>::max(),
                                     std::numeric_limits<float>::min(),
                                     std::numeric_limits<float>::denorm_min()};

}  // namespace

Mutator::Mutator(std::vector<Bytes> seeds, std::uint64_t number)
    : random_(number), seeds_(std::move(seeds)), longest_(0) {
  for (const Bytes& seed : seeds_) longest_ = std::max(longest_, seed.size());
  longest_ = 2 * longest_ + kRoomToGrow;
}

// The bias of the remainder does not matter here.
std::size_t Mutator::below(std::size_t bound) {
  return static_cast<std::size_t>(random_() % bound);
}

// Where `length` bytes fit, half of the times in what may be a header. Needs bytes.size() ≥ length.
std::size_t Mutator::place(const Bytes& bytes, std::size_t length) {
  const std::size_t places = bytes.size() - length + 1;
  return below(below(2) == 0 ? std::min(places, kHeader) : places);
}

const Mutator::Bytes& Mutator::any_file() {
  const std::size_t kind = below(3);
  if (kind == 1 && !accepted_.empty()) return accepted_[below(accepted_.size())];
  if (kind == 2 && !far_.empty()) return far_[below(far_.size())];
  return seeds_[below(seeds_.size())];
}

void Mutator::keep(const Bytes& input, bool reaches_more) {
  std::vector<Bytes>& files = reaches_more ? far_ : accepted_;
  if (files.size() < (reaches_more ? kMostFar : kMostAccepted)) {
    files.push_back(input);
  } else {
    files[below(files.size())] = input;
  }
}

void Mutator::change(Bytes& bytes) {
  if (bytes.empty()) bytes.push_back(0);
  // Iterators from here on are offsets in `bytes`.
  const auto at = [&](std::size_t offset) {
    return bytes.begin() + static_cast<std::ptrdiff_t>(offset);
  };
  const auto overwrite = [&](const void* source, std::size_t length) {
    length = std::min(length, bytes.size());
    std::memcpy(&bytes[place(bytes, length)], source, length);
  };
  switch (below(11)) {
    case 0:
    case 1:
      bytes[place(bytes, 1)] ^= static_cast<std::uint8_t>(1U << below(8));
      break;
    case 2:
      bytes[place(bytes, 1)] = static_cast<std::uint8_t>(below(256));
      break;
    case 3: {
      constexpr std::array<std::size_t, 4> kWidths{1, 2, 4, 8};
      const std::uint64_t value = kWhole[below(kWhole.size())];
      overwrite(&value, kWidths[below(kWidths.size())]);
      break;
    }
    case 4: {
      const float value = kReal[below(kReal.size())];
      const auto wide = static_cast<double>(value);
      if (below(2) == 0) {
        overwrite(&value, sizeof value);
      } else {
        overwrite(&wide, sizeof wide);
      }
      break;
    }
    case 5: {
      // A little more or less than there was.
      std::uint8_t& byte = bytes[place(bytes, 1)];
      byte = static_cast<std::uint8_t>(byte + below(9) - 4);
      break;
    }
    case 6: {
      // A digit, where the format is text.
      const std::size_t first = place(bytes, 1);
      const auto digit =
          std::find_if(at(first), bytes.end(), [](std::uint8_t c) { return c >= '0' && c <= '9'; });
      if (digit != bytes.end()) *digit = static_cast<std::uint8_t>('0' + below(10));
      break;
    }
    case 7: {
      const std::size_t length = 1 + below(std::min(kLongestCopy, bytes.size()));
      const std::size_t first = place(bytes, length);
      bytes.erase(at(first), at(first + length));
      break;
    }
    case 8: {
      // A stretch of this file once more.
      const std::size_t length = 1 + below(std::min(kLongestCopy, bytes.size()));
      const std::size_t source = place(bytes, length);
      const Bytes copy(at(source), at(source + length));
      bytes.insert(at(place(bytes, 1)), copy.begin(), copy.end());
      break;
    }
    case 9: {
      // A stretch of another one over this one, or the rest of it behind.
      const Bytes& other = any_file();
      if (other.empty()) break;
      const std::size_t length = 1 + below(std::min(other.size(), bytes.size()));
      const std::size_t source = place(other, length);
      if (below(4) != 0) {
        overwrite(&other[source], std::min(length, kLongestCopy));
      } else {
        bytes.erase(at(place(bytes, 1)), bytes.end());
        bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(source), other.end());
      }
      break;
    }
    default:
      bytes.erase(at(place(bytes, 1)), bytes.end());
      break;
  }
}

Mutator::Bytes Mutator::next() {
  Bytes bytes = any_file();
  // Few changes as often as many: one byte is what finds a lie in an otherwise sound file.
  const std::size_t changes = std::size_t{1} << below(4);
  for (std::size_t n = 0; n < changes; ++n) change(bytes);
  if (bytes.size() > longest_) bytes.resize(longest_);
  return bytes;
}

}  // namespace lobelight::fuzz
