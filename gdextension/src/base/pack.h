#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/simd.h"

// Some doubles at once, in the vector types of GCC and Clang, with the exponential and the
// logarithm that EM needs. Everything is made of IEEE operations on single elements, without
// branches and without calls: what comes out depends neither on how many elements a pack has nor on
// which variant of the system's library a processor selects (build with -ffp-contract=off).

#if defined(__GNUC__)
// Packs are passed between inlined functions only, so it does not matter how they would be passed
// otherwise. Compilers warn where a template is instantiated: the pragma has to outlast this file.
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace lobelight {

template <int Width>
struct PackTypes {
  typedef double Reals __attribute__((vector_size(8 * Width)));
  typedef std::int64_t Bits __attribute__((vector_size(8 * Width)));
};

template <int Width>
using Pack = typename PackTypes<Width>::Reals;
template <int Width>
using PackBits = typename PackTypes<Width>::Bits;

template <int Width>
LOBELIGHT_ALWAYS_INLINE Pack<Width> load(const double* from) {
  Pack<Width> pack;
  std::memcpy(&pack, from, sizeof pack);
  return pack;
}

template <int Width>
LOBELIGHT_ALWAYS_INLINE void store(const Pack<Width>& pack, double* to) {
  std::memcpy(to, &pack, sizeof pack);
}

template <int Width>
LOBELIGHT_ALWAYS_INLINE Pack<Width> larger(const Pack<Width>& a, const Pack<Width>& b) {
  return a > b ? a : b;
}

namespace detail {

// Adding 1.5 · 2^52 leaves the nearest integer in the low bits of the sum.
constexpr double kRoundToInteger = 6755399441055744.0;
constexpr double kLn2 = 0.693147180559945309417;

}  // namespace detail

// 2^x for −1000 ≤ x ≤ 0, to 3 ulp, and exactly 1 at 0, for `Count` packs in turn: a processor would
// otherwise wait for each step of the polynomial.
template <int Width, int Count>
LOBELIGHT_ALWAYS_INLINE void exp2_nonpositive(Pack<Width> (&x)[Count]) {
  // 2^x = 2^n 2^r, n = round(x), |r| ≤ 1/2; 2^r by the polynomial of least relative error, 2.1e-16
  // (Remez' algorithm).
  constexpr double kCoefficients[] = {1.0208537969303488e-07, 1.3215662840308494e-06,
                                      1.5252658115968896e-05, 0.0001540352996115474,
                                      0.0013333558228562964,  0.009618129108034546,
                                      0.055504108664458825,   0.24022650695908768,
                                      0.6931471805599497,     1.0};
  Pack<Width> shifted[Count], r[Count], p[Count];
  for (int i = 0; i < Count; ++i) {
    shifted[i] = x[i] + detail::kRoundToInteger;
    r[i] = x[i] - (shifted[i] - detail::kRoundToInteger);
    p[i] = Pack<Width>{} + 7.0372755324175595e-09;
  }
  for (const double coefficient : kCoefficients) {
    for (int i = 0; i < Count; ++i) p[i] = p[i] * r[i] + coefficient;
  }
  // The low bits of `shifted` are n in two's complement: they go to the exponent as they are.
  for (int i = 0; i < Count; ++i) {
    x[i] = (Pack<Width>)((PackBits<Width>)p[i] + ((PackBits<Width>)shifted[i] << 52));
  }
}

// log2 x and 1/x for finite, normal x ≥ 1: the logarithm to 2 ulp of the larger of 1 and itself,
// the reciprocal to 2 ulp.
template <int Width>
LOBELIGHT_ALWAYS_INLINE void log2_and_reciprocal(const Pack<Width>& x, Pack<Width>& log2_x,
                                                 Pack<Width>& reciprocal) {
  // x = 2^n m with m in [√½, √2); ln m = 2 artanh s, s = (m − 1)/(m + 1), |s| ≤ 0.1716; the first
  // omitted term of the series is below 2^-55 of the sum.
  constexpr std::int64_t kSqrtHalf = 0x3fe6a09e667f3bcd;
  constexpr std::int64_t kExponentOf2To52 = 0x4330000000000000;
  constexpr double k2To52 = 4503599627370496.0;
  const PackBits<Width> bits = (PackBits<Width>)x;
  const PackBits<Width> n_bits = (bits - kSqrtHalf) >> 52;
  const Pack<Width> m = (Pack<Width>)(bits - (n_bits << 52));
  // n < 2^11 as a double, again by way of the low bits of a large number.
  const Pack<Width> n = (Pack<Width>)(n_bits + kExponentOf2To52) - k2To52;
  // One division, which is slow, for both quotients.
  const Pack<Width> both = 1.0 / (x * (m + 1.0));
  reciprocal = both * (m + 1.0);
  const Pack<Width> s = (m - 1.0) * (both * x);
  const Pack<Width> q = s * s;
  Pack<Width> p = q * (1.0 / 21.0) + 1.0 / 19.0;
  p = p * q + 1.0 / 17.0;
  p = p * q + 1.0 / 15.0;
  p = p * q + 1.0 / 13.0;
  p = p * q + 1.0 / 11.0;
  p = p * q + 1.0 / 9.0;
  p = p * q + 1.0 / 7.0;
  p = p * q + 1.0 / 5.0;
  p = p * q + 1.0 / 3.0;
  p = p * q + 1.0;
  log2_x = n + (2.0 / detail::kLn2) * s * p;
}

}  // namespace lobelight
