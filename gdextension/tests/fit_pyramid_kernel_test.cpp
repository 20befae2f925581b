#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "base/pi.h"
#include "fit/pyramid_kernel.h"
#include "statistics.h"

namespace lobelight {
namespace {

// ∫₀^end f(t) dt by the midpoint rule, with steps that grow from the start on.
double integral(const std::function<double(double)>& f, double end) {
  constexpr int kSteps = 200000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    // t = 2 s / (1 − s) up to s_end, dt/ds = 2 / (1 − s)².
    const double s_end = end / (end + 2.0);
    const double s = s_end * (i + 0.5) / kSteps;
    sum += f(2.0 * s / (1.0 - s)) * 2.0 / ((1.0 - s) * (1.0 - s)) * s_end / kSteps;
  }
  return sum;
}

TEST_CASE("The kernel has mass 1 and variance 1 per axis") {
  // In the plane dA = π dt, and r² is two axes' variance.
  const double far = 1e9;
  CHECK(integral([](double t) { return kPi * pyramid_kernel(t).density; }, far) ==
        doctest::Approx(1.0).epsilon(1e-8));
  CHECK(integral([](double t) { return 0.5 * t * kPi * pyramid_kernel(t).density; }, far) ==
        doctest::Approx(1.0).epsilon(1e-6));
  for (const double t : {0.01, 1.0, 7.0, 11.9, 12.1, 300.0}) {
    const double step = 1e-5 * t;
    const double slope = (pyramid_kernel(t + step).density - pyramid_kernel(t - step).density);
    CHECK(pyramid_kernel(t).slope == doctest::Approx(slope / (2.0 * step)).epsilon(1e-5));
    CHECK(pyramid_kernel(t).density > 0.0);
  }
}

TEST_CASE("It is the density of sums of discs and a tent") {
  constexpr int kSamples = 400000;
  testing::Uniform uniform(1);
  std::vector<double> squares;
  double second = 0.0;
  double fourth = 0.0;
  for (int n = 0; n < kSamples; ++n) {
    // A tent is the sum of two boxes.
    glm::dvec2 place = uniform.next2() + uniform.next2() - 1.0;
    for (double variance = 5.0 / 8.0; variance > 1e-4; variance /= 4.0) {
      const glm::dvec2 u = uniform.next2();
      const double radius = 2.0 * std::sqrt(variance * u.x);  // R² / 4 per axis
      place += radius * glm::dvec2(std::cos(2.0 * kPi * u.y), std::sin(2.0 * kPi * u.y));
    }
    squares.push_back(glm::dot(place, place));
    second += squares.back() / kSamples;
    fourth += squares.back() * squares.back() / kSamples;
  }
  CHECK(second == doctest::Approx(2.0).epsilon(0.005));
  CHECK(fourth / (second * second) == doctest::Approx(12.0 / 7.0).epsilon(0.01));

  std::sort(squares.begin(), squares.end());
  double furthest = 0.0;
  double furthest_of_gaussian = 0.0;
  for (double share = 0.02; share < 1.0; share += 0.02) {
    const double t = squares[static_cast<std::size_t>(share * kSamples)];
    // No tail within t: the kernel's mass there in closed form.
    furthest =
        std::max(furthest, std::abs(1.0 - std::pow(std::max(0.0, 1.0 - t / 12.0), 5.0) - share));
    furthest_of_gaussian =
        std::max(furthest_of_gaussian, std::abs(1.0 - std::exp(-0.5 * t) - share));
    CHECK(integral([](double s) { return kPi * pyramid_kernel(s).density; }, t) ==
          doctest::Approx(share).epsilon(0.02).scale(1.0));
  }
  CHECK(furthest < 0.01);
  CHECK(furthest_of_gaussian > 0.04);
}

TEST_CASE("Variances are looked up where the shader looks them up") {
  for (const double size : {64.0, 256.0, 2048.0}) {
    // From the fifth level on, whose variance is that of a geometric series within a thousandth.
    for (double variance = 1024.0 * 4.0 / (size * size); variance < 4.0; variance *= 1.37) {
      // lobelight_level() of environment.gdshaderinc.
      const double step = 5.0 / 6.0;
      const double smooth =
          0.5 * std::log2((size * size / 4.0 * variance + step) / (step + 1.0 / 6.0));
      const double coarser_share = (std::exp2(2.0 * (smooth - std::floor(smooth))) - 1.0) / 3.0;
      const PyramidLevels levels = pyramid_levels(variance);
      CAPTURE(size);
      CAPTURE(variance);
      if (coarser_share < 0.01) continue;  // the other side of a level
      CHECK(levels.coarser_share == doctest::Approx(coarser_share).epsilon(0.005).scale(1.0));
      CHECK((1.0 + 3.0 * levels.coarser_share) * levels.finer == doctest::Approx(variance));
      CHECK(pyramid_levels(4.0 * variance).finer == doctest::Approx(4.0 * levels.finer));
    }
  }
  // At a level, from either side.
  const double level = pyramid_levels(0.01).finer;
  for (const double near : {level * (1.0 - 1e-15), level, level * (1.0 + 1e-15)}) {
    const PyramidLevels levels = pyramid_levels(near);
    CHECK((1.0 + 3.0 * levels.coarser_share) * levels.finer == doctest::Approx(near));
  }
}

TEST_CASE("A drawn lobe is a density on the sphere, and its derivatives are those") {
  for (const double variance : {1e-8, 1e-4, 0.003, 0.02, 0.3, 2.0, 15.0}) {
    CAPTURE(variance);
    const DrawnLobe lobe(variance);
    // Of chords: dω = π d(r²).
    const double mass = integral(
        [&](double t) { return kPi * variance * lobe.at(t * variance).density; }, 4.0 / variance);
    CHECK(mass == doctest::Approx(1.0).epsilon(1e-6));
    for (const double t : {0.1, 2.0, 9.0}) {
      const double squared = std::min(t * variance, 3.9);
      const DrawnLobe::Value value = lobe.at(squared);
      const double ahead = lobe.at(squared * 1.00001).density;
      const double behind = lobe.at(squared * 0.99999).density;
      CHECK(value.by_distance ==
            doctest::Approx((ahead - behind) / (2e-5 * squared)).epsilon(1e-4));
      const double wider = DrawnLobe(variance * 1.00001).at(squared).density;
      const double narrower = DrawnLobe(variance * 0.99999).at(squared).density;
      CHECK(value.by_log_variance ==
            doctest::Approx((wider - narrower) / 2e-5).epsilon(1e-4).scale(value.density));
    }
  }
}

TEST_CASE("A lobe half-way between two levels has the variance that was asked for") {
  const double variance = 1e-4;
  const DrawnLobe lobe(variance);
  const double found = integral(
      [&](double t) { return 0.5 * t * kPi * variance * lobe.at(t * variance).density; }, 1e4);
  CHECK(found == doctest::Approx(1.0).epsilon(1e-4));
}

}  // namespace
}  // namespace lobelight
