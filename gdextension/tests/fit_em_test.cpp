#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/pi.h"
#include "fit/em.h"
#include "fit/initial_guess.h"
#include "models.h"
#include "statistics.h"

namespace lobelight {
namespace {

bool never_falls(const std::vector<double>& log_likelihood) {
  for (std::size_t n = 1; n < log_likelihood.size(); ++n) {
    if (log_likelihood[n] < log_likelihood[n - 1] - 1e-9 * std::abs(log_likelihood[n - 1])) {
      return false;
    }
  }
  return true;
}

void check_finite(const EmResult& result, double albedo) {
  CHECK(total_weight(result.mixture) == doctest::Approx(albedo));
  for (const Lobe& lobe : result.mixture) {
    CHECK(glm::length(lobe.gaussian.mean) == doctest::Approx(1.0));
    CHECK(std::isfinite(lobe.gaussian.kappa));
    CHECK(lobe.gaussian.kappa >= 0.0);
    CHECK(lobe.gaussian.kappa <= EmOptions().kappa_max);
    CHECK(lobe.weight >= 0.0);
  }
  for (const double value : result.log_likelihood) CHECK(std::isfinite(value));
  CHECK(never_falls(result.log_likelihood));
}

// Samples of the mixture, each with the same weight: every lobe's are a lattice of its own.
Slice draw(const Mixture& mixture, int samples) {
  Slice slice;
  for (const Lobe& lobe : mixture) {
    const int count = static_cast<int>(std::lround(lobe.weight * samples));
    for (int n = 0; n < count; ++n) {
      const double turn = n * 0.61803398874989484820;
      slice.directions.push_back(
          sample(lobe.gaussian, {(n + 0.5) / count, turn - std::floor(turn)}));
      slice.weights.push_back(1.0 / samples);
      slice.albedo += slice.weights.back();
    }
  }
  return slice;
}

TEST_CASE("The log-likelihood never falls") {
  const glm::dvec3 views[] = {{0.0, 0.0, 1.0}, {0.6, 0.0, 0.8}, {0.7, 0.71, std::sqrt(0.0059)}};
  for (const std::string& name : brdf_names()) {
    for (const glm::dvec2& alpha : {glm::dvec2(0.01, 0.2), glm::dvec2(0.3, 0.3)}) {
      for (const glm::dvec3& o : views) {
        for (const int lobes : {1, 3, 8, 32}) {
          CAPTURE(name);
          CAPTURE(alpha.x);
          CAPTURE(lobes);
          const Slice slice = sample_slice(*testing::model(name, alpha), o, 24);
          const EmResult result = run_em(slice, initial_guess(slice, lobes));
          CHECK(result.iterations >= 1);
          CHECK(result.log_likelihood.size() == static_cast<std::size_t>(result.iterations) + 1);
          check_finite(result, slice.albedo);
        }
      }
    }
  }
}

TEST_CASE("A mixture sampled from known lobes is recovered within one per cent") {
  const auto unit = [](double x, double y, double z) {
    return glm::normalize(glm::dvec3(x, y, z));
  };
  // Lobes that overlap a little, one narrow, one wide, one below the horizon: samples are samples.
  const Mixture truth{{0.2, {unit(0.1, 0.0, 1.0), 2000.0}},
                      {0.5, {unit(0.3, 0.1, 1.0), 150.0}},
                      {0.3, {unit(-0.8, 0.4, -0.2), 12.0}}};
  const Slice slice = draw(truth, 60000);
  EmOptions options;
  options.max_iterations = 2000;
  options.tolerance = 1e-12;
  const EmResult result = run_em(slice, initial_guess(slice, 3), options);
  check_finite(result, 1.0);
  for (const Lobe& wanted : truth) {
    const auto found = std::min_element(
        result.mixture.begin(), result.mixture.end(), [&](const Lobe& a, const Lobe& b) {
          return glm::length(a.gaussian.mean - wanted.gaussian.mean) <
                 glm::length(b.gaussian.mean - wanted.gaussian.mean);
        });
    CAPTURE(wanted.gaussian.kappa);
    CHECK(found->weight == doctest::Approx(wanted.weight).epsilon(0.01));
    CHECK(found->gaussian.kappa == doctest::Approx(wanted.gaussian.kappa).epsilon(0.01));
    const double width = 1.0 / std::sqrt(wanted.gaussian.kappa);
    CHECK(glm::length(found->gaussian.mean - wanted.gaussian.mean) < 0.01 * width);
  }
}

TEST_CASE("One lobe is the closed-form maximum-likelihood estimate") {
  const Slice slice = sample_slice(*make_brdf("ward", {0.3, 0.4}), {0.6, 0.0, 0.8});
  glm::dvec3 sum(0.0);
  for (std::size_t n = 0; n < slice.weights.size(); ++n) {
    sum += slice.weights[n] * slice.directions[n];
  }
  const EmResult result = run_em(slice, {{1.0, {{1.0, 0.0, 0.0}, 1.0}}});
  CHECK(result.converged);
  CHECK(glm::length(result.mixture[0].gaussian.mean - glm::normalize(sum)) < 1e-12);
  CHECK(one_minus_mean_resultant(result.mixture[0].gaussian.kappa) ==
        doctest::Approx(1.0 - glm::length(sum) / slice.albedo).epsilon(1e-10));
  CHECK(result.mixture[0].weight == doctest::Approx(slice.albedo));
}

TEST_CASE("The recorded log-likelihood is that of the mixture") {
  const Slice slice = sample_slice(*make_brdf("ggx", {0.1, 0.3}), {0.6, 0.0, 0.8}, 32);
  const EmResult result = run_em(slice, initial_guess(slice, 6));
  double direct = 0.0;
  for (std::size_t n = 0; n < slice.weights.size(); ++n) {
    direct += slice.weights[n] / slice.albedo *
              std::log(evaluate(result.mixture, slice.directions[n]) / slice.albedo);
  }
  CHECK(result.log_likelihood.back() == doctest::Approx(direct).epsilon(1e-12));
}

TEST_CASE("Narrow lobes are fitted without cancellation") {
  // κ = 4e7: |Σ w x| is 1 to 1e-8, of which the sharpness would keep a few digits only.
  const glm::dvec3 mean = glm::normalize(glm::dvec3(0.3, 0.5, 0.7));
  const Slice slice = draw({{1.0, {mean, 4e7}}}, 20000);
  const EmResult result = run_em(slice, {{1.0, {glm::normalize(mean + glm::dvec3(1e-3)), 1e6}}});
  CHECK(result.mixture[0].gaussian.kappa == doctest::Approx(4e7).epsilon(1e-3));
  CHECK(glm::length(result.mixture[0].gaussian.mean - mean) < 1e-3 / std::sqrt(4e7));
}

TEST_CASE("Awkward data give finite lobes") {
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const glm::dvec3 side(1.0, 0.0, 0.0);
  const Slice slices[] = {
      {{up}, {0.7}, 0.7},                                                       // one sample
      {std::vector<glm::dvec3>(100, up), std::vector<double>(100, 0.01), 1.0},  // all the same
      {{up, -up}, {0.5, 0.5}, 1.0},                                             // antipodal
      {{up, -up, side, -side}, {0.25, 0.25, 0.25, 0.25}, 1.0},
      {{up, side, -up}, {0.0, 0.4, 0.0}, 0.4},  // zero weights
      {{up, side}, {1.0, 1e-300}, 1.0},
      {{up, side, -side}, {1e300, 1e300, 1e300}, 3e300},
      {{up, side, -side}, {1e-300, 1e-300, 1e-300}, 3e-300},
  };
  for (const Slice& slice : slices) {
    for (const int lobes : {1, 2, 8}) {
      CAPTURE(lobes);
      check_finite(run_em(slice, initial_guess(slice, lobes)), slice.albedo);
      // From lobes that are all the same, from dead ones and from far too narrow ones.
      const auto count = static_cast<std::size_t>(lobes);
      check_finite(run_em(slice, Mixture(count, {1.0, {side, 3.0}})), slice.albedo);
      check_finite(run_em(slice, Mixture(count, {0.0, {-up, 0.0}})), slice.albedo);
      check_finite(run_em(slice, Mixture(count, {1.0, {side, 1e30}})), slice.albedo);
    }
  }
}

TEST_CASE("A slice without mass gives lobes without weight") {
  for (const Slice& slice : {Slice{}, Slice{{{0.0, 0.0, 1.0}}, {0.0}, 0.0}}) {
    const EmResult result = run_em(slice, Mixture(3, {1.0, {{0.0, 0.0, 1.0}, 5.0}}));
    CHECK(result.mixture.size() == 3);
    CHECK(total_weight(result.mixture) == 0.0);
    CHECK(result.iterations == 0);
  }
  CHECK_THROWS_AS(run_em(Slice{}, {}), std::invalid_argument);
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [kappa, kept] :
       {std::pair{infinity, EmOptions().kappa_max}, {nan, 0.0}, {-1.0, 0.0}, {7.0, 7.0}}) {
    const EmResult result = run_em(Slice{}, {{1.0, {{0.0, 0.0, 1.0}, kappa}}});
    CHECK(result.mixture[0].gaussian.kappa == kept);
  }
}

TEST_CASE("Nodes of weight zero count for nothing") {
  Slice slice = sample_slice(*make_brdf("ward", {0.1, 0.3}), {0.6, 0.0, 0.8}, 24);
  const Mixture start = initial_guess(slice, 4);
  const EmResult without = run_em(slice, start);
  for (int n = 0; n < 100; ++n) {
    slice.directions.push_back({-1.0, 0.0, 0.0});
    slice.weights.push_back(0.0);
  }
  const EmResult with = run_em(slice, start);
  REQUIRE(with.iterations == without.iterations);
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(with.mixture[k].gaussian.kappa ==
          doctest::Approx(without.mixture[k].gaussian.kappa).epsilon(1e-9));
  }
}

