#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/pi.h"
#include "fit/pyramid_kernel.h"
#include "image/cube_faces.h"
#include "image/pyramid.h"
#include "table/half_float.h"
#include "watched_progress.h"

namespace lobelight {
namespace {

using testing::kPrompt;
using testing::WatchedProgress;

using Radiance = std::function<double(const glm::dvec3&)>;

Panorama make_panorama(int width, const Radiance& radiance) {
  Panorama panorama{width, width / 2, {}};
  for (int row = 0; row < width / 2; ++row) {
    for (int column = 0; column < width; ++column) {
      const double value =
          radiance(panorama_direction({(column + 0.5) / width, (row + 0.5) / (width / 2)}));
      for (const double factor : {1.0, 2.0, 0.5}) {
        panorama.rgb.push_back(static_cast<float>(factor * value));
      }
    }
  }
  return panorama;
}

Radiance blob(const glm::dvec3& axis, double kappa) {
  return [=](const glm::dvec3& d) { return std::exp(kappa * (glm::dot(axis, d) - 1.0)); };
}

LightPyramid filter(const Panorama& panorama, const PyramidOptions& options) {
  Progress progress;
  return filter_panorama(panorama, options, progress);
}

PyramidOptions options_of(int size, bool is_gaussian, double base_variance = 0.0) {
  PyramidOptions options;
  options.size = size;
  options.is_gaussian = is_gaussian;
  options.base_variance = base_variance;
  options.samples = 2;
  options.threads = 2;
  return options;
}

// Calls `visit` with each texel of a level: its direction, its solid angle and its first channel.
void for_texels(const LightPyramid& pyramid, int level,
                const std::function<void(const glm::dvec3&, double, double)>& visit) {
  const int size = pyramid.size >> level;
  for (int face = 0; face < kCubeFaces; ++face) {
    const std::uint16_t* half =
        &pyramid.faces[static_cast<std::size_t>(face)][level_begin(pyramid.size, level)];
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column, half += 4) {
        const glm::dvec2 p = texel_middle(column, row, size);
        const double solid_angle = 4.0 / (size * size) * std::pow(1.0 + glm::dot(p, p), -1.5);
        visit(glm::normalize(face_direction(face, p)), solid_angle, double_from_half(*half));
      }
    }
  }
}

double mean_of(const LightPyramid& pyramid, int level) {
  double sum = 0.0, weights = 0.0;
  for_texels(pyramid, level, [&](const glm::dvec3&, double solid_angle, double value) {
    sum += solid_angle * value;
    weights += solid_angle;
  });
  return sum / weights;
}

struct Moments {
  double first, second;  // the variance along two axes across the light's
  double m_cubed;        // the mean of m³, m being the direction's largest component
};

Moments moments_of(const LightPyramid& pyramid, int level, const glm::dvec3& axis,
                   const glm::dvec3& first) {
  const glm::dvec3 second = glm::cross(axis, first);
  Moments sum{0.0, 0.0, 0.0};
  double weights = 0.0;
  for_texels(pyramid, level, [&](const glm::dvec3& d, double solid_angle, double value) {
    const double weight = solid_angle * value;
    // 2 (1 − cos) is the squared distance; where it goes say the components across the axis.
    const double x = glm::dot(d, first), y = glm::dot(d, second);
    const double squared = 2.0 - 2.0 * glm::dot(d, axis);
    const double across = std::max(x * x + y * y, 1e-12);
    sum.first += weight * squared * x * x / across;
    sum.second += weight * squared * y * y / across;
    const glm::dvec3 a = glm::abs(d);
    sum.m_cubed += weight * std::pow(std::max({a.x, a.y, a.z}), 3.0);
    weights += weight;
  });
  return {sum.first / weights, sum.second / weights, sum.m_cubed / weights};
}

}  // namespace

TEST_CASE("filter_panorama: a constant stays constant at every level") {
  for (const bool is_gaussian : {false, true}) {
    for (const double value : {0.01, 0.7, 64.0}) {
      const Panorama panorama = make_panorama(32, [=](const glm::dvec3&) { return value; });
      for (const double base : {0.0, 5.0 / 12.0}) {
        const LightPyramid pyramid = filter(panorama, options_of(16, is_gaussian, base));
        const std::uint16_t half = half_from_double(static_cast<double>(static_cast<float>(value)));
        bool is_constant = true;
        for (const auto& face : pyramid.faces) {
          CHECK(face.size() == 4 * (256 + 64 + 16 + 4 + 1));
          for (std::size_t n = 0; n < face.size(); n += 4) {
            is_constant = is_constant && face[n] == half && face[n + 3] == 0x3c00;
          }
        }
        CHECK(is_constant);
      }
    }
  }
}

