#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/lbfgs.h"

namespace lobelight {
namespace {

// Rosenbrock 1960: a curved valley with its minimum, 0, at (1, 1).
double rosenbrock(const std::vector<double>& x, std::vector<double>& gradient) {
  const double a = 1.0 - x[0];
  const double b = x[1] - x[0] * x[0];
  gradient = {-2.0 * a - 400.0 * x[0] * b, 200.0 * b};
  return a * a + 100.0 * b * b;
}

TEST_CASE("Minima are found, and the value never rises on the way") {
  LbfgsOptions options;
  options.max_iterations = 200;
  options.tolerance = 1e-14;
  const LbfgsResult result = minimise(rosenbrock, {-1.2, 1.0}, options);
  CHECK(result.converged);
  CHECK(result.values.size() < 100);
  CHECK(result.x[0] == doctest::Approx(1.0).epsilon(1e-5));
  CHECK(result.x[1] == doctest::Approx(1.0).epsilon(1e-5));
  for (std::size_t i = 1; i < result.values.size(); ++i) {
    CHECK(result.values[i] < result.values[i - 1]);
  }
}

TEST_CASE("A kink stops nothing before its foot") {
  // |x| + y²: where the gradient jumps is where the minimum is.
  const auto kinked = [](const std::vector<double>& x, std::vector<double>& gradient) {
    gradient = {x[0] < 0.0 ? -1.0 : 1.0, 2.0 * x[1]};
    return std::abs(x[0]) + x[1] * x[1];
  };
  LbfgsOptions options;
  options.max_iterations = 200;
  options.tolerance = 1e-12;
  const LbfgsResult result = minimise(kinked, {1.7, -2.3}, options);
  CHECK(result.values.back() < 0.02);
}

TEST_CASE("Steps are as short as asked for, and stay where the function is defined") {
  std::vector<double> last{3.0, -4.0};
  double longest = 0.0;
  double lowest = last[0];
  const auto watched = [&](const std::vector<double>& x, std::vector<double>& gradient) {
    lowest = std::min(lowest, x[0]);
    if (x[0] < 2.0) return std::numeric_limits<double>::infinity();
    longest = std::max({longest, std::abs(x[0] - last[0]), std::abs(x[1] - last[1])});
    last = x;
    gradient = {2.0 * x[0], 2.0 * x[1]};
    return x[0] * x[0] + x[1] * x[1];
  };
  LbfgsOptions options;
  options.longest_step = 0.1;
  options.max_iterations = 1000;
  const LbfgsResult result = minimise(watched, last, options);
  CHECK(longest <= 0.1 * (1.0 + 1e-12));
  CHECK(longest > 0.09);
  CHECK(lowest < 2.0);
  CHECK(result.x[0] >= 2.0);
  CHECK(result.x[0] < 2.01);
}

TEST_CASE("The bounds on iterations are kept, a minimum is left alone") {
  LbfgsOptions options;
  options.max_iterations = 3;
  CHECK(minimise(rosenbrock, {-1.2, 1.0}, options).values.size() == 4);
  const LbfgsResult there = minimise(rosenbrock, {1.0, 1.0}, options);
  CHECK(there.converged);
  CHECK(there.x == std::vector<double>{1.0, 1.0});

  Progress progress;
  progress.cancel();
  options.progress = &progress;
  CHECK_THROWS_AS(minimise(rosenbrock, {-1.2, 1.0}, options), Cancelled);
}

}  // namespace
}  // namespace lobelight