TEST_CASE("Nodes that are no numbers count for nothing") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Slice slice = sample_slice(*make_brdf("ward", {0.1, 0.3}), {0.6, 0.0, 0.8}, 24);
  const Mixture start = initial_guess(slice, 4);
  const EmResult without = run_em(slice, start);
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const std::vector<glm::dvec3> directions{up, up, up, {kNan, 0.0, 1.0}, {kInfinity, 0.0, 0.0}};
  const std::vector<double> weights{kNan, kInfinity, -1.0, 1.0, 1.0};
  for (std::size_t n = 0; n < directions.size(); ++n) {
    slice.directions.insert(slice.directions.begin(), directions[n]);
    slice.weights.insert(slice.weights.begin(), weights[n]);
    slice.albedo += weights[n];
  }
  REQUIRE(std::isnan(slice.albedo));
  const Mixture guess = initial_guess(slice, 4);
  const EmResult with = run_em(slice, start);
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(guess[k].weight == doctest::Approx(start[k].weight).epsilon(1e-12));
    CHECK(guess[k].gaussian.mean == start[k].gaussian.mean);
    CHECK(with.mixture[k].weight == doctest::Approx(without.mixture[k].weight).epsilon(1e-12));
    CHECK(with.mixture[k].gaussian.mean == without.mixture[k].gaussian.mean);
  }
}