TEST_CASE("filter_panorama: no level gains or loses light") {
  const auto lights = [](const glm::dvec3& d) {
    return 0.05 + 40.0 * blob({1, 0, 0}, 400)(d) +
           40.0 * blob(glm::normalize(glm::dvec3(1, 1, 0)), 400)(d) +
           40.0 * blob(glm::normalize(glm::dvec3(1, 1, 1)), 400)(d) +
           40.0 * blob(glm::normalize(glm::dvec3(-3, 1, 2)), 400)(d);
  };
  const double stated = 0.05 + 4 * 40.0 * (2.0 * kPi / 400.0) / (4.0 * kPi);
  for (const bool is_gaussian : {false, true}) {
    const LightPyramid pyramid =
        filter(make_panorama(256, lights), options_of(64, is_gaussian, 5.0 / 12.0));
    for (int level = 0; level < 6; ++level) {
      CAPTURE(level);
      CHECK(mean_of(pyramid, level) == doctest::Approx(stated).epsilon(0.015));
    }
  }
}

// The mean of the four texels around a corner of texels, and where that is.
double between_texels(const LightPyramid& pyramid, int level, int face, int column, int row,
                      glm::dvec3& direction) {
  const int size = pyramid.size >> level;
  direction = glm::normalize(
      face_direction(face, {(column + 1.0) * 2.0 / size - 1.0, (row + 1.0) * 2.0 / size - 1.0}));
  double sum = 0.0;
  for (int n = 0; n < 4; ++n) {
    const int texel = (row + n / 2) * size + column + n % 2;
    sum += double_from_half(pyramid.faces[static_cast<std::size_t>(
        face)][level_begin(pyramid.size, level) + 4 * static_cast<std::size_t>(texel)]);
  }
  return 0.25 * sum;
}

TEST_CASE("filter_panorama: coarse levels leave of simple light what lobes are fitted to") {
  const glm::dvec3 slope(0.3, -0.5, 0.2);
  const auto bend = [](const glm::dvec3& d) { return d.x * d.y + 0.5 * (d.z * d.z - d.x * d.x); };
  for (const int degree : {1, 2}) {
    const auto part = [&](const glm::dvec3& d) {
      return degree == 1 ? glm::dot(slope, d) : bend(d);
    };
    const LightPyramid pyramid =
        filter(make_panorama(128, [&](const glm::dvec3& d) { return 1.0 + part(d); }),
               options_of(128, false, 5.0 / 12.0));
    for (const int size : {8, 4}) {
      double product = 0.0, square = 0.0;
      for (int face = 0; face < kCubeFaces; ++face) {
        for (int row = 0; row + 1 < size; ++row) {
          for (int column = 0; column + 1 < size; ++column) {
            glm::dvec3 d;
            const int level = size == 8 ? 4 : 5;
            const double got = between_texels(pyramid, level, face, column, row, d) - 1.0;
            product += got * part(d);
            square += part(d) * part(d);
          }
        }
      }
      const DrawnHarmonics drawn = drawn_harmonics(4.0 / (size * size));
      CAPTURE(degree);
      CAPTURE(size);
      CHECK(product / square ==
            doctest::Approx(drawn[static_cast<std::size_t>(degree)]).epsilon(0.04));
    }
  }
}

