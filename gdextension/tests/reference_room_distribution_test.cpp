#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>

#include "base/pi.h"
#include "brdf/brdf.h"
#include "reference/integrator.h"
#include "reference/room_distribution.h"
#include "reference/sphere_renderer.h"

namespace lobelight {
namespace {

const glm::dvec3 kSize(6.0, 3.0, 8.0);

Room constant_room(float value) {
  Room room;
  room.size = kSize;
  for (Panorama& wall : room.walls) wall = {3, 2, std::vector<float>(18, value)};
  return room;
}

// Random texels over several orders of magnitude; walls of different sizes, a lamp on two of them.
Room rough_room() {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform;
  Room room;
  room.size = kSize;
  for (std::size_t w = 0; w < kWalls; ++w) {
    Panorama& wall = room.walls[w];
    wall.width = 5 + static_cast<int>(w);
    wall.height = 9 - static_cast<int>(w);
    for (int k = 0; k < 3 * wall.width * wall.height; ++k) {
      wall.rgb.push_back(0.1f + std::pow(uniform(random), 8.0f));
    }
  }
  room.walls[2].rgb[3 * 17] = 80.0f;
  room.walls[5].rgb[1] = 60.0f;
  return room;
}

SurfaceFrame oblique_frame(const glm::dvec3& point) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.5, 0.6));
  const glm::dvec3 tangent = glm::normalize(glm::cross(glm::dvec3(0, 1, 0.2), normal));
  return {tangent, glm::cross(normal, tangent), normal, point};
}

// The radiance of a wall at a point q by the contract's words, without a line of the integrator's.
glm::dvec3 radiance_at(const Room& room, const glm::dvec3& q) {
  const glm::dvec3 d = q / (0.5 * room.size);
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(d[k]) > std::abs(d[axis])) axis = k;
  }
  const bool is_positive = d[axis] > 0.0;
  glm::dvec2 st;
  if (axis == 0) st = is_positive ? glm::dvec2(-d.z, -d.y) : glm::dvec2(d.z, -d.y);
  if (axis == 1) st = is_positive ? glm::dvec2(d.x, d.z) : glm::dvec2(d.x, -d.z);
  if (axis == 2) st = is_positive ? glm::dvec2(d.x, -d.y) : glm::dvec2(-d.x, -d.y);
  const Panorama& wall = room.walls[static_cast<std::size_t>(2 * axis + (is_positive ? 0 : 1))];
  glm::dvec3 sum(0.0);
  for (int row = 0; row < wall.height; ++row) {
    for (int column = 0; column < wall.width; ++column) {
      const double x = std::min(std::max(0.5 * (st.x + 1.0) * wall.width, 0.5), wall.width - 0.5);
      const double y = std::min(std::max(0.5 * (st.y + 1.0) * wall.height, 0.5), wall.height - 0.5);
      const double weight = std::max(0.0, 1.0 - std::abs(x - column - 0.5)) *
                            std::max(0.0, 1.0 - std::abs(y - row - 0.5));
      const float* rgb = &wall.rgb[static_cast<std::size_t>(3 * (row * wall.width + column))];
      sum += weight * glm::dvec3(rgb[0], rgb[1], rgb[2]);
    }
  }
  return sum;
}

// ∫ L ρ i_z di as an integral over the walls' area by the midpoint rule: di = cos θ dA / r².
glm::dvec3 quadrature(const Room& room, const Brdf& brdf, const glm::dvec3& o,
                      const SurfaceFrame& frame, int steps) {
  glm::dvec3 sum(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const int across = (axis + 1) % 3;
    const int along = (axis + 2) % 3;
    const double area = room.size[across] * room.size[along];
    for (const double side : {-0.5, 0.5}) {
      for (int j = 0; j < steps; ++j) {
        for (int k = 0; k < steps; ++k) {
          glm::dvec3 q;
          q[axis] = side * room.size[axis];
          q[across] = ((j + 0.5) / steps - 0.5) * room.size[across];
          q[along] = ((k + 0.5) / steps - 0.5) * room.size[along];
          const glm::dvec3 way = q - frame.point;
          const double distance = glm::length(way);
          const glm::dvec3 direction = way / distance;
          const glm::dvec3 i(glm::dot(direction, frame.tangent),
                             glm::dot(direction, frame.bitangent),
                             glm::dot(direction, frame.normal));
          if (!(i.z > 0.0)) continue;
          sum += radiance_at(room, q) * (brdf.evaluate(i, o) * i.z * std::abs(direction[axis]) *
                                         area / (steps * steps * distance * distance));
        }
      }
    }
  }
  return sum;
}