TEST_CASE("Starts without direction and sums without bound are refused") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const Slice slice{{up}, {1.0}, 1.0};
  for (const glm::dvec3& mean : {glm::dvec3(0.0), glm::dvec3(kNan, 0.0, 1.0), 2.0 * up}) {
    CHECK_THROWS_WITH_AS(run_em(slice, {{1.0, {mean, 1.0}}}),
                         "run_em needs a start whose means are unit vectors.",
                         std::invalid_argument);
  }
  const Slice huge{{up, up}, {1e308, 1e308}, std::numeric_limits<double>::infinity()};
  CHECK_THROWS_AS(run_em(huge, {{1.0, {up, 1.0}}}), std::invalid_argument);
  CHECK_THROWS_AS(initial_guess(huge, 1), std::invalid_argument);
}

TEST_CASE("The cap on sharpness is above what the narrowest slices ask of one lobe") {
  // The slice of Ward at alpha 1e-4 has the variances 2 α² along the plane of incidence and
  // 2 α² cos² θ across it: one lobe for all of it has κ = 1/(α² (1 + cos² θ)).
  const auto brdf = make_brdf("ward", {1e-4, 1e-4});
  for (const double degrees : {0.0, 60.0, 89.4}) {
    CAPTURE(degrees);
    const double angle = degrees * kPi / 180.0;
    const double cosine = std::cos(angle);
    const Slice slice = sample_slice(*brdf, {std::sin(angle), 0.0, cosine});
    const EmResult one = run_em(slice, initial_guess(slice, 1));
    check_finite(one, slice.albedo);
    CHECK(one.mixture[0].gaussian.kappa ==
          doctest::Approx(1e8 / (1.0 + cosine * cosine)).epsilon(0.02));
    CHECK(one.mixture[0].gaussian.kappa < EmOptions().kappa_max);
    const EmResult many = run_em(slice, initial_guess(slice, 32));
    check_finite(many, slice.albedo);
  }
}

