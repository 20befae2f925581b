#pragma once

#include <vector>

namespace lobelight {

// Instruction sets for which loops over arrays are compiled, narrow to wide. What such a loop gives
// is the same to the last bit for all of them.
enum class Simd { baseline, avx2, avx512 };

// The widest set that this processor and its operating system can run.
Simd widest_simd();

// All that can be run here, narrow to wide.
std::vector<Simd> usable_simd();

}  // namespace lobelight

// Functions can be compiled for more than one set on x86-64, except by GCC for Windows, which does
// not align the stack for the wider registers.
#if defined(__x86_64__) && defined(__GNUC__) && (!defined(_WIN32) || defined(__clang__))
#define LOBELIGHT_SIMD_VARIANTS 1
#else
#define LOBELIGHT_SIMD_VARIANTS 0
#endif

// What a function for Simd::avx512 is compiled for. Clang 18 to 21 have a feature of its own for
// the 512-bit registers; where a compiler built on them leaves it out by default, as Zig 0.15 does,
// they cannot compile shifts of eight integers.
#if defined(__clang__) && __clang_major__ >= 18 && __clang_major__ <= 21
#define LOBELIGHT_AVX512 "avx512f,avx512dq,evex512"
#else
#define LOBELIGHT_AVX512 "avx512f,avx512dq"
#endif

// For the body that all variants share: it must be inlined into each of them.
#if defined(__GNUC__)
#define LOBELIGHT_ALWAYS_INLINE inline __attribute__((always_inline))
#else
#define LOBELIGHT_ALWAYS_INLINE inline
#endif
