#include <doctest/doctest.h>

#include <cmath>

#include "fit/mirror.h"
#include "statistics.h"

namespace lobelight {
namespace {

// Lobes 0 and 2 are images of each other in y = 0, lobe 1 lies on the plane; slightly disturbed.
Mixture disturbed_mixture() {
  const auto unit = [](double x, double y) { return glm::normalize(glm::dvec3(x, y, 1.0)); };
  return {{0.3, {unit(0.1, 0.4), 90.0}},
          {0.4, {unit(0.3, 0.01), 50.0}},
          {0.2, {unit(0.12, -0.41), 110.0}}};
}

TEST_CASE("Images are found and pairs are mutual") {
  CHECK(match_images(disturbed_mixture(), 1).image == std::vector<int>{2, 1, 0});
  CHECK(match_images({}, 1).image.empty());
  testing::Uniform uniform(1);
  Mixture any(9);
  for (Lobe& lobe : any) lobe.gaussian.mean = uniform.direction_above();
  const Mirror mirror = match_images(any, 0);
  CHECK(mirror.axis == 0);
  for (std::size_t k = 0; k < any.size(); ++k) {
    CHECK(mirror.image[static_cast<std::size_t>(mirror.image[k])] == static_cast<int>(k));
  }
}

TEST_CASE("A symmetrised mixture is symmetric to the last bit and keeps its weight") {
  Mixture mixture = disturbed_mixture();
  const Mirror mirror = match_images(mixture, 1);
  symmetrise(mixture, {mirror});
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const Lobe& image = mixture[static_cast<std::size_t>(mirror.image[k])];
    CHECK(image.weight == mixture[k].weight);
    CHECK(image.gaussian.kappa == mixture[k].gaussian.kappa);
    CHECK(image.gaussian.mean == reflected(mixture[k].gaussian.mean, 1));
    CHECK(glm::length(mixture[k].gaussian.mean) == doctest::Approx(1.0).epsilon(1e-14));
  }
  CHECK(mixture[1].gaussian.mean.y == 0.0);
  CHECK(total_weight(mixture) == doctest::Approx(0.9));
}

TEST_CASE("Pairs far from the plane stay pairs") {
  Mixture mixture = disturbed_mixture();
  MovingMirror mirror(match_images(mixture, 1));
  for (int step = 0; step < 3; ++step) mirror.advance(mixture);
  CHECK(mirror.mirrors()[0].image == std::vector<int>{2, 1, 0});
  CHECK(mirror.mirrors()[1].image == std::vector<int>{2, 1, 0});
  CHECK(mixture[0].gaussian.mean == reflected(mixture[2].gaussian.mean, 1));
  CHECK(mixture[0].gaussian.mean.y > 0.3);
}

TEST_CASE("Pairs that meet on the plane are alike for one view, then part along it") {
  Mixture mixture = disturbed_mixture();
  MovingMirror mirror(match_images(mixture, 1));
  mirror.advance(mixture);
  // Half a standard deviation 1/√κ = 0.1 off the plane.
  for (const std::size_t k : {0u, 2u}) {
    mixture[k].gaussian = {glm::normalize(glm::dvec3(0.1, k == 0 ? 0.05 : -0.05, 1.0)), 100.0};
  }

  mirror.advance(mixture);
  CHECK(mixture[0].gaussian.mean == mixture[2].gaussian.mean);
  CHECK(mixture[0].gaussian.mean.y == 0.0);
  // The ties keep them alike and on the plane, whatever an iteration makes of them.
  Mixture moved = mixture;
  moved[0].gaussian.mean = glm::normalize(glm::dvec3(0.2, 0.3, 1.0));
  moved[2].weight = 0.1;
  symmetrise(moved, mirror.mirrors());
  CHECK(moved[0].gaussian.mean == moved[2].gaussian.mean);
  CHECK(moved[0].gaussian.mean.y == 0.0);
  CHECK(moved[0].weight == moved[2].weight);

  mirror.advance(mixture);
  CHECK(mirror.mirrors()[0].image == std::vector<int>{0, 1, 2});
  for (const std::size_t k : {0u, 2u}) {
    CHECK(mixture[k].gaussian.mean.y == 0.0);
    CHECK(glm::length(mixture[k].gaussian.mean) == doctest::Approx(1.0).epsilon(1e-14));
  }
  CHECK(glm::length(mixture[0].gaussian.mean - mixture[2].gaussian.mean) ==
        doctest::Approx(0.1).epsilon(0.01));
  // And they stay single.
  mirror.advance(mixture);
  CHECK(mirror.mirrors()[0].image == std::vector<int>{0, 1, 2});
}

}  // namespace
}  // namespace lobelight