TEST_CASE("Tied lobes stay mirror images to the last bit, and their likelihood never falls") {
  const Slice slice = sample_slice(*make_brdf("ward", {0.1, 0.3}), {0.0, 0.0, 1.0}, 32);
  for (const int lobes : {1, 5, 8}) {
    const Mixture start = initial_guess(slice, lobes);
    EmOptions options;
    options.max_iterations = 50;
    options.tolerance = 0.0;
    options.mirrors = {match_images(start, 0), match_images(start, 1)};
    const EmResult result = run_em(slice, start, options);
    check_finite(result, slice.albedo);
    for (std::size_t k = 0; k < result.mixture.size(); ++k) {
      const Lobe& own = result.mixture[k];
      const Lobe& in_x = result.mixture[static_cast<std::size_t>(options.mirrors[0].image[k])];
      const Lobe& in_y = result.mixture[static_cast<std::size_t>(options.mirrors[1].image[k])];
      CHECK(in_x.gaussian.mean == reflected(own.gaussian.mean, 0));
      CHECK(in_y.gaussian.mean == reflected(own.gaussian.mean, 1));
      CHECK(in_x.weight == own.weight);
      CHECK(in_y.gaussian.kappa == own.gaussian.kappa);
    }
  }
}

TEST_CASE("EM stops at its tolerance, at its limit, and when it is cancelled") {
  const Slice slice = sample_slice(*make_brdf("ward", {0.1, 0.3}), {0.6, 0.0, 0.8}, 24);
  EmOptions options;
  options.max_iterations = 5;
  options.tolerance = 0.0;
  const EmResult limited = run_em(slice, initial_guess(slice, 8), options);
  CHECK(limited.iterations == 5);
  CHECK_FALSE(limited.converged);

  options.max_iterations = 10000;
  options.tolerance = 1e-5;
  const EmResult converged = run_em(slice, initial_guess(slice, 8), options);
  CHECK(converged.converged);
  const std::vector<double>& curve = converged.log_likelihood;
  CHECK(curve.back() - curve[curve.size() - 2] < 1e-5);
  CHECK(curve[curve.size() - 2] - curve[curve.size() - 3] >= 1e-5);

  Progress progress;
  progress.cancel();
  options.progress = &progress;
  CHECK_THROWS_AS(run_em(slice, initial_guess(slice, 8), options), Cancelled);
}

}  // namespace
}  // namespace lobelight
