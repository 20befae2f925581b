#include "reference/sobol.h"

#include <stdexcept>

namespace lobelight {
namespace {

std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// Sobol's second dimension (the first is the van der Corput sequence): its generator matrix is
// Pascal's triangle modulo 2, whose next column is v ^ (v >> 1).
std::uint32_t sobol_second_dimension(std::uint32_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t column = 1u << 31; index != 0; index >>= 1, column ^= column >> 1) {
    if (index & 1u) result ^= column;
  }
  return result;
}

// Nested uniform (Owen) scramble of a fraction whose bits are reversed: every step lets a bit
// depend only on the more significant bits of the fraction. Laine and Karras 2011, "Stratified
// sampling for stochastic transparency", as Burley 2020, "Practical hash-based Owen scrambling",
// uses it; constants of Vegdahl 2021, "Building a better LK hash".
std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

double to_unit_interval(std::uint32_t fraction) { return static_cast<double>(fraction) * 0x1p-32; }

}  // namespace

std::uint64_t mix_bits(std::uint64_t value) {
  // The finaliser of SplitMix64: Steele, Lea and Flood 2014, "Fast splittable pseudorandom number
  // generators", with Stafford's constants.
  value += 0x9e3779b97f4a7c15u;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
  return value ^ (value >> 31);
}

SobolPoints::SobolPoints(std::size_t count, const Progress* progress) {
  if (count < 1 || count > (std::size_t{1} << 31)) {
    throw std::invalid_argument("A Sobol sequence needs 1 to 2^31 points.");
  }
  points_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    throw_if_cancelled(progress, i);
    const std::uint32_t index = static_cast<std::uint32_t>(i);
    // Bits reversed, as the scramble wants them; the first dimension is the reversed index itself.
    points_.push_back({index, reverse_bits(sobol_second_dimension(index))});
  }
}

glm::dvec2 SobolPoints::scrambled(std::size_t index, std::uint64_t seed) const {
  const glm::uvec2 point = points_[index];
  const std::uint32_t seed_x = static_cast<std::uint32_t>(seed);
  const std::uint32_t seed_y = static_cast<std::uint32_t>(seed >> 32);
  return {to_unit_interval(reverse_bits(scramble_reversed(point.x, seed_x))),
          to_unit_interval(reverse_bits(scramble_reversed(point.y, seed_y)))};
}

}  // namespace lobelight
