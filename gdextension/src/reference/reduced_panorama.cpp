#include "reference/reduced_panorama.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "base/pi.h"

namespace lobelight {

namespace {

// The part of an axis of `count` texels that lies in number `n` of `parts` equal parts.
struct Span {
  int first;
  int last;     // inclusive
  double from;  // in texels
  double to;
};

Span span_of(int n, int parts, int count) {
  const double from = static_cast<double>(n) * count / parts;
  const double to = static_cast<double>(n + 1) * count / parts;
  const int first = std::min(static_cast<int>(from), count - 1);
  return {first, std::clamp(static_cast<int>(std::ceil(to)) - 1, first, count - 1), from, to};
}

}  // namespace

Panorama reduce_panorama(Panorama panorama, int width, int height, const Progress* progress) {
  if (panorama.width <= width && panorama.height <= height) return panorama;
  Panorama reduced;
  reduced.width = std::min(panorama.width, width);
  reduced.height = std::min(panorama.height, height);
  reduced.rgb.reserve(3 * static_cast<std::size_t>(reduced.width) *
                      static_cast<std::size_t>(reduced.height));
  const auto stride = static_cast<std::size_t>(panorama.width);
  std::vector<glm::dvec3> row(static_cast<std::size_t>(reduced.width));
  for (int r = 0; r < reduced.height; ++r) {
    const Span rows = span_of(r, reduced.height, panorama.height);
    std::fill(row.begin(), row.end(), glm::dvec3(0.0));
    double mass = 0.0;
    for (int y = rows.first; y <= rows.last; ++y) {
      throw_if_cancelled(progress);
      // ∫ sin θ dθ over what of the row lies in the span.
      const double top = kPi * std::max(rows.from, static_cast<double>(y)) / panorama.height;
      const double end = kPi * std::min(rows.to, y + 1.0) / panorama.height;
      const double share = std::cos(top) - std::cos(end);
      mass += share;
      for (int c = 0; c < reduced.width; ++c) {
        const Span columns = span_of(c, reduced.width, panorama.width);
        glm::dvec3 sum(0.0);
        for (int x = columns.first; x <= columns.last; ++x) {
          const double part =
              std::min(columns.to, x + 1.0) - std::max(columns.from, static_cast<double>(x));
          const float* texel =
              &panorama
                   .rgb[3 * (static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x))];
          sum += part * glm::dvec3(texel[0], texel[1], texel[2]);
        }
        row[static_cast<std::size_t>(c)] += share / (columns.to - columns.from) * sum;
      }
    }
    for (const glm::dvec3& sum : row) {
      for (int channel = 0; channel < 3; ++channel) {
        reduced.rgb.push_back(static_cast<float>(sum[channel] / mass));
      }
    }
  }
  return reduced;
}

}  // namespace lobelight
