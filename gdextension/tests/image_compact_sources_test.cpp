#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "base/pi.h"
#include "image/compact_sources.h"
#include "image/panorama_faces.h"

namespace lobelight {
namespace {

constexpr double kDegree = kPi / 180.0;
constexpr double kSun = 1e6;

using Radiance = std::function<double(const glm::dvec3&)>;

// Warm light: its channels differ.
Panorama make_panorama(int width, const Radiance& radiance) {
  Panorama panorama{width, width / 2, {}};
  for (int row = 0; row < width / 2; ++row) {
    for (int column = 0; column < width; ++column) {
      const double value =
          radiance(panorama_direction({(column + 0.5) / width, (row + 0.5) / (width / 2)}));
      for (const double factor : {1.2, 1.0, 0.8}) {
        panorama.rgb.push_back(static_cast<float>(factor * value));
      }
    }
  }
  return panorama;
}

double sky(const glm::dvec3& d) { return 1.0 + 0.5 * d.y; }

void set(Panorama& panorama, int column, int row, double value) {
  const int x = (column + panorama.width) % panorama.width;
  const auto at = 3 * static_cast<std::size_t>(row * panorama.width + x);
  for (std::size_t c = 0; c < 3; ++c) panorama.rgb[at + c] = static_cast<float>(value);
}

glm::dvec3 integral(const Panorama& panorama) {
  glm::dvec3 sum(0.0);
  std::size_t at = 0;
  for (int row = 0; row < panorama.height; ++row) {
    const double solid_angle =
        2.0 * kPi / panorama.width *
        (std::cos(kPi * row / panorama.height) - std::cos(kPi * (row + 1) / panorama.height));
    for (int column = 0; column < panorama.width; ++column) {
      for (int c = 0; c < 3; ++c) sum[c] += solid_angle * static_cast<double>(panorama.rgb[at++]);
    }
  }
  return sum;
}

std::vector<CompactSource> take(Panorama& panorama, int most = kMaxSources, int threads = 2) {
  Progress progress;
  return take_sources(panorama, most, threads, progress);
}

void check_energy(const Panorama& before, const Panorama& after,
                  const std::vector<CompactSource>& sources) {
  const glm::dvec3 all = integral(before);
  glm::dvec3 parts = integral(after);
  for (const CompactSource& source : sources) parts += source.energy;
  for (int c = 0; c < 3; ++c) CHECK(parts[c] == doctest::Approx(all[c]).epsilon(1e-6));
}

double brightest(const Panorama& panorama) {
  return static_cast<double>(*std::max_element(panorama.rgb.begin(), panorama.rgb.end()));
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  return 2.0 * std::asin(0.5 * glm::length(a - b)) / kDegree;
}

TEST_CASE("a sun of 10^6 over four texels is taken out wherever it is") {
  struct Place {
    int column, row;
    glm::dvec2 middle;  // u, v
  };
  for (const int width : {256, 1024}) {
    const int height = width / 2;
    const double w = width, h = height;
    const Place places[] = {{width / 3, height / 3, {(width / 3 + 1) / w, (height / 3 + 1) / h}},
                            {-1, height / 2, {0.0, (height / 2 + 1) / h}},
                            {width / 2, height * 4 / 5, {0.5 + 1 / w, (height * 4 / 5 + 1) / h}},
                            {7, 0, {8 / w, 1 / h}}};
    for (const Place& place : places) {
      CAPTURE(width);
      CAPTURE(place.row);
      const bool is_at_pole = place.row == 0;
      Panorama panorama = make_panorama(width, sky);
      for (int k = 0; k < 4; ++k) {
        set(panorama, place.column + k % 2, place.row + k / 2, kSun);
      }
      const Panorama before = panorama;
      const std::vector<CompactSource> sources = take(panorama);
      REQUIRE(sources.size() == 1);
      check_energy(before, panorama, sources);
      CHECK(brightest(panorama) < 25.0);
      const double texel = kPi / height;
      CHECK(degrees_between(sources[0].direction, panorama_direction(place.middle)) <
            (is_at_pole ? 0.5 : 0.02) * texel / kDegree);
      if (is_at_pole) continue;
      const double sine = std::hypot(sources[0].direction.x, sources[0].direction.z);
      CHECK(sources[0].energy.y ==
            doctest::Approx(4.0 * kSun * texel * texel * sine).epsilon(1e-3));
      // Two texels and the tent between texels: 1/4 and 1/6 of a texel squared.
      const double variance = (0.25 + 1.0 / 6.0) * texel * texel * 0.5 * (1.0 + sine * sine);
      CHECK(sources[0].deviation == doctest::Approx(std::sqrt(variance)).epsilon(0.01));
    }
  }
}

TEST_CASE("a sun right on a pole is one source") {
  Panorama panorama = make_panorama(256, sky);
  for (int column = 0; column < 256; ++column) {
    set(panorama, column, 127, kSun);
  }
  const Panorama before = panorama;
  const std::vector<CompactSource> sources = take(panorama);
  REQUIRE(sources.size() == 1);
  check_energy(before, panorama, sources);
  CHECK(degrees_between(sources[0].direction, {0.0, -1.0, 0.0}) < 0.01);
}

TEST_CASE("lamps that stand close are sources of their own, the brightest first") {
  const glm::dvec3 first = panorama_direction({0.3, 0.4});
  const glm::dvec3 second = panorama_direction({0.3, 0.4 + 3.0 / 180.0});
  Panorama panorama = make_panorama(1024, [&](const glm::dvec3& d) {
    if (degrees_between(d, first) < 1.0) return 2000.0;
    return degrees_between(d, second) < 0.7 ? 3000.0 : sky(d);
  });
  const Panorama before = panorama;
  const std::vector<CompactSource> sources = take(panorama);
  REQUIRE(sources.size() == 2);
  check_energy(before, panorama, sources);
  CHECK(degrees_between(sources[0].direction, second) < 0.1);
  CHECK(degrees_between(sources[1].direction, first) < 0.1);
  // A disc's variance per axis is a quarter of its squared radius.
  CHECK(sources[0].deviation / kDegree == doctest::Approx(0.35).epsilon(0.1));
  CHECK(sources[1].deviation / kDegree == doctest::Approx(0.5).epsilon(0.1));
  CHECK(brightest(panorama) < 3.0);
}

TEST_CASE("of a sun in a wide halo the core alone is taken, and as many as are asked for") {
  const glm::dvec3 sun = panorama_direction({0.6, 0.3});
  const auto radiance = [&](const glm::dvec3& d) {
    const double angle = degrees_between(d, sun);
    return angle < 0.3 ? 1e5 : sky(d) + 400.0 * std::exp(-angle / 3.0);
  };
  Panorama panorama = make_panorama(1024, radiance);
  const Panorama before = panorama;
  const std::vector<CompactSource> sources = take(panorama);
  REQUIRE(sources.size() == 1);
  check_energy(before, panorama, sources);
  CHECK(sources[0].deviation / kDegree < 0.25);
  // What is left is the halo, and no hole in it.
  std::size_t dark = 0;
  for (std::size_t i = 0; i < panorama.rgb.size(); i += 3) {
    const bool was_halo = before.rgb[i + 1] > 300.0f;
    dark += was_halo && panorama.rgb[i + 1] < 0.5f * std::min(before.rgb[i + 1], 400.0f) ? 1 : 0;
  }
  CHECK(dark == 0);

  Panorama kept = before;
  CHECK(take(kept, 0).empty());
  CHECK(kept.rgb == before.rgb);
}

TEST_CASE("windows, noise and light from all sides have no sources and stay as they are") {
  std::uint32_t state = 1;
  const Radiance maps[] = {
      [](const glm::dvec3&) { return 1.0; },
      [](const glm::dvec3&) { return 0.0; },
      sky,
      // A window of 16 by 16 degrees.
      [](const glm::dvec3& d) {
        return std::abs(d.x) < 0.14 && std::abs(d.y - 0.2) < 0.14 && d.z < 0.0 ? 1000.0 : 1.0;
      },
      // A long lamp.
      [](const glm::dvec3& d) { return std::abs(d.x) < 0.01 && d.y > 0.7 ? 1000.0 : 1.0; },
      // A wide glow.
      [](const glm::dvec3& d) { return 1.0 + 1e4 * std::exp(30.0 * (d.x - 1.0)); },
      // Each texel on its own, over three decades, and a few far above.
      [&](const glm::dvec3&) {
        state = state * 1664525u + 1013904223u;
        return std::pow(10.0, 3.0 * (state >> 8) / 16777216.0);
      },
  };
  for (const Radiance& radiance : maps) {
    Panorama panorama = make_panorama(256, radiance);
    const Panorama before = panorama;
    CHECK(take(panorama).empty());
    CHECK(panorama.rgb == before.rgb);
  }
}

TEST_CASE("a lamp counts from 2 % of the light on") {
  const glm::dvec3 lamp = panorama_direction({0.3, 0.4});
  for (const double share : {0.018, 0.022}) {
    const double solid_angle = 2.0 * kPi * (1.0 - std::cos(0.8 * kDegree));
    const double value = share * 4.0 * kPi / (solid_angle * (1.0 - share));
    Panorama panorama = make_panorama(2048, [&](const glm::dvec3& d) {
      return degrees_between(d, lamp) < 0.8 ? value + 1.5 : 1.0;
    });
    CHECK(take(panorama).size() == (share > 0.02 ? 1 : 0));
  }
}

TEST_CASE("what is no light is none in sources, and threads change nothing") {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  Panorama panorama = make_panorama(256, sky);
  for (int k = 0; k < 4; ++k) set(panorama, 60 + k % 2, 40 + k / 2, kSun);
  const std::size_t near = 3 * (44 * 256 + 62);
  panorama.rgb[near] = kNone;
  panorama.rgb[near + 4] = -1e6f;
  panorama.rgb[near + 8] = std::numeric_limits<float>::infinity();
  Panorama other = panorama;
  const std::vector<CompactSource> sources = take(panorama, kMaxSources, 1);
  REQUIRE(sources.size() == 1);
  CHECK(std::isfinite(sources[0].energy.x));
  const std::vector<CompactSource> again = take(other, kMaxSources, 5);
  CHECK(source_texels(sources) == source_texels(again));
}

TEST_CASE("texels of sources hold what they are, and directions with more than single precision") {
  const CompactSource source{panorama_direction({0.123, 0.456}), 0.01, {3.0, 2.0, 1.0}};
  const std::vector<float> texels = source_texels({source});
  REQUIRE(texels.size() == 48);
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(axis);
    const double whole =
        static_cast<double>(texels[at]) + static_cast<double>(texels[32 + at]) / 1024.0;
    CHECK(std::abs(whole - source.direction[axis]) < 1e-12);
    CHECK(static_cast<double>(texels[16 + at]) == source.energy[axis]);
  }
  CHECK(texels[3] == 0.01f);
  CHECK(std::all_of(texels.begin() + 4, texels.begin() + 16, [](float t) { return t == 0.0f; }));
}

TEST_CASE("a sky shows a direction where its approximate angles have it") {
  // Its sampler finds the light there again.
  const glm::dvec3 lamp = panorama_direction({0.3, 0.2});
  const Panorama panorama = make_panorama(
      1024, [&](const glm::dvec3& d) { return degrees_between(d, lamp) < 0.5 ? 100.0 : 0.0; });
  const PanoramaLight light(panorama, false, true);
  glm::dvec3 sum(0.0);
  for (int row = 0; row < 1024; ++row) {
    for (int column = 0; column < 2048; ++column) {
      const glm::dvec3 d = panorama_direction({(column + 0.5) / 2048, (row + 0.5) / 1024});
      if (degrees_between(d, lamp) < 2.0) sum += light.sample(d).y * d;
    }
  }
  CHECK(degrees_between(glm::normalize(sum), sky_direction(lamp)) < 0.05);
  CHECK(degrees_between(lamp, sky_direction(lamp)) > 0.1);
}

}  // namespace
}  // namespace lobelight
