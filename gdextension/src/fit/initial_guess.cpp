#include "fit/initial_guess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace lobelight {

namespace {

// Sharpness given to a set whose directions are all the same.
constexpr double kMaxGuessKappa = 1e8;

// Differences below this share of the total variance are rounding: axes that are equally good to
// this precision must not be chosen by it.
constexpr double kNegligible = 1e-9;

// Two axes whose variances differ by less than this share of the total count as equally good: the
// quadrature of a round slice makes neither of them a choice.
constexpr double kTie = 0.01;

// Unit eigenvector of the largest eigenvalue of a symmetric matrix by Jacobi's rotations (Golub and
// Van Loan, Matrix Computations, 8.5). Of equally good axes the first wins.
glm::dvec3 principal_axis(glm::dmat3 a) {
  glm::dmat3 vectors(1.0);
  const double trace = a[0][0] + a[1][1] + a[2][2];
  const double negligible = kNegligible * trace;
  const double tie = kTie * trace;
  constexpr std::array<std::array<int, 2>, 3> kPlanes{{{0, 1}, {0, 2}, {1, 2}}};
  for (int sweep = 0; sweep < 32; ++sweep) {
    bool done = true;
    for (const auto& [p, q] : kPlanes) {
      if (!(std::abs(a[p][q]) > negligible)) continue;
      done = false;
      const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
      const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
      const double c = 1.0 / std::hypot(t, 1.0);
      glm::dmat3 rotation(1.0);
      rotation[p][p] = rotation[q][q] = c;
      rotation[p][q] = -t * c;
      rotation[q][p] = t * c;
      a = glm::transpose(rotation) * a * rotation;
      vectors = vectors * rotation;
    }
    if (done) break;
  }
  int best = 0;
  for (int i = 1; i < 3; ++i) {
    if (a[i][i] > a[best][best] + tie) best = i;
  }
  const glm::dvec3 axis = vectors[best];
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

  // Shares of the mass: squares of what measured data may weigh, 1e300 or 1e-300, are no numbers.
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
      // More sets than directions (or directions that cancel): the direction where it would be.
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
