#include <doctest/doctest.h>

#include <array>
#include <glm/geometric.hpp>
#include <random>

#include "image/room.h"

namespace lobelight {
namespace {

const glm::dvec3 kSize(6.0, 3.0, 8.0);

TEST_CASE("Room: corners of the pictures lie where the contract has them") {
  Room room;
  room.size = kSize;
  struct Corner {
    std::size_t wall;
    glm::dvec2 position;
    glm::dvec3 point;  // Worked out by hand from (s, t) of each face.
  };
  for (const Corner& corner : {
           Corner{0, {0.0, 0.0}, {3.0, 1.5, 4.0}},
           Corner{0, {1.0, 0.0}, {3.0, 1.5, -4.0}},
           Corner{0, {0.0, 1.0}, {3.0, -1.5, 4.0}},
           Corner{1, {0.0, 0.0}, {-3.0, 1.5, -4.0}},
           Corner{1, {1.0, 0.0}, {-3.0, 1.5, 4.0}},
           Corner{2, {0.0, 0.0}, {-3.0, 1.5, -4.0}},
           Corner{2, {1.0, 0.0}, {3.0, 1.5, -4.0}},
           Corner{2, {0.0, 1.0}, {-3.0, 1.5, 4.0}},
           Corner{3, {0.0, 0.0}, {-3.0, -1.5, 4.0}},
           Corner{3, {0.0, 1.0}, {-3.0, -1.5, -4.0}},
           Corner{4, {0.0, 0.0}, {-3.0, 1.5, 4.0}},
           Corner{4, {1.0, 1.0}, {3.0, -1.5, 4.0}},
           Corner{5, {0.0, 0.0}, {3.0, 1.5, -4.0}},
           Corner{5, {1.0, 1.0}, {-3.0, -1.5, -4.0}},
       }) {
    INFO("wall ", corner.wall, " at ", corner.position.x, ", ", corner.position.y);
    CHECK(glm::length(room.point({corner.wall, corner.position}) - corner.point) < 1e-12);
  }
}

TEST_CASE("Room: a ray from anywhere meets the wall where it points to") {
  Room room;
  room.size = kSize;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0.02, 0.98);
  for (int k = 0; k < 600; ++k) {
    const WallPosition aim{static_cast<std::size_t>(k) % kWalls,
                           {uniform(random), uniform(random)}};
    const glm::dvec3 origin =
        kSize * (glm::dvec3(uniform(random), uniform(random), uniform(random)) - 0.5);
    const WallPosition met = room.meet(origin, glm::normalize(room.point(aim) - origin));
    REQUIRE(met.wall == aim.wall);
    CHECK(glm::length(met.position - aim.position) < 1e-9);
  }
}

TEST_CASE("Room: areas of the walls") {
  Room room;
  room.size = kSize;
  CHECK(room.wall_area(0) == doctest::Approx(24.0));
  CHECK(room.wall_area(3) == doctest::Approx(48.0));
  CHECK(room.wall_area(5) == doctest::Approx(18.0));
}

}  // namespace
}  // namespace lobelight
