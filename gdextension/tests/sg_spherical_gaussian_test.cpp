#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "base/pi.h"
#include "sg/spherical_gaussian.h"
#include "sg_oracle.h"
#include "statistics.h"

namespace lobelight {
namespace {

constexpr double kKappas[] = {0.0, 1e-300, 1e-8, 1e-3, 0.5, 3.0, 40.0, 800.0, 1e5, 1e8, 1e10};

// The vector at `angle` from the pole: sin and cos of a small angle keep |x − μ|² exact.
glm::dvec3 at_angle(double angle) { return {std::sin(angle), 0.0, std::cos(angle)}; }

// ∫ f dω for f that depends on 1 − cos θ alone: 64-point composite Gauss rule (2 nodes) in the
// cap's share of an exponential of the given sharpness, which spreads the nodes over lobe and tail.
template <typename F>
double integrate_around_pole(double kappa, F f) {
  constexpr int kCells = 4000;
  double sum = 0.0;
  const double top = std::min(2.0, kappa > 0.0 ? 60.0 / kappa : 2.0);
  for (int n = 0; n < kCells; ++n) {
    for (const double node : {0.21132486540518712, 0.78867513459481288}) {
      sum += f(top * (n + node) / kCells);
    }
  }
  return 2.0 * kPi * sum * top / (2 * kCells);
}

TEST_CASE("log_density agrees with SciPy and mpmath") {
  for (const auto& [kappa, angle, value] : oracle::kLogDensities) {
    CAPTURE(kappa);
    CAPTURE(angle);
    const double own = log_density({{0.0, 0.0, 1.0}, kappa}, at_angle(angle));
    CHECK(own == doctest::Approx(value).epsilon(2e-14));
  }
}

TEST_CASE("The density integrates to one") {
  for (const double kappa : kKappas) {
    CAPTURE(kappa);
    const double integral = integrate_around_pole(kappa, [&](double one_minus_cosine) {
      const double sine = std::sqrt(one_minus_cosine * (2.0 - one_minus_cosine));
      return density({{0.0, 0.0, 1.0}, kappa}, {sine, 0.0, 1.0 - one_minus_cosine});
    });
    // From 1 − cos θ the direction is known to 1e-16, its distance from the mean to 1e-16·√κ: the
    // integrand of the sharpest lobes is the limit here, not the density.
    CHECK(integral == doctest::Approx(1.0).epsilon(kappa < 1e6 ? 1e-9 : 1e-5));
  }
}

TEST_CASE("The density does not depend on the frame and is uniform at zero sharpness") {
  testing::Uniform uniform(3);
  for (int n = 0; n < 200; ++n) {
    const glm::dvec3 mean = uniform.direction();
    const glm::dvec3 x = uniform.direction();
    const double cosine = glm::dot(mean, x);
    CHECK(density({mean, 0.0}, x) == doctest::Approx(0.25 / kPi).epsilon(1e-14));
    // Töral 2015, eq. 2.2, where it is stable.
    const double kappa = 20.0 * uniform.next() + 0.01;
    const double direct = kappa / (4.0 * kPi * std::sinh(kappa)) * std::exp(kappa * cosine);
    CHECK(density({mean, kappa}, x) == doctest::Approx(direct).epsilon(1e-12));
  }
}

TEST_CASE("Coverage agrees with mpmath and inverts the integral") {
  for (const auto& [kappa, coverage, one_minus_cosine] : oracle::kCoverages) {
    CAPTURE(kappa);
    CAPTURE(coverage);
    const double own = coverage_one_minus_cosine(kappa, coverage);
    CHECK(own == doctest::Approx(one_minus_cosine).epsilon(1e-12));
  }
  for (const double kappa : kKappas) {
    CAPTURE(kappa);
    CHECK(coverage_one_minus_cosine(kappa, 0.0) == 0.0);
    const double all = coverage_one_minus_cosine(kappa, 1.0);
    CHECK(all == doctest::Approx(2.0).epsilon(1e-14));
    double before = 0.0;
    for (double coverage = 0.05; coverage < 1.0; coverage += 0.05) {
      const double own = coverage_one_minus_cosine(kappa, coverage);
      CHECK(own > before);
      CHECK(own <= 2.0);
      before = own;
    }
  }
}

TEST_CASE("Coverage keeps its digits up to the whole sphere") {
  // 1 − coverage = 2^-53 and 2^-50: the share beyond the cap is (1 − coverage) + coverage e^{−2κ}.
  for (const double kappa : {3.0, 10.0, 17.0, 18.0, 20.0, 1e3, 1e8}) {
    for (const double beyond : {0x1p-53, 0x1p-50, 1e-9}) {
      CAPTURE(kappa);
      CAPTURE(beyond);
      const double coverage = 1.0 - beyond;
      const double rest = (1.0 - coverage) + coverage * std::exp(-2.0 * kappa);
      CHECK(coverage_one_minus_cosine(kappa, coverage) ==
            doctest::Approx(-std::log(rest) / kappa).epsilon(1e-14));
    }
    CHECK(coverage_one_minus_cosine(kappa, 1.0) == doctest::Approx(2.0).epsilon(1e-15));
  }
  for (const double kappa : {0.0, 1e-300, 1e-18, 1e-16}) {
    for (const double coverage : {1e-12, 0.3, 1.0}) {
      CAPTURE(kappa);
      CHECK(coverage_one_minus_cosine(kappa, coverage) ==
            doctest::Approx(2.0 * coverage).epsilon(1e-15));
    }
  }
  // The samples farthest from the mean are those of the density, not of its rounding.
  double before = 0.0;
  for (double beyond = 1e-13; beyond > 1.2e-16; beyond *= 0.5) {
    const double t = coverage_one_minus_cosine(20.0, 1.0 - beyond);
    CHECK(t > before);
    before = t;
  }
}

TEST_CASE("The mean resultant agrees with mpmath, and its inverse inverts it") {
  for (const auto& [kappa, one_minus_r] : oracle::kMeanResultants) {
    CAPTURE(kappa);
    CHECK(one_minus_mean_resultant(kappa) == doctest::Approx(one_minus_r).epsilon(1e-13));
    // 1 − R̄ = 1 − κ/3 + … near 0: its rounding alone is 3e-16/κ of a small κ.
    const double tolerance = 1e-12 + 1e-15 / kappa;
    CHECK(kappa_from_one_minus_mean_resultant(one_minus_r) ==
          doctest::Approx(kappa).epsilon(tolerance));
  }
  for (double log_kappa = -5.0; log_kappa < 10.0; log_kappa += 0.01) {
    const double kappa = std::pow(10.0, log_kappa);
    CAPTURE(kappa);
    const double back = kappa_from_one_minus_mean_resultant(one_minus_mean_resultant(kappa));
    CHECK(back == doctest::Approx(kappa).epsilon(1e-11 + 1e-15 / kappa));
  }
}

TEST_CASE("The inverse of the mean resultant is finite or infinite as documented") {
  CHECK(kappa_from_one_minus_mean_resultant(0.0) == std::numeric_limits<double>::infinity());
  CHECK(kappa_from_one_minus_mean_resultant(-1e-20) == std::numeric_limits<double>::infinity());
  CHECK(kappa_from_one_minus_mean_resultant(1.0) == 0.0);
  CHECK(kappa_from_one_minus_mean_resultant(1.5) == 0.0);
  double before = std::numeric_limits<double>::infinity();
  for (double t = 1e-12; t < 1.0; t *= 1.03) {
    const double kappa = kappa_from_one_minus_mean_resultant(t);
    CHECK(kappa < before);
    CHECK(kappa > 0.0);
    before = kappa;
  }
}

TEST_CASE("Samples are distributed as the density") {
  constexpr double kTested[] = {0.0, 0.7, 12.0, 60.0};
  const glm::dvec3 mean = glm::normalize(glm::dvec3(0.6, -0.3, -0.5));
  for (const double kappa : kTested) {
    CAPTURE(kappa);
    const SphericalGaussian gaussian{mean, kappa};
    const double p = testing::sampler_p_value(
        [&](const glm::dvec3& x) { return density(gaussian, x); },
        [&](const glm::dvec2& u) { return std::optional<glm::dvec3>(sample(gaussian, u)); }, {});
    CHECK(p > testing::significance(4));
  }
}

TEST_CASE("Samples of every sharpness are unit vectors at the distance that coverage says") {
  testing::Uniform uniform(5);
  for (const double kappa : kKappas) {
    for (int n = 0; n < 200; ++n) {
      const glm::dvec3 mean = uniform.direction();
      const glm::dvec2 u = uniform.next2();
      const glm::dvec3 x = sample({mean, kappa}, u);
      CAPTURE(kappa);
      CHECK(std::abs(glm::length(x) - 1.0) < 1e-14);
      const glm::dvec3 d = x - mean;
      const double wanted = coverage_one_minus_cosine(kappa, u.x);
      CHECK(0.5 * glm::dot(d, d) == doctest::Approx(wanted).epsilon(1e-5));
    }
  }
}

}  // namespace
}  // namespace lobelight
