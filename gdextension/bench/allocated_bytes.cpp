#include "allocated_bytes.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace lobelight::bench {

namespace {

std::atomic<std::size_t> held{0};
std::atomic<std::size_t> peak{0};
thread_local int until_failure = -1;

// Each block carries its size and where it began in front of it.
struct Header {
  std::size_t size;
  void* begin;
};

void* allocate(std::size_t size, std::size_t alignment) {
  if (until_failure >= 0 && until_failure-- == 0) throw std::bad_alloc();
  if (alignment < alignof(Header)) alignment = alignof(Header);
  void* begin = std::malloc(size + alignment + sizeof(Header));
  if (begin == nullptr) throw std::bad_alloc();
  const auto after_header = reinterpret_cast<std::size_t>(begin) + sizeof(Header);
  const std::size_t place = (after_header + alignment - 1) / alignment * alignment;
  auto* const block = reinterpret_cast<std::byte*>(place);
  ::new (block - sizeof(Header)) Header{size, begin};
  const std::size_t now = held += size;
  std::size_t before = peak;
  while (now > before && !peak.compare_exchange_weak(before, now)) {
  }
  return block;
}

void release(void* block) noexcept {
  if (block == nullptr) return;
  const Header header = *reinterpret_cast<Header*>(static_cast<std::byte*>(block) - sizeof(Header));
  held -= header.size;
  std::free(header.begin);
}

}  // namespace

void reset_peak_bytes() { peak = held.load(); }
std::size_t held_bytes() { return held; }
std::size_t peak_bytes() { return peak; }

bool fail_allocation(int n) {
  const bool was_to_come = until_failure >= 0;
  until_failure = n;
  return was_to_come;
}

}  // namespace lobelight::bench

using lobelight::bench::allocate;
using lobelight::bench::release;

void* operator new(std::size_t size) { return allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new[](std::size_t size) { return allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { release(block); }
void operator delete[](void* block) noexcept { release(block); }
void operator delete(void* block, std::size_t) noexcept { release(block); }
void operator delete[](void* block, std::size_t) noexcept { release(block); }
void operator delete(void* block, std::align_val_t) noexcept { release(block); }
void operator delete[](void* block, std::align_val_t) noexcept { release(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { release(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { release(block); }
