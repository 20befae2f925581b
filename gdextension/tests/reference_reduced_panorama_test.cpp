#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/pi.h"
#include "reference/reduced_panorama.h"

namespace lobelight {

namespace {

// ∫ L over the sphere, texels being constant.
glm::dvec3 all_light(const Panorama& panorama) {
  glm::dvec3 sum(0.0);
  std::size_t n = 0;
  for (int row = 0; row < panorama.height; ++row) {
    const double area =
        2.0 * kPi / panorama.width *
        (std::cos(kPi * row / panorama.height) - std::cos(kPi * (row + 1) / panorama.height));
    for (int column = 0; column < panorama.width; ++column, n += 3) {
      sum += area * glm::dvec3(panorama.rgb[n], panorama.rgb[n + 1], panorama.rgb[n + 2]);
    }
  }
  return sum;
}

Panorama uneven(int width, int height) {
  Panorama panorama{width, height, {}};
  for (int n = 0; n < 3 * width * height; ++n) {
    panorama.rgb.push_back(1.0f + std::sin(0.37f * static_cast<float>(n)));
  }
  panorama.rgb[static_cast<std::size_t>(3 * width * height / 3)] = 5e4f;
  return panorama;
}

}  // namespace

TEST_CASE("a reduced panorama has all of the light, in every channel") {
  // Whole boxes, boxes that cut texels, and one axis alone.
  const glm::ivec2 wanted[] = {{20, 10}, {13, 7}, {40, 3}, {1, 1}, {9, 100}};
  const Panorama panorama = uneven(40, 20);
  const glm::dvec3 before = all_light(panorama);
  for (const glm::ivec2& size : wanted) {
    const Panorama reduced = reduce_panorama(panorama, size.x, size.y);
    CAPTURE(size.x);
    CHECK(reduced.width == std::min(size.x, 40));
    CHECK(reduced.height == std::min(size.y, 20));
    REQUIRE(reduced.rgb.size() == 3u * static_cast<unsigned>(reduced.width * reduced.height));
    const glm::dvec3 after = all_light(reduced);
    for (int channel = 0; channel < 3; ++channel) {
      CHECK(after[channel] == doctest::Approx(before[channel]).epsilon(1e-6));
    }
  }
}

TEST_CASE("light stays where it was") {
  Panorama panorama{64, 32, std::vector<float>(3 * 64 * 32, 0.0f)};
  panorama.rgb[3 * (9 * 64 + 50) + 1] = 8.0f;
  const Panorama reduced = reduce_panorama(panorama, 16, 8);
  for (std::size_t n = 0; n < reduced.rgb.size(); ++n) {
    const bool is_there = n == 3 * (9 / 4 * 16 + 50 / 4) + 1;
    CHECK((reduced.rgb[n] > 0.0f) == is_there);
  }
}

TEST_CASE("a panorama that is small enough stays as it is") {
  const Panorama panorama = uneven(8, 4);
  CHECK(reduce_panorama(panorama, 8, 4).rgb == panorama.rgb);
  CHECK(reduce_panorama(panorama, 100, 50).width == 8);
}

TEST_CASE("a cancelled reduction ends") {
  const Panorama panorama = uneven(8, 4);
  Progress progress;
  progress.cancel();
  CHECK_THROWS_AS(reduce_panorama(panorama, 1, 1, &progress), Cancelled);
}

}  // namespace lobelight
