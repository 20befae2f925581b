#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "image/synthetic_panorama.h"
#include "reference/sphere_renderer.h"
#include "reference/surface_renderer.h"

namespace lobelight {
namespace {

constexpr int kSize = 24;
constexpr int kSamples = 64;

bool is_orthonormal(const SurfaceFrame& frame) {
  const double tolerance = 1e-14;
  const auto near = [&](double a, double b) { return std::abs(a - b) < tolerance; };
  return near(glm::length(frame.tangent), 1.0) && near(glm::length(frame.normal), 1.0) &&
         near(glm::dot(frame.tangent, frame.normal), 0.0) &&
         glm::length(glm::cross(frame.normal, frame.tangent) - frame.bitangent) < tolerance;
}

}  // namespace

TEST_CASE("frame_about: orthonormal, the normal kept, the tangent in the plane of both") {
  const glm::dvec3 normal(0.3, 2.0, -0.4);
  const glm::dvec3 tangent(5.0, 0.1, 1.0);
  const auto frame = frame_about(normal, tangent);
  REQUIRE(frame);
  CHECK(is_orthonormal(*frame));
  CHECK(glm::length(frame->normal - glm::normalize(normal)) < 1e-14);
  CHECK(glm::dot(frame->tangent, tangent) > 0.0);
  CHECK(std::abs(glm::dot(frame->bitangent, tangent)) < 1e-14);
}

TEST_CASE("frame_about: nothing where there is no frame") {
  const glm::dvec3 x(1.0, 0.0, 0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK_FALSE(frame_about({}, x));
  CHECK_FALSE(frame_about(x, {}));
  CHECK_FALSE(frame_about(x, -3.0 * x));
  CHECK_FALSE(frame_about({nan, 0.0, 1.0}, x));
  CHECK_FALSE(frame_about({0.0, infinity, 1.0}, x));
}

TEST_CASE(
    "render_surface: a turned sphere under the turned view is the sphere under turned light") {
  // A quarter turn about y is a quarter of the panorama's columns, so that both are exact. The
  // tangents turn with the rest.
  const Panorama panorama = synthetic_panorama();
  Panorama turned = panorama;
  for (int row = 0; row < panorama.height; ++row) {
    for (int column = 0; column < 3 * panorama.width; ++column) {
      const int from = (column + 3 * panorama.width / 4) % (3 * panorama.width);
      turned.rgb[static_cast<std::size_t>(row * 3 * panorama.width + column)] =
          panorama.rgb[static_cast<std::size_t>(row * 3 * panorama.width + from)];
    }
  }
  // Of u = fract(atan2(x, −z)/2π): what is at u + 1/4 comes to u, so (x, y, z) becomes (z, y, −x).
  const auto turn = [](const glm::dvec3& v) { return glm::dvec3(v.z, v.y, -v.x); };
  const auto brdf = make_brdf("ggx", {0.2, 0.5});
  const SurfaceOptions options{kSize, kSize, 4096, 3, 0};
  Progress progress;
  const auto straight = [](int column, int row) { return sphere_frame(column, row, kSize); };
  const auto round = [&](int column, int row) -> std::optional<SurfaceFrame> {
    const auto frame = sphere_frame(column, row, kSize);
    if (!frame) return std::nullopt;
    return SurfaceFrame{turn(frame->tangent), turn(frame->bitangent), turn(frame->normal)};
  };
  const glm::dvec3 view(0.0, 0.0, 1.0);
  const auto one = render_surface(panorama, *brdf, view, straight, options, progress);
  const auto other = render_surface(turned, *brdf, turn(view), round, options, progress);
  const auto wrong = render_surface(turned, *brdf, view, straight, options, progress);
  double sum = 0.0;
  double difference = 0.0;
  double unlike = 0.0;
  for (std::size_t i = 0; i < one.radiance.size(); ++i) {
    sum += one.radiance[i];
    difference += std::abs(one.radiance[i] - other.radiance[i]);
    unlike += std::abs(one.radiance[i] - wrong.radiance[i]);
  }
  CHECK(sum > 0.0);
  CHECK(difference < 0.02 * sum);
  CHECK(unlike > 0.2 * sum);
}

TEST_CASE("render_surface: frames of the sphere give the sphere's picture, nothing elsewhere") {
  const Panorama panorama = synthetic_panorama();
  const auto brdf = make_brdf("ward", {0.1, 0.3});
  Progress progress;
  const SphereImage sphere = render_sphere(panorama, *brdf, {kSize, kSamples, 9, 0}, progress);
  // With a strip of nothing below it.
  const auto surface = [](int column, int row) {
    return row < kSize ? sphere_frame(column, row, kSize) : std::nullopt;
  };
  const SurfaceImage image = render_surface(panorama, *brdf, {0.0, 0.0, 1.0}, surface,
                                            {kSize, kSize + 3, kSamples, 9, 1}, progress);
  REQUIRE(image.radiance.size() == static_cast<std::size_t>(3 * kSize * (kSize + 3)));
  bool equal = true;
  for (std::size_t i = 0; i < image.radiance.size(); ++i) {
    const float wanted = i < sphere.radiance.size() ? sphere.radiance[i] : 0.0f;
    equal = equal && image.radiance[i] == wanted;
  }
  CHECK(equal);
}

TEST_CASE("render_surface: refuses a picture without pixels") {
  const Panorama panorama = synthetic_panorama();
  const auto brdf = make_brdf("ward", {0.1, 0.1});
  Progress progress;
  const auto nothing = [](int, int) { return std::optional<SurfaceFrame>(); };
  CHECK_THROWS_AS(
      render_surface(panorama, *brdf, {0.0, 0.0, 1.0}, nothing, {0, 4, kSamples, 0, 0}, progress),
      std::invalid_argument);
}

}  // namespace lobelight
