#include <doctest/doctest.h>

#include <cmath>

#include "fit/em.h"
#include "fit/em_acceleration.h"
#include "fit/initial_guess.h"

namespace lobelight {
namespace {

constexpr double kTarget = 100.0;
constexpr double kLongestStep = 0.1;

// One lobe whose ln(1 + κ) a step moves to `target` from a distance that it multiplies by `factor`.
Mixture step_towards(const Mixture& from, double factor) {
  Mixture to = from;
  const double target = std::log1p(kTarget);
  const double distance = std::log1p(from[0].gaussian.kappa) - target;
  to[0].gaussian.kappa = std::expm1(target + factor * distance);
  return to;
}

double distance(const Mixture& mixture) {
  return std::abs(std::log1p(mixture[0].gaussian.kappa) - std::log1p(kTarget));
}

TEST_CASE("A linear map's fixed point is reached as soon as its factor is known") {
  for (const double factor : {0.5, 0.9, 0.96}) {
    Mixture place{{1.0, {{0.0, 0.0, 1.0}, 1.05 * kTarget}}};
    EmAcceleration acceleration(kLongestStep);
    for (int call = 0; call < 3; ++call) {
      place = acceleration.propose(place, step_towards(place, factor));
    }
    CHECK(distance(place) < 1e-9);
  }
}

TEST_CASE("No step is longer than allowed, nor further than the bound beyond EM's") {
  Mixture place{{1.0, {{0.0, 0.0, 1.0}, 3.0 * kTarget}}};
  EmAcceleration acceleration(kLongestStep);
  for (int call = 0; call < 5; ++call) {
    const Mixture next = acceleration.propose(place, step_towards(place, 0.999));
    const double step = distance(place) - distance(next);
    CHECK(step > 0.0);
    CHECK(step <= kLongestStep + 1e-9);
    CHECK(step <= distance(place) * 0.001 / EmAcceleration::kLeastContraction + 1e-9);
    place = next;
  }
}

TEST_CASE("A map that moves away from a saddle is followed, not turned back") {
  Mixture place{{1.0, {{0.0, 0.0, 1.0}, 1.001 * kTarget}}};
  EmAcceleration acceleration(kLongestStep);
  for (int call = 0; call < 8; ++call) {
    const Mixture next = acceleration.propose(place, step_towards(place, 1.05));
    CHECK(distance(next) > 1.04 * distance(place));
    place = next;
  }
  CHECK(distance(place) > 0.03);  // 1.05^8 · 0.001 is 0.0015
}

TEST_CASE("Acceleration gets as far as EM does in a third of the iterations") {
  struct Place {
    const char* brdf;
    glm::dvec2 alpha;
    glm::dvec3 view;
  };
  const Place places[] = {{"ward", {0.1, 0.1}, {0.6, 0.0, 0.8}},
                          {"ward", {0.05, 0.2}, {0.5, 0.5, std::sqrt(0.5)}},
                          {"ward", {0.01, 0.2}, {0.6, 0.1, std::sqrt(0.63)}},
                          {"ggx", {0.1, 0.3}, {0.1, 0.9, std::sqrt(0.18)}}};
  int plain_iterations = 0;
  int fast_iterations = 0;
  for (const Place& place : places) {
    for (const int lobes : {2, 6}) {
      const Slice slice = sample_slice(*make_brdf(place.brdf, place.alpha), place.view, 24);
      const Mixture start = initial_guess(slice, lobes);
      EmOptions options;
      options.max_iterations = 2000;
      options.tolerance = 1e-7;
      options.accelerate = false;
      const EmResult plain = run_em(slice, start, options);
      options.accelerate = true;
      const EmResult fast = run_em(slice, start, options);
      REQUIRE(plain.converged);
      REQUIRE(fast.converged);
      CHECK(fast.log_likelihood.back() > plain.log_likelihood.back() - 1e-5);
      plain_iterations += plain.iterations;
      fast_iterations += fast.iterations;
    }
  }
  CHECK(3 * fast_iterations < plain_iterations);
}

}  // namespace
}  // namespace lobelight
