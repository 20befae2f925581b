#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "fit/initial_guess.h"

namespace lobelight {
namespace {

TEST_CASE("The guess is a row along the wider axis, of equal mass, with the slice's albedo") {
  for (const bool wide_in_x : {true, false}) {
    const auto brdf = make_brdf("ward", wide_in_x ? glm::dvec2(0.2, 0.05) : glm::dvec2(0.05, 0.2));
    const Slice slice = sample_slice(*brdf, {0.0, 0.0, 1.0});
    for (const int lobes : {1, 2, 5, 8, 32}) {
      const Mixture guess = initial_guess(slice, lobes);
      REQUIRE(guess.size() == static_cast<std::size_t>(lobes));
      CHECK(total_weight(guess) == doctest::Approx(slice.albedo).epsilon(1e-12));
      double before = -1.0;
      for (const Lobe& lobe : guess) {
        const glm::dvec3 mean = lobe.gaussian.mean;
        const double along = wide_in_x ? mean.x : mean.y;
        const double across = wide_in_x ? mean.y : mean.x;
        CHECK(along > before);
        CHECK(std::abs(across) < 0.01);
        CHECK(lobe.weight == doctest::Approx(slice.albedo / lobes));
        CHECK(lobe.gaussian.kappa > 10.0);
        CHECK(lobe.gaussian.kappa < 1e5);
        before = along;
      }
    }
  }
}

TEST_CASE("One lobe is the slice's own mean and mean resultant") {
  const Slice slice = sample_slice(*make_brdf("ggx", {0.1, 0.3}), {0.6, 0.0, 0.8});
  glm::dvec3 sum(0.0);
  for (std::size_t n = 0; n < slice.weights.size(); ++n) {
    sum += slice.weights[n] * slice.directions[n];
  }
  const Mixture guess = initial_guess(slice, 1);
  CHECK(glm::length(guess[0].gaussian.mean - glm::normalize(sum)) < 1e-12);
  CHECK(one_minus_mean_resultant(guess[0].gaussian.kappa) ==
        doctest::Approx(1.0 - glm::length(sum) / slice.albedo).epsilon(1e-10));
}

TEST_CASE("Awkward slices give finite guesses") {
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const Slice slices[] = {
      {},
      {{up}, {0.5}, 0.5},
      {{up, up, up}, {0.2, 0.2, 0.2}, 0.6},
      {{up, -up}, {0.5, 0.5}, 1.0},
      {{up, {1.0, 0.0, 0.0}}, {0.0, 1.0}, 1.0},
  };
  for (const Slice& slice : slices) {
    for (const int lobes : {1, 3, 32}) {
      const Mixture guess = initial_guess(slice, lobes);
      REQUIRE(guess.size() == static_cast<std::size_t>(lobes));
      CHECK(total_weight(guess) == doctest::Approx(slice.albedo));
      for (const Lobe& lobe : guess) {
        CHECK(glm::length(lobe.gaussian.mean) == doctest::Approx(1.0));
        CHECK(std::isfinite(lobe.gaussian.kappa));
        CHECK(lobe.gaussian.kappa >= 0.0);
      }
    }
  }
  CHECK_THROWS_AS(initial_guess(slices[1], 0), std::invalid_argument);
}

}  // namespace
}  // namespace lobelight
