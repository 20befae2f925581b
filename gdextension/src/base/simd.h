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

// For the body that all variants share: it must be inlined into each of them.
#if defined(__GNUC__)
#define LOBELIGHT_ALWAYS_INLINE inline __attribute__((always_inline))
#else
#define LOBELIGHT_ALWAYS_INLINE inline
#endif
