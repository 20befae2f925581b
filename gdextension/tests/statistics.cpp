#include "statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/pi.h"

namespace lobelight::testing {

namespace {

glm::dvec3 from_cylinder(double z, double azimuth) {
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

// Regularised upper incomplete gamma function Q(a, x): Press et al., Numerical Recipes, 6.2, its
// series below a + 1 and Lentz's continued fraction above.
double gamma_q(double a, double x) {
  const double factor = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a;
    double sum = term;
    for (double n = a + 1.0; std::abs(term) > 1e-16 * sum; ++n) {
      term *= x / n;
      sum += term;
    }
    return 1.0 - factor * sum;
  }
  double b = x + 1.0 - a;
  double c = 1e300;
  double d = 1.0 / b;
  double fraction = d;
  for (int i = 1; i < 100000; ++i) {
    const double an = -i * (i - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    fraction *= c * d;
    if (std::abs(c * d - 1.0) < 1e-15) break;
  }
  return factor * fraction;
}

}  // namespace

glm::dvec3 Uniform::direction() {
  const glm::dvec2 u = next2();
  return from_cylinder(2.0 * u.x - 1.0, 2.0 * kPi * u.y);
}

glm::dvec3 Uniform::direction_above() {
  const glm::dvec2 u = next2();
  return from_cylinder(u.x, 2.0 * kPi * u.y);
}

double chi_square_tail(double statistic, int degrees) {
  return statistic > 0.0 ? gamma_q(0.5 * degrees, 0.5 * statistic) : 1.0;
}

double sampler_p_value(const std::function<double(const glm::dvec3&)>& pdf,
                       const std::function<std::optional<glm::dvec3>(const glm::dvec2&)>& sampler,
                       const SphereTest& test) {
  const double height = (1.0 - test.lowest_z) / test.rows;
  const double width = 2.0 * kPi / test.columns;
  const auto bins = static_cast<std::size_t>(test.rows * test.columns);
  const auto bin_of = [&](const glm::dvec3& d) {
    const double azimuth = std::atan2(d.y, d.x);
    const int row = std::clamp(static_cast<int>((d.z - test.lowest_z) / height), 0, test.rows - 1);
    const int column =
        std::clamp(static_cast<int>((azimuth < 0.0 ? azimuth + 2.0 * kPi : azimuth) / width), 0,
                   test.columns - 1);
    return static_cast<std::size_t>(row * test.columns + column);
  };

  std::vector<double> expected(bins + 1, 0.0);
  double all = 0.0;
  const int fine_rows = test.rows * test.subdivisions;
  const int fine_columns = test.columns * test.subdivisions;
  const double cell = height * width / (test.subdivisions * test.subdivisions);
  for (int r = 0; r < fine_rows; ++r) {
    for (int c = 0; c < fine_columns; ++c) {
      const double z = test.lowest_z + (r + 0.5) * height / test.subdivisions;
      const double azimuth = (c + 0.5) * width / test.subdivisions;
      const double mass = test.samples * cell * pdf(from_cylinder(z, azimuth));
      const int bin = r / test.subdivisions * test.columns + c / test.subdivisions;
      expected[static_cast<std::size_t>(bin)] += mass;
      all += mass;
    }
  }
  expected[bins] = std::max(0.0, test.samples - all);

  std::vector<double> observed(bins + 1, 0.0);
  Uniform uniform(test.seed);
  for (int n = 0; n < test.samples; ++n) {
    const std::optional<glm::dvec3> direction = sampler(uniform.next2());
    observed[direction ? bin_of(*direction) : bins] += 1.0;
  }

  double statistic = 0.0;
  int degrees = -1;
  double pooled_expected = 0.0;
  double pooled_observed = 0.0;
  const auto count = [&](double o, double e) {
    statistic += (o - e) * (o - e) / e;
    ++degrees;
  };
  for (std::size_t n = 0; n <= bins; ++n) {
    if (expected[n] >= 5.0) {
      count(observed[n], expected[n]);
    } else {
      pooled_expected += expected[n];
      pooled_observed += observed[n];
    }
  }
  if (pooled_expected >= 5.0) {
    count(pooled_observed, pooled_expected);
  } else if (pooled_observed > 5.0 + 10.0 * std::sqrt(5.0)) {
    return 0.0;  // samples where there should be none
  }
  return chi_square_tail(statistic, degrees);
}

double significance(int tests) { return 1.0 - std::pow(0.99, 1.0 / tests); }

}  // namespace lobelight::testing
