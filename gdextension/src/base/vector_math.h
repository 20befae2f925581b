#pragma once

#include <cstdint>
#include <cstring>

// Exponential and logarithm for loops over arrays: no branches and no calls, so that the compiler
// makes SIMD code of the loop, and made of IEEE operations alone, so that the result does not
// depend on which variant of the system's library a processor selects (build with
// -ffp-contract=off).

namespace lobelight {

namespace detail {

inline double from_bits(std::uint64_t bits) {
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

inline std::uint64_t to_bits(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

constexpr double kLn2High =
    6.93147180369123816490e-01;  // 32 significant bits: n · kLn2High is exact
constexpr double kLn2Low = 1.90821492927058770002e-10;

// Adding 1.5 · 2^52 leaves the nearest integer in the low bits of the sum.
constexpr double kRoundToInteger = 6755399441055744.0;

}  // namespace detail

// e^x to 2 ulp for −700 ≤ x ≤ 0. (A clamp in here would become a branch, and the loop would no
// longer be vectorised.)
inline double exp_nonpositive(double x) {
  // e^x = 2^n e^r, n = round(x / ln 2), |r| ≤ ln 2 / 2; then the Taylor series, whose first omitted
  // term is 4e-18.
  const double shifted = x * 1.44269504088896340736 + detail::kRoundToInteger;
  const double n = shifted - detail::kRoundToInteger;
  const double r = (x - n * detail::kLn2High) - n * detail::kLn2Low;
  double p = 1.0 / 6227020800.0;
  p = p * r + 1.0 / 479001600.0;
  p = p * r + 1.0 / 39916800.0;
  p = p * r + 1.0 / 3628800.0;
  p = p * r + 1.0 / 362880.0;
  p = p * r + 1.0 / 40320.0;
  p = p * r + 1.0 / 5040.0;
  p = p * r + 1.0 / 720.0;
  p = p * r + 1.0 / 120.0;
  p = p * r + 1.0 / 24.0;
  p = p * r + 1.0 / 6.0;
  p = p * r + 0.5;
  p = p * r * r + r + 1.0;
  // The low bits of `shifted` are n in two's complement: they go into the exponent as they are.
  const double scale = detail::from_bits((detail::to_bits(shifted) + 1023u) << 52);
  return p * scale;
}

// ln x for finite, normal x ≥ 1, to 2 ulp.
inline double log_of_at_least_one(double x) {
  // x = 2^n m with m in [√½, √2); ln m = 2 artanh s, s = (m − 1)/(m + 1), |s| ≤ 0.1716; the first
  // omitted term of the series is below 2^-55 of the sum.
  constexpr std::uint64_t kSqrtHalf = 0x3fe6a09e667f3bcdu;
  const std::uint64_t bits = detail::to_bits(x);
  const std::uint64_t n_bits = (bits - kSqrtHalf) >> 52;
  const double m = detail::from_bits(bits - (n_bits << 52));
  // n < 2^11 as a double, again by way of the low bits of a large number.
  const double n =
      detail::from_bits(n_bits + detail::to_bits(4503599627370496.0)) - 4503599627370496.0;
  const double f = m - 1.0;
  const double s = f / (m + 1.0);
  const double q = s * s;
  double p = 1.0 / 21.0;
  p = p * q + 1.0 / 19.0;
  p = p * q + 1.0 / 17.0;
  p = p * q + 1.0 / 15.0;
  p = p * q + 1.0 / 13.0;
  p = p * q + 1.0 / 11.0;
  p = p * q + 1.0 / 9.0;
  p = p * q + 1.0 / 7.0;
  p = p * q + 1.0 / 5.0;
  p = p * q + 1.0 / 3.0;
  // 2s = f − s f, and f is exact: ln m = f − s (f − 2 q p) loses nothing to the rounding of s.
  return n * detail::kLn2High + (f - (s * (f - 2.0 * q * p) - n * detail::kLn2Low));
}

}  // namespace lobelight
