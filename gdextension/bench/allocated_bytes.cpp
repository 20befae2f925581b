#include "allocated_bytes.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
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

// The block ends where malloc's does, for the alignments that malloc has: sanitizers see what is
// written behind it. Null if there is no memory.
void* allocate_or_null(std::size_t size, std::size_t alignment) noexcept {
  if (until_failure >= 0 && until_failure-- == 0) return nullptr;
  const std::size_t padding = alignment <= alignof(std::max_align_t) ? 0 : alignment;
  const std::size_t extra = padding + sizeof(Header);
  void* begin = size <= SIZE_MAX - extra ? std::malloc(size + extra) : nullptr;
  if (begin == nullptr) return nullptr;
  auto place = reinterpret_cast<std::size_t>(begin) + sizeof(Header);
  if (padding != 0) place = (place + alignment - 1) / alignment * alignment;
  auto* const block = reinterpret_cast<std::byte*>(place);
  ::new (block - sizeof(Header)) Header{size, begin};
  const std::size_t now = held += size;
  std::size_t before = peak;
  while (now > before && !peak.compare_exchange_weak(before, now)) {
  }
  return block;
}

void* allocate(std::size_t size, std::size_t alignment) {
  void* const block = allocate_or_null(size, alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void release(void* block) noexcept {
  if (block == nullptr) return;
  const Header header = *reinterpret_cast<Header*>(static_cast<std::byte*>(block) - sizeof(Header));
  held -= header.size;
  std::free(header.begin);
}

constexpr std::size_t kPlain = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

std::size_t bytes(std::align_val_t alignment) { return static_cast<std::size_t>(alignment); }

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

// All of them: where sanitizers bring an operator of their own, its blocks would be released here.
using namespace lobelight::bench;
using std::align_val_t;
using std::nothrow_t;
using std::size_t;

void* operator new(size_t size) { return allocate(size, kPlain); }
void* operator new[](size_t size) { return allocate(size, kPlain); }
void* operator new(size_t size, align_val_t to) { return allocate(size, bytes(to)); }
void* operator new[](size_t size, align_val_t to) { return allocate(size, bytes(to)); }
void* operator new(size_t size, const nothrow_t&) noexcept {
  return allocate_or_null(size, kPlain);
}
void* operator new[](size_t size, const nothrow_t&) noexcept {
  return allocate_or_null(size, kPlain);
}
void* operator new(size_t size, align_val_t to, const nothrow_t&) noexcept {
  return allocate_or_null(size, bytes(to));
}
void* operator new[](size_t size, align_val_t to, const nothrow_t&) noexcept {
  return allocate_or_null(size, bytes(to));
}
void operator delete(void* block) noexcept { release(block); }
void operator delete[](void* block) noexcept { release(block); }
void operator delete(void* block, size_t) noexcept { release(block); }
void operator delete[](void* block, size_t) noexcept { release(block); }
void operator delete(void* block, align_val_t) noexcept { release(block); }
void operator delete[](void* block, align_val_t) noexcept { release(block); }
void operator delete(void* block, size_t, align_val_t) noexcept { release(block); }
void operator delete[](void* block, size_t, align_val_t) noexcept { release(block); }
void operator delete(void* block, const nothrow_t&) noexcept { release(block); }
void operator delete[](void* block, const nothrow_t&) noexcept { release(block); }
void operator delete(void* block, align_val_t, const nothrow_t&) noexcept { release(block); }
void operator delete[](void* block, align_val_t, const nothrow_t&) noexcept { release(block); }
