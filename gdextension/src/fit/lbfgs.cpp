#include "fit/lbfgs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <utility>

namespace lobelight {

namespace {

using Vector = std::vector<double>;

// Differences that stand for the Hessian.
constexpr std::size_t kMemory = 8;

double dot(const Vector& a, const Vector& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void add_scaled(Vector& to, double scale, const Vector& what) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += scale * what[i];
}

// What two successive points say of the Hessian.
struct Difference {
  Vector place;
  Vector gradient;
  double inverse_product;
};

// Algorithm 7.4: the inverse Hessian times the gradient, as `memory` (oldest first) knows it.
Vector newton_direction(const Vector& gradient, const std::deque<Difference>& memory) {
  Vector direction = gradient;
  Vector factors(memory.size());
  for (std::size_t i = memory.size(); i-- > 0;) {
    factors[i] = memory[i].inverse_product * dot(memory[i].place, direction);
    add_scaled(direction, -factors[i], memory[i].gradient);
  }
  if (!memory.empty()) {
    const Difference& newest = memory.back();
    const double scale = 1.0 / (newest.inverse_product * dot(newest.gradient, newest.gradient));
    for (double& component : direction) component *= scale;
  }
  for (std::size_t i = 0; i < memory.size(); ++i) {
    const double back = memory[i].inverse_product * dot(memory[i].gradient, direction);
    add_scaled(direction, factors[i] - back, memory[i].place);
  }
  return direction;
}

}  // namespace

LbfgsResult minimise(const Objective& objective, Vector start, const LbfgsOptions& options) {
  constexpr double kSufficientDecrease = 1e-4;
  constexpr int kMostHalvings = 20;

  LbfgsResult result;
  result.x = std::move(start);
  Vector gradient(result.x.size());
  result.values.push_back(objective(result.x, gradient));
  std::deque<Difference> memory;
  Vector next(result.x.size());
  Vector next_gradient(result.x.size());
  for (int iteration = 0; iteration < options.max_iterations && !result.converged; ++iteration) {
    if (options.progress) options.progress->throw_if_cancelled();
    const double value = result.values.back();
    Vector direction = newton_direction(gradient, memory);
    double descent = dot(gradient, direction);
    if (!(descent > 0.0)) {
      memory.clear();
      direction = gradient;
      descent = dot(gradient, gradient);
    }
    double longest = 0.0;
    for (const double component : direction) longest = std::max(longest, std::abs(component));
    double step = longest > options.longest_step ? options.longest_step / longest : 1.0;
    double next_value = value;
    bool lower = false;
    for (int halving = 0; halving < kMostHalvings && !lower && descent > 0.0; ++halving) {
      next = result.x;
      add_scaled(next, -step, direction);
      next_value = objective(next, next_gradient);
      lower = next_value <= value - kSufficientDecrease * step * descent;
      step *= 0.5;
    }
    if (!lower) {
      // A direction that was made up of what was remembered may be a bad one; the gradient is not.
      result.converged = memory.empty();
      memory.clear();
      continue;
    }
    Difference difference{next, next_gradient, 0.0};
    add_scaled(difference.place, -1.0, result.x);
    add_scaled(difference.gradient, -1.0, gradient);
    const double product = dot(difference.place, difference.gradient);
    if (product > 1e-12 * dot(difference.gradient, difference.gradient)) {
      difference.inverse_product = 1.0 / product;
      memory.push_back(std::move(difference));
      if (memory.size() > kMemory) memory.pop_front();
    }
    result.x.swap(next);
    gradient.swap(next_gradient);
    result.values.push_back(next_value);
    result.converged = value - next_value < options.tolerance;
  }
  return result;
}

}  // namespace lobelight
