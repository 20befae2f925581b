#include <doctest/doctest.h>

#include <cstdint>
#include <new>

#include "allocated_bytes.h"

namespace lobelight {
namespace {

// Calls of the operators themselves: expressions may be optimised away.
constexpr std::size_t kSize = 1000;
constexpr std::align_val_t kAligned{256};

// Takes a block with `take`, gives it back with `give`.
template <typename Take, typename Give>
void check(Take take, Give give, std::size_t alignment) {
  const std::size_t before = bench::held_bytes();
  bench::reset_peak_bytes();
  void* const block = take();
  REQUIRE(block != nullptr);
  CHECK(reinterpret_cast<std::uintptr_t>(block) % alignment == 0);
  CHECK(bench::held_bytes() - before == kSize);
  give(block);
  CHECK(bench::held_bytes() == before);
  CHECK(bench::peak_bytes() - before == kSize);
}

TEST_CASE("Every operator new is counted, and its block given back by every operator delete") {
  constexpr std::size_t kDefault = __STDCPP_DEFAULT_NEW_ALIGNMENT__;
  constexpr auto kLarge = static_cast<std::size_t>(kAligned);
  const auto plain = [](void* block) { ::operator delete(block); };
  const auto plain_array = [](void* block) { ::operator delete[](block); };
  const auto sized = [](void* block) { ::operator delete(block, kSize); };
  const auto aligned = [](void* block) { ::operator delete(block, kAligned); };
  const auto aligned_array = [](void* block) { ::operator delete[](block, kAligned); };
  check([] { return ::operator new(kSize); }, plain, kDefault);
  check([] { return ::operator new(kSize); }, sized, kDefault);
  check([] { return ::operator new[](kSize); }, plain_array, kDefault);
  check([] { return ::operator new(kSize, kAligned); }, aligned, kLarge);
  check([] { return ::operator new[](kSize, kAligned); }, aligned_array, kLarge);
  check([] { return ::operator new(kSize, std::nothrow); }, plain, kDefault);
  check([] { return ::operator new[](kSize, std::nothrow); }, plain_array, kDefault);
  check([] { return ::operator new(kSize, kAligned, std::nothrow); }, aligned, kLarge);
  check([] { return ::operator new[](kSize, kAligned, std::nothrow); }, aligned_array, kLarge);
}

TEST_CASE("An operator new that gets no memory says so as its kind does") {
  const std::size_t before = bench::held_bytes();
  volatile std::size_t most = SIZE_MAX;  // not known to the compiler, which warns of such sizes
  CHECK(::operator new(most, std::nothrow) == nullptr);
  CHECK_THROWS_AS(static_cast<void>(::operator new(most)), std::bad_alloc);
  CHECK_THROWS_AS(static_cast<void>(::operator new(most, kAligned)), std::bad_alloc);
  CHECK(bench::held_bytes() == before);
}

}  // namespace
}  // namespace lobelight
