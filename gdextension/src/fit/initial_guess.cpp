#include "fit/initial_guess.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "fit/symmetric_eigen.h"

namespace lobelight {

namespace {

// Sharpness given to a set whose directions are all the same.
constexpr double kMaxGuessKappa = 1e8;

// Variances that differ by less than this share of the total differ by rounding only; rounding must
// not choose the axis.
constexpr double kNegligible = 1e-9;

// Two axes whose variances differ by less than this share of the total count as equal: a round
// slice has no preferred axis, and its quadrature must not choose one.
constexpr double kTie = 0.01;

// Unit eigenvector of the largest eigenvalue of a symmetric matrix. Of equally good axes the first
// wins.
glm::dvec3 principal_axis(const glm::dmat3& matrix) {
  const double trace = matrix[0][0] + matrix[1][1] + matrix[2][2];
  const double tie = kTie * trace;
  Matrix3 a{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) a[i][j] = matrix[static_cast<int>(i)][static_cast<int>(j)];
  }
  Matrix3 vectors{};
  diagonalise(a, vectors, 3, 0.0, kNegligible * trace);
  std::size_t best = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (a[i][i] > a[best][best] + tie) best = i;
  }
  const glm::dvec3 axis(vectors[0][best], vectors[1][best], vectors[2][best]);
  // An eigenvector's sign is free: its largest component is made positive.
  int largest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(axis[i]) > std::abs(axis[largest]) + kNegligible) largest = i;
  }
  return axis[largest] < 0.0 ? -axis : axis;
}

struct Sums {
  double weight = 0.0;
  glm::dvec3 direction{0.0};
};

}  // namespace

Mixture initial_guess(const Slice& slice, int lobes) {
  if (lobes < 1) throw std::invalid_argument("initial_guess needs at least one lobe.");
  if (!is_usable(slice)) return initial_guess(usable_nodes(slice), lobes);
  const std::size_t count = slice.directions.size();
  const auto set_count = static_cast<std::size_t>(lobes);
  if (count == 0 || !(slice.albedo > 0.0)) return Mixture(set_count);

  // Weights as shares of the mass: measured data may weigh 1e300 or 1e-300, whose squares overflow
  // or vanish.
  std::vector<double> share(count);
  for (std::size_t n = 0; n < count; ++n) share[n] = slice.weights[n] / slice.albedo;

  glm::dvec3 centre(0.0);
  for (std::size_t n = 0; n < count; ++n) centre += share[n] * slice.directions[n];
  glm::dmat3 covariance(0.0);
  for (std::size_t n = 0; n < count; ++n) {
    const glm::dvec3 d = slice.directions[n] - centre;
    covariance += share[n] * glm::outerProduct(d, d);
  }
  const glm::dvec3 axis = principal_axis(covariance);

  std::vector<double> position(count);
  for (std::size_t n = 0; n < count; ++n) position[n] = glm::dot(slice.directions[n], axis);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return position[a] < position[b]; });

  // A node belongs to the set in which the middle of its mass falls.
  std::vector<std::size_t> set_of(count);
  std::vector<Sums> sums(set_count);
  double before = 0.0;
  for (const std::size_t n : order) {
    const double middle = before + 0.5 * share[n];
    const auto set = std::min(set_count - 1, static_cast<std::size_t>(middle * lobes));
    set_of[n] = set;
    sums[set].weight += share[n];
    sums[set].direction += share[n] * slice.directions[n];
    before += share[n];
  }

  Mixture mixture(set_count);
  for (std::size_t k = 0; k < set_count; ++k) {
    mixture[k].weight = slice.albedo / lobes;
    const double length = glm::length(sums[k].direction);
    if (length > 0.0) {
      mixture[k].gaussian.mean = sums[k].direction / length;
    } else {
      // The set is empty, or its directions cancel: take the direction at its place in the order.
      const std::size_t place = (2 * k + 1) * count / (2 * set_count);
      mixture[k].gaussian.mean = slice.directions[order[place]];
    }
  }
  // 1 − R̄ = Σ w |x − μ|² / 2 Σ w: exact for unit vectors, and nothing cancels in narrow sets.
  std::vector<double> spread(set_count, 0.0);
  for (std::size_t n = 0; n < count; ++n) {
    const glm::dvec3 d = slice.directions[n] - mixture[set_of[n]].gaussian.mean;
    spread[set_of[n]] += share[n] * glm::dot(d, d);
  }
  for (std::size_t k = 0; k < set_count; ++k) {
    const double one_minus_r = sums[k].weight > 0.0 ? 0.5 * spread[k] / sums[k].weight : 0.0;
    mixture[k].gaussian.kappa =
        std::min(kMaxGuessKappa, kappa_from_one_minus_mean_resultant(one_minus_r));
  }
  return mixture;
}

}  // namespace lobelight
