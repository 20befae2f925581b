#include "fit/em_acceleration.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/symmetric_eigen.h"

namespace lobelight {

namespace {

using Vector = std::vector<double>;

// A lobe in coordinates without bounds: ln π, the mean, ln(1 + κ).
constexpr std::size_t kCoordinates = 5;

Vector coordinates_of(const Mixture& mixture) {
  Vector v;
  v.reserve(kCoordinates * mixture.size());
  for (const Lobe& lobe : mixture) {
    const glm::dvec3& mean = lobe.gaussian.mean;
    v.insert(v.end(),
             {std::log(lobe.weight), mean.x, mean.y, mean.z, std::log1p(lobe.gaussian.kappa)});
  }
  return v;
}

// The lobes at coordinates `v`, their weights summing to 1. A mean that vanishes, which only lobes
// without any sharpness can have, stays what it was.
Mixture mixture_at(const Vector& v, const Mixture& before) {
  Mixture mixture = before;
  double sum = 0.0;
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const double* at = &v[kCoordinates * k];
    mixture[k].weight = std::exp(at[0]);
    const glm::dvec3 mean(at[1], at[2], at[3]);
    const double length = glm::length(mean);
    if (length > 1e-6) mixture[k].gaussian.mean = mean / length;
    mixture[k].gaussian.kappa = std::max(0.0, std::expm1(at[4]));
    sum += mixture[k].weight;
  }
  for (Lobe& lobe : mixture) lobe.weight /= sum;
  return mixture;
}

// The unit of each coordinate: the standard deviation of its estimate from one sample of the lobe,
// 1, 1/√κ and 1.
Vector units_of(const Mixture& mixture) {
  Vector units;
  units.reserve(kCoordinates * mixture.size());
  for (const Lobe& lobe : mixture) {
    const double sharpness = std::sqrt(lobe.gaussian.kappa);
    units.insert(units.end(), {1.0, sharpness, sharpness, sharpness, 1.0});
  }
  return units;
}

double dot(const Vector& a, const Vector& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void add(Vector& a, double factor, const Vector& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
}

Vector product(const Vector& a, const Vector& b) {
  Vector c(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) c[i] = a[i] * b[i];
  return c;
}

}  // namespace

Mixture EmAcceleration::propose(const Mixture& before, const Mixture& after) {
  const Vector place = coordinates_of(before);
  Vector step = coordinates_of(after);
  add(step, -1.0, place);

  if (!previous_place_.empty()) {
    Difference difference{place, step};
    add(difference.place, -1.0, previous_place_);
    add(difference.step, -1.0, previous_step_);
    memory_.push_front(std::move(difference));
    if (memory_.size() > kMemory) memory_.pop_back();
  }
  previous_place_ = place;
  previous_step_ = step;
  if (memory_.size() < 2) return after;

  // The metric: the complete-data Fisher information, π times the squared units.
  const Vector units = units_of(before);
  Vector metric = units;
  for (std::size_t i = 0; i < metric.size(); ++i) {
    metric[i] *= std::sqrt(before[i / kCoordinates].weight);
  }

  // An orthonormal basis q of the remembered places, and t, how EM's step changes along each.
  std::vector<Vector> q;
  std::vector<Vector> t;
  for (const Difference& difference : memory_) {
    Vector direction = product(difference.place, metric);
    Vector change = product(difference.step, metric);
    const double whole = std::sqrt(dot(direction, direction));
    for (std::size_t i = 0; i < q.size(); ++i) {
      const double along = dot(q[i], direction);
      add(direction, -along, q[i]);
      add(change, -along, t[i]);
    }
    const double rest = std::sqrt(dot(direction, direction));
    if (!(rest > 1e-6 * whole)) continue;  // nothing new
    for (double& x : direction) x /= rest;
    for (double& x : change) x /= rest;
    q.push_back(std::move(direction));
    t.push_back(std::move(change));
  }

  // 1 − EM's Jacobian within the subspace, its symmetric part.
  Matrix3 contraction{};
  Matrix3 vectors{};
  for (std::size_t i = 0; i < q.size(); ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) {
      contraction[i][j] = -0.5 * (dot(q[i], t[j]) + dot(q[j], t[i]));
    }
  }
  diagonalise(contraction, vectors, q.size(), 1e-15, 0.0);

  const Vector whitened = product(step, metric);
  std::array<double, kMemory> component{};
  for (std::size_t i = 0; i < q.size(); ++i) component[i] = dot(q[i], whitened);
  Vector further(step.size(), 0.0);
  for (std::size_t e = 0; e < q.size(); ++e) {
    double along = 0.0;
    for (std::size_t i = 0; i < q.size(); ++i) along += vectors[i][e] * component[i];
    const double factor = 1.0 / std::max(std::abs(contraction[e][e]), kLeastContraction) - 1.0;
    for (std::size_t i = 0; i < q.size(); ++i) add(further, factor * along * vectors[i][e], q[i]);
  }
  for (std::size_t i = 0; i < step.size(); ++i) {
    if (metric[i] > 0.0) step[i] += further[i] / metric[i];
  }

  double longest = 0.0;
  for (std::size_t i = 0; i < step.size(); ++i) {
    longest = std::max(longest, std::abs(step[i]) * units[i]);
  }
  Vector proposed = place;
  add(proposed, longest > longest_step_ ? longest_step_ / longest : 1.0, step);
  return mixture_at(proposed, before);
}

}  // namespace lobelight
