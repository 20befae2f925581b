#include <doctest/doctest.h>

#include <cmath>

#include "sg/frame.h"
#include "statistics.h"

namespace lobelight {
namespace {

TEST_CASE("frame_around gives a right-handed orthonormal frame, at the poles too") {
  testing::Uniform uniform(1);
  for (int n = 0; n < 1000; ++n) {
    glm::dvec3 z = uniform.direction();
    if (n == 0) z = {0.0, 0.0, 1.0};
    if (n == 1) z = {0.0, 0.0, -1.0};
    if (n == 2) z = {1.0, 0.0, -0.0};
    if (n == 3) z = glm::normalize(glm::dvec3(1e-9, -1e-9, -1.0));
    const Frame frame = frame_around(z);
    CAPTURE(n);
    CHECK(std::abs(glm::length(frame.x) - 1.0) < 1e-14);
    CHECK(std::abs(glm::dot(frame.x, z)) < 1e-14);
    CHECK(glm::length(glm::cross(frame.x, frame.y) - z) < 1e-14);
  }
}

}  // namespace
}  // namespace lobelight
