#include "brdf/charlie.h"

#include <algorithm>
#include <cmath>

#include "base/pi.h"

namespace lobelight {

namespace {

double mix(double first, double second, double share) { return first + share * (second - first); }

// L(x) of charlie_lambda().
double charlie_curve(double x, double alpha) {
  const double share = (1.0 - alpha) * (1.0 - alpha);
  const double a = mix(21.5473, 25.3245, share);
  const double b = mix(3.82987, 3.32435, share);
  const double c = mix(0.19823, 0.16801, share);
  const double d = mix(-1.97760, -1.27393, share);
  const double e = mix(-4.32054, -4.85967, share);
  return a / (1.0 + b * std::pow(x, c)) + d * x + e;
}

}  // namespace

double charlie_normal_density(double sine, double alpha) {
  return (2.0 + 1.0 / alpha) * std::pow(sine, 1.0 / alpha) / (2.0 * kPi);
}

double charlie_lambda(double cosine, double alpha) {
  if (cosine < 0.5) return std::exp(charlie_curve(cosine, alpha));
  return std::exp(2.0 * charlie_curve(0.5, alpha) - charlie_curve(1.0 - cosine, alpha));
}

double Charlie::evaluate(const glm::dvec3& i, const glm::dvec3& o) const {
  if (!(i.z > 0.0 && o.z > 0.0)) return 0.0;
  const glm::dvec3 h = glm::normalize(i + o);
  // Not √(1 − h_z²), which cancels for half-vectors near the normal.
  const double sine = std::min(std::hypot(h.x, h.y), 1.0);
  return charlie_normal_density(sine, alpha().x) /
         (4.0 * i.z * o.z *
          (1.0 + charlie_lambda(std::min(i.z, 1.0), alpha().x) +
           charlie_lambda(std::min(o.z, 1.0), alpha().x)));
}

std::optional<BrdfSample> Charlie::sample(const glm::dvec3& o, const glm::dvec2& u) const {
  if (!(o.z > 0.0)) return std::nullopt;
  const double z = 1.0 - u.x;
  if (!(z > 0.0)) return std::nullopt;
  const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
  const double angle = 2.0 * kPi * u.y;
  const glm::dvec3 i =
      glm::normalize(glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), z));
  const double density = 0.5 / kPi;
  return BrdfSample{i, evaluate(i, o) * i.z / density, density};
}

double Charlie::pdf(const glm::dvec3& i, const glm::dvec3& o) const {
  return i.z > 0.0 && o.z > 0.0 ? 0.5 / kPi : 0.0;
}

}  // namespace lobelight
