#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <vector>

namespace lobelight {

// Packed arrays of the engine's. Where it has no memory for one it leaves the array as it was; here
// that throws std::bad_alloc. `Packed` is a parameter so that this can be tested without an engine.

// One of `size` elements.
template <class Packed>
Packed sized(std::size_t size) {
  const auto wanted = static_cast<std::int64_t>(size);
  Packed packed;
  packed.resize(wanted);
  if (packed.size() != wanted) throw std::bad_alloc();
  return packed;
}

// One with these numbers.
template <class Packed, class Element>
Packed pack(const std::vector<Element>& values) {
  Packed packed = sized<Packed>(values.size());
  auto* target = packed.ptrw();
  using Target = std::remove_pointer_t<decltype(target)>;
  std::transform(values.begin(), values.end(), target,
                 [](Element value) { return static_cast<Target>(value); });
  return packed;
}

}  // namespace lobelight
