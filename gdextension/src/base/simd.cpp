#include "base/simd.h"

#if LOBELIGHT_SIMD_VARIANTS
#include <cpuid.h>

#include <cstdint>
#endif

namespace lobelight {

namespace {

Simd detect() {
#if LOBELIGHT_SIMD_VARIANTS
  // Intel 64 and IA-32 Architectures Software Developer's Manual, vol. 1, 14.3 and 15.2: the
  // processor must have the instructions, and the system must save the registers (XGETBV).
  constexpr unsigned kOsXsave = 1u << 27;   // leaf 1, ECX
  constexpr unsigned kAvx2 = 1u << 5;       // leaf 7, EBX
  constexpr unsigned kAvx512F = 1u << 16;   // leaf 7, EBX
  constexpr unsigned kAvx512Dq = 1u << 17;  // leaf 7, EBX
  constexpr unsigned kSavesYmm = 0x06;      // XCR0: SSE and AVX state
  constexpr unsigned kSavesZmm = 0xe6;      // and the three parts of AVX-512's
  unsigned eax = 0, ebx = 0, ecx = 0, edx = 0;
  if (!__get_cpuid(1, &eax, &ebx, &ecx, &edx) || (ecx & kOsXsave) == 0) return Simd::baseline;
  if (!__get_cpuid_count(7, 0, &eax, &ebx, &ecx, &edx)) return Simd::baseline;
  std::uint32_t saved = 0, saved_high = 0;
  __asm__ volatile("xgetbv" : "=a"(saved), "=d"(saved_high) : "c"(0));
  if ((saved & kSavesYmm) != kSavesYmm || (ebx & kAvx2) == 0) return Simd::baseline;
  constexpr unsigned kNeeded = kAvx512F | kAvx512Dq;
  if ((saved & kSavesZmm) != kSavesZmm || (ebx & kNeeded) != kNeeded) return Simd::avx2;
  return Simd::avx512;
#else
  return Simd::baseline;
#endif
}

}  // namespace

Simd widest_simd() {
  static const Simd widest = detect();
  return widest;
}

std::vector<Simd> usable_simd() {
  std::vector<Simd> usable;
  for (const Simd simd : {Simd::baseline, Simd::avx2, Simd::avx512}) {
    if (simd <= widest_simd()) usable.push_back(simd);
  }
  return usable;
}

}  // namespace lobelight