TEST_CASE("filter_panorama: each level blurs by what it states, in every place and direction") {
  // Middles of faces and edges, corners, and places between.
  const glm::dvec3 places[] = {{0, 0, 1}, {1, 0, 0}, {1, 1, 0},     {0, 1, -1},     {-1, -1, 1},
                               {1, 1, 1}, {1, 2, 3}, {5, 0.3, 4.9}, {-0.6, 0.9, -1}};
  constexpr int kSize = 64;
  constexpr double kTexel = 4.0 / (kSize * kSize);
  constexpr double kVariance = 5.0 / 6.0;
  for (const bool is_gaussian : {false, true}) {
    for (const glm::dvec3& place : places) {
      const glm::dvec3 axis = glm::normalize(place);
      const glm::dvec3 across = glm::normalize(
          glm::cross(axis, std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
      const glm::dvec3 along = glm::cross(axis, across);
      const LightPyramid pyramid =
          filter(make_panorama(256, blob(axis, 80.0)), options_of(kSize, is_gaussian));
      for (const double angle : {0.0, 0.25 * kPi}) {
        const glm::dvec3 first = std::cos(angle) * across + std::sin(angle) * along;
        const Moments before = moments_of(pyramid, 0, axis, first);
        // Faces of 8 texels and fewer have discs of their own.
        for (int level = 1; level <= 2; ++level) {
          const double factor = std::pow(4.0, level) - 1.0;
          const double stated = kTexel * factor * (kVariance + (1.0 - before.m_cubed) / 6.0);
          const Moments after = moments_of(pyramid, level, axis, first);
          CAPTURE(is_gaussian);
          CAPTURE(place.x);
          CAPTURE(place.y);
          CAPTURE(place.z);
          CAPTURE(level);
          CHECK((after.first - before.first) / stated == doctest::Approx(1.0).epsilon(0.05));
          CHECK((after.second - before.second) / stated == doctest::Approx(1.0).epsilon(0.05));
        }
      }
    }
  }
}

TEST_CASE("filter_panorama: level 0 is blurred by its base variance") {
  constexpr int kSize = 64;
  constexpr double kTexel = 4.0 / (kSize * kSize);
  constexpr double kBase = 5.0 / 12.0;
  for (const bool is_gaussian : {false, true}) {
    for (const glm::dvec3& place :
         {glm::dvec3(0, 0, 1), glm::dvec3(1, 1, 0), glm::dvec3(1, 1, 1)}) {
      const glm::dvec3 axis = glm::normalize(place);
      const glm::dvec3 first = glm::normalize(glm::cross(axis, glm::dvec3(1, 2, -0.5)));
      const Panorama panorama = make_panorama(128, blob(axis, 200.0));
      const Moments sharp =
          moments_of(filter(panorama, options_of(kSize, is_gaussian)), 0, axis, first);
      const Moments blurred =
          moments_of(filter(panorama, options_of(kSize, is_gaussian, kBase)), 0, axis, first);
      // The mean over a texel, which the kernel stands for, is a box of 2 x 2 samples.
      const double box = kTexel * sharp.m_cubed / 12.0 * (1.0 - 0.25);
      const double stated = kTexel * (kBase + (1.0 - sharp.m_cubed) / 6.0) - box;
      CAPTURE(is_gaussian);
      CAPTURE(place.y);
      CHECK((blurred.first - sharp.first) / stated == doctest::Approx(1.0).epsilon(0.05));
      CHECK((blurred.second - sharp.second) / stated == doctest::Approx(1.0).epsilon(0.05));
    }
  }
}

TEST_CASE("filter_panorama: what is no light is dark, what is too bright the largest half") {
  Panorama panorama = make_panorama(16, [](const glm::dvec3&) { return 1e6; });
  PyramidOptions options = options_of(4, false);
  CHECK(filter(panorama, options).faces[2][0] == 0x7bff);
  for (const float bad : {NAN, INFINITY, -INFINITY, -2.0f}) {
    panorama.rgb.assign(panorama.rgb.size(), bad);
    CHECK(filter(panorama, options).faces[0][0] == 0);
  }
}

TEST_CASE("filter_panorama: pictures in sRGB are decoded") {
  Panorama panorama{4, 2, {}};
  for (int n = 0; n < 8; ++n) {
    panorama.rgb.insert(panorama.rgb.end(), {128 / 255.0f, 64 / 255.0f, 1.0f});
  }
  PyramidOptions options = options_of(4, false);
  options.is_srgb = true;
  const LightPyramid pyramid = filter(panorama, options);
  // IEC 61966-2-1: 128/255 is 0.2158605, 64/255 is 0.0512695.
  CHECK(pyramid.faces[3][0] == half_from_double(0.2158605));
  CHECK(pyramid.faces[3][1] == half_from_double(0.0512695));
  CHECK(pyramid.faces[3][2] == half_from_double(1.0));
}

TEST_CASE("filter_panorama: the light does not depend on the threads") {
  const Panorama panorama = make_panorama(64, blob(glm::normalize(glm::dvec3(1, 2, -2)), 30.0));
  for (const bool is_gaussian : {false, true}) {
    PyramidOptions options = options_of(32, is_gaussian, 5.0 / 12.0);
    options.threads = 1;
    const LightPyramid one = filter(panorama, options);
    for (const int threads : {2, 7}) {
      options.threads = threads;
      CHECK(filter(panorama, options).faces == one.faces);
    }
  }
}

TEST_CASE("filter_panorama: progress grows to the end, and cancel is heard") {
  const Panorama panorama = make_panorama(64, blob({0, 0, 1}, 30.0));
  PyramidOptions options = options_of(64, false, 5.0 / 12.0);
  options.threads = 1;
  WatchedProgress whole;
  filter_panorama(panorama, options, whole);
  CHECK(whole.fraction() == doctest::Approx(1.0));
  CHECK(whole.longest_gap() < kPrompt);
  for (const long at : {0L, whole.checks() / 2, whole.checks() - 1}) {
    WatchedProgress stopped(at);
    CHECK_THROWS_AS(filter_panorama(panorama, options, stopped), Cancelled);
  }
}

TEST_CASE("filter_panorama refuses options that cannot be meant") {
  const auto refusal = [](const std::function<void(PyramidOptions&)>& spoil) {
    PyramidOptions options;
    spoil(options);
    try {
      validate(options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refusal([](PyramidOptions& o) { o.size = 48; }) ==
        "size is 48, but must be a power of two from 1 to 2048.");
  CHECK(refusal([](PyramidOptions& o) { o.size = 4096; }) ==
        "size is 4096, but must be a power of two from 1 to 2048.");
  CHECK(refusal([](PyramidOptions& o) { o.samples = 0; }) ==
        "samples is 0, but must be from 1 to 64.");
  CHECK(refusal([](PyramidOptions& o) { o.base_variance = NAN; }) ==
        "base_variance must be from 0 to 16.");
  CHECK(refusal([](PyramidOptions& o) { o.level_variance = 0.0; }) ==
        "level_variance must be from 0.1 to 16.");
}

}  // namespace lobelight
