#include "brdf/ggx.h"

#include <algorithm>
#include <cmath>

#include "base/pi.h"

namespace lobelight {

namespace {

bool above_horizon(const glm::dvec3& i, const glm::dvec3& o) { return i.z > 0.0 && o.z > 0.0; }

// Density of visible normals G1(o) D(h) (o·h)/o_z, times dω_h/dω_i = 1/(4 o·h).
double visible_normal_pdf(const glm::dvec3& h, const glm::dvec3& o, const glm::dvec2& alpha) {
  return ggx_normal_density(h, alpha) / (4.0 * o.z * (1.0 + ggx_lambda(o, alpha)));
}

// Heitz 2018, listing 1: the ellipsoid becomes a hemisphere when stretched; its visible part is a
// full disc and half an ellipse, which is sampled and projected back.
glm::dvec3 sample_visible_normal(const glm::dvec3& o, const glm::dvec2& u,
                                 const glm::dvec2& alpha) {
  const glm::dvec3 v = glm::normalize(glm::dvec3(alpha.x * o.x, alpha.y * o.y, o.z));
  const double length2 = v.x * v.x + v.y * v.y;
  const glm::dvec3 t1 =
      length2 > 0.0 ? glm::dvec3(-v.y, v.x, 0.0) / std::sqrt(length2) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 t2 = glm::cross(v, t1);

  const double radius = std::sqrt(u.x);
  const double angle = 2.0 * kPi * u.y;
  const double p1 = radius * std::cos(angle);
  const double share = 0.5 * (1.0 + v.z);
  const double p2 =
      (1.0 - share) * std::sqrt(std::max(0.0, 1.0 - p1 * p1)) + share * radius * std::sin(angle);
  const glm::dvec3 n = p1 * t1 + p2 * t2 + std::sqrt(std::max(0.0, 1.0 - p1 * p1 - p2 * p2)) * v;
  return glm::normalize(glm::dvec3(alpha.x * n.x, alpha.y * n.y, std::max(0.0, n.z)));
}

}  // namespace

double ggx_normal_density(const glm::dvec3& h, const glm::dvec2& alpha) {
  const double x = h.x / alpha.x;
  const double y = h.y / alpha.y;
  const double s = x * x + y * y + h.z * h.z;
  return 1.0 / (kPi * alpha.x * alpha.y * s * s);
}

double ggx_lambda(const glm::dvec3& v, const glm::dvec2& alpha) {
  const double x = alpha.x * v.x;
  const double y = alpha.y * v.y;
  const double a = (x * x + y * y) / (v.z * v.z);
  // (√(1 + a) − 1)/2 without its cancellation for small a.
  return 0.5 * a / (std::sqrt(1.0 + a) + 1.0);
}

double Ggx::evaluate(const glm::dvec3& i, const glm::dvec3& o) const {
  if (!above_horizon(i, o)) return 0.0;
  const glm::dvec3 h = glm::normalize(i + o);
  return ggx_normal_density(h, alpha()) /
         (4.0 * i.z * o.z * (1.0 + ggx_lambda(i, alpha()) + ggx_lambda(o, alpha())));
}

std::optional<BrdfSample> Ggx::sample(const glm::dvec3& o, const glm::dvec2& u) const {
  if (!(o.z > 0.0)) return std::nullopt;
  const glm::dvec3 h = sample_visible_normal(o, u, alpha());
  const glm::dvec3 i = glm::normalize(2.0 * glm::dot(o, h) * h - o);
  if (!(i.z > 0.0)) return std::nullopt;
  // ρ i_z / pdf = G2/G1 = (1 + Λ(o)) / (1 + Λ(i) + Λ(o))
  const double lambda_o = ggx_lambda(o, alpha());
  const double weight = (1.0 + lambda_o) / (1.0 + ggx_lambda(i, alpha()) + lambda_o);
  return BrdfSample{i, weight, visible_normal_pdf(h, o, alpha())};
}

double Ggx::pdf(const glm::dvec3& i, const glm::dvec3& o) const {
  if (!above_horizon(i, o)) return 0.0;
  return visible_normal_pdf(glm::normalize(i + o), o, alpha());
}

}  // namespace lobelight