glm::dvec3 view_at(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

glm::dvec3 world(const glm::dvec3& v, const SurfaceFrame& frame) {
  return v.x * frame.tangent + v.y * frame.bitangent + v.z * frame.normal;
}

TEST_CASE("RoomDistribution: constant walls look alike from everywhere") {
  const auto constant = std::make_shared<const RoomDistribution>(constant_room(2.5f));
  const Panorama panorama{8, 4, std::vector<float>(96, 2.5f)};
  const auto brdf = make_brdf("ggx", {0.3, 0.5});
  const Integrator in_room(constant, *brdf, 4096);
  const Integrator outside(panorama, *brdf, 4096);
  for (const glm::dvec3& point : {glm::dvec3(0.0), glm::dvec3(2.9, -1.4, 3.9)}) {
    const SurfaceFrame frame = oblique_frame(point);
    const glm::dvec3 view = world(view_at(0.7, 0.4), frame);
    const glm::dvec3 expected = outside.integrate(view, frame, 1).radiance;
    const RadianceEstimate estimate = in_room.integrate(view, frame, 1);
    CHECK(glm::length(estimate.radiance - expected) < 1e-9 * glm::length(expected));
  }
}

TEST_CASE("RoomDistribution: rough walls agree with plain quadrature over their area") {
  const Room room = rough_room();
  const auto light = std::make_shared<const RoomDistribution>(room);
  for (const glm::dvec3& point : {glm::dvec3(0.3, -0.2, 0.3), glm::dvec3(2.2, -0.9, 2.6)}) {
    const SurfaceFrame frame = oblique_frame(point);
    for (const char* name : {"ward", "ggx"}) {
      const auto brdf = make_brdf(name, {0.2, 0.4});
      for (const double theta : {0.3, 1.2}) {
        INFO(name, " theta ", theta, " at ", point.x);
        const glm::dvec3 o = view_at(theta, 2.0);
        const glm::dvec3 expected = quadrature(room, *brdf, o, frame, 700);
        const Integrator integrator(light, *brdf, 1 << 14);
        const RadianceEstimate estimate = integrator.integrate(world(o, frame), frame, 3);
        for (int c = 0; c < 3; ++c) {
          CHECK(estimate.radiance[c] == doctest::Approx(expected[c]).epsilon(5e-3).scale(0));
          CHECK(estimate.standard_error[c] < 5e-3 * expected[c]);
        }
      }
    }
  }
}

// ∫ p dω over the sphere by the midpoint rule in (cos θ, φ).
TEST_CASE("RoomDistribution: the density integrates to 1, and sample() and at() agree") {
  const RoomDistribution light(rough_room());
  for (const glm::dvec3& point : {glm::dvec3(0.0), glm::dvec3(-1.0, 1.2, 3.0)}) {
    const ClusterChoice choice =
        light.choose(point, [](const glm::dvec3& d) { return 1.0 + 0.9 * d.y; });
    REQUIRE(!choice.empty());
    double sum = 0.0;
    constexpr int kSteps = 900;
    for (int j = 0; j < kSteps; ++j) {
      const double z = 2.0 * (j + 0.5) / kSteps - 1.0;
      for (int k = 0; k < kSteps; ++k) {
        const glm::dvec3 d = view_at(std::acos(z), 2.0 * kPi * (k + 0.5) / kSteps);
        sum += light.at(choice, point, d).pdf;
      }
    }
    CHECK(sum * 4.0 * kPi / (kSteps * kSteps) == doctest::Approx(1.0).epsilon(3e-3));
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform;
    for (int k = 0; k < 200; ++k) {
      const EnvironmentSample drawn =
          light.sample(choice, point, {uniform(random), uniform(random)});
      const EnvironmentSample seen = light.at(choice, point, drawn.direction);
      CHECK(glm::length(drawn.direction) == doctest::Approx(1.0));
      CHECK(drawn.pdf == doctest::Approx(seen.pdf).epsilon(1e-6));
      CHECK(glm::length(drawn.radiance - seen.radiance) < 1e-6 * glm::length(seen.radiance));
      CHECK(drawn.pdf > 0.0);
    }
  }
}

TEST_CASE("render_sphere: a room's picture does not depend on threads, and moves with the sphere") {
  const Room room = rough_room();
  const auto brdf = make_brdf("ggx", {0.1, 0.1});
  SphereOptions options;
  options.size = 8;
  options.samples = 16;
  options.threads = 1;
  Progress progress;
  const RoomSphere sphere{{0.3, -0.2, 0.3}, 0.4};
  const SphereImage one = render_sphere(room, sphere, *brdf, options, progress);
  options.threads = 3;
  CHECK(render_sphere(room, sphere, *brdf, options, progress).radiance == one.radiance);
  const RoomSphere moved{{1.2, -0.4, 1.0}, 0.4};
  CHECK(render_sphere(room, moved, *brdf, options, progress).radiance != one.radiance);
}

TEST_CASE("render_sphere: rooms that cannot be meant are refused") {
  const auto brdf = make_brdf("ggx", {0.1, 0.1});
  Progress progress;
  const auto refused = [&](const Room& room, const RoomSphere& sphere) {
    CHECK_THROWS_AS(render_sphere(room, sphere, *brdf, SphereOptions(), progress),
                    std::invalid_argument);
  };
  Room room = constant_room(1.0f);
  refused(room, {{0.0, 1.2, 0.0}, 0.4});
  refused(room, {{0.0, 0.0, 0.0}, 0.0});
  refused(room, {{0.0, 0.0, 0.0}, std::numeric_limits<double>::quiet_NaN()});
  refused(room, {{0.0, std::numeric_limits<double>::quiet_NaN(), 0.0}, 0.4});
  room.size.y = 0.0;
  refused(room, {{0.0, 0.0, 0.0}, 0.4});
  room = constant_room(1.0f);
  room.walls[4].rgb.clear();
  refused(room, {{0.0, 0.0, 0.0}, 0.4});
}

}  // namespace
}  // namespace lobelight
