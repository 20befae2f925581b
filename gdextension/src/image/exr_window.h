#pragma once

#include <ImathBox.h>

#include <algorithm>
#include <cstdint>

namespace lobelight {

// Rows decoded at a time: a multiple of every compression's block of rows (1, 16, 32 or 256).
inline constexpr int kBandRows = 256;

// Pixel bounds, both ends included, wide enough for every difference of two ints.
struct Window {
  std::int64_t left, top, right, bottom;

  explicit Window(const Imath::Box2i& box)
      : left(box.min.x), top(box.min.y), right(box.max.x), bottom(box.max.y) {}

  std::int64_t width() const { return right - left + 1; }
  std::int64_t height() const { return bottom - top + 1; }
  std::int64_t texels() const { return width() * height(); }

  // Of windows that do meet.
  Window intersection(Window other) const {
    other.left = std::max(left, other.left);
    other.top = std::max(top, other.top);
    other.right = std::min(right, other.right);
    other.bottom = std::min(bottom, other.bottom);
    return other;
  }
};

}  // namespace lobelight
