#include "brdf/ward.h"

#include <cmath>

#include "base/pi.h"

namespace lobelight {

namespace {

// e^{−(h_x²/α_x² + h_y²/α_y²)/h_z²}; any positive multiple of h will do.
double slope_gaussian(const glm::dvec3& h, const glm::dvec2& alpha) {
  const double x = h.x / (alpha.x * h.z);
  const double y = h.y / (alpha.y * h.z);
  return std::exp(-(x * x + y * y));
}

bool above_horizon(const glm::dvec3& i, const glm::dvec3& o) { return i.z > 0.0 && o.z > 0.0; }

struct HalfVectorSample {
  glm::dvec3 i;
  glm::dvec3 h;
  double o_dot_h;
  double pdf;  // of i
};

// Both models: half-vector slopes (h_x, h_y)/h_z with the density e^{−…}/(π α_x α_y) (Ward 1992,
// eqs. 6 and 7), the view mirrored at h. Since d(slopes) = dω_h / h_z³ and dω_i = 4(o·h) dω_h,
//   pdf(i) = e^{−…} / (4π α_x α_y h_z³ (o·h)).
double half_vector_pdf(const glm::dvec3& h, double o_dot_h, const glm::dvec2& alpha) {
  return slope_gaussian(h, alpha) / (4.0 * kPi * alpha.x * alpha.y * h.z * h.z * h.z * o_dot_h);
}

std::optional<HalfVectorSample> sample_half_vector(const glm::dvec3& o, const glm::dvec2& u,
                                                   const glm::dvec2& alpha) {
  if (!(o.z > 0.0)) return std::nullopt;
  const double radius = std::sqrt(-std::log1p(-u.x));
  const double angle = 2.0 * kPi * u.y;
  const glm::dvec3 h = glm::normalize(
      glm::dvec3(alpha.x * radius * std::cos(angle), alpha.y * radius * std::sin(angle), 1.0));
  const double o_dot_h = glm::dot(o, h);
  if (!(o_dot_h > 0.0)) return std::nullopt;
  const glm::dvec3 i = glm::normalize(2.0 * o_dot_h * h - o);
  if (!(i.z > 0.0)) return std::nullopt;
  return HalfVectorSample{i, h, o_dot_h, half_vector_pdf(h, o_dot_h, alpha)};
}

double half_vector_sampler_pdf(const glm::dvec3& i, const glm::dvec3& o, const glm::dvec2& alpha) {
  if (!above_horizon(i, o)) return 0.0;
  const glm::dvec3 h = glm::normalize(i + o);
  return half_vector_pdf(h, glm::dot(o, h), alpha);
}

}  // namespace

double Ward::evaluate(const glm::dvec3& i, const glm::dvec3& o) const {
  if (!above_horizon(i, o)) return 0.0;
  return slope_gaussian(i + o, alpha()) /
         (4.0 * kPi * alpha().x * alpha().y * std::sqrt(i.z * o.z));
}

std::optional<BrdfSample> Ward::sample(const glm::dvec3& o, const glm::dvec2& u) const {
  const auto s = sample_half_vector(o, u, alpha());
  if (!s) return std::nullopt;
  // ρ i_z / pdf = √(i_z/o_z) (o·h) h_z³
  const double weight = std::sqrt(s->i.z / o.z) * s->o_dot_h * s->h.z * s->h.z * s->h.z;
  return BrdfSample{s->i, weight, s->pdf};
}

double Ward::pdf(const glm::dvec3& i, const glm::dvec3& o) const {
  return half_vector_sampler_pdf(i, o, alpha());
}

double WardBounded::evaluate(const glm::dvec3& i, const glm::dvec3& o) const {
  if (!above_horizon(i, o)) return 0.0;
  // With h = i + o not normalised, 1/((o·ĥ)² ĥ_z⁴) = 4 (h·h)/h_z⁴.
  const glm::dvec3 h = i + o;
  const double hz2 = h.z * h.z;
  return slope_gaussian(h, alpha()) * glm::dot(h, h) / (kPi * alpha().x * alpha().y * hz2 * hz2);
}

std::optional<BrdfSample> WardBounded::sample(const glm::dvec3& o, const glm::dvec2& u) const {
  const auto s = sample_half_vector(o, u, alpha());
  if (!s) return std::nullopt;
  // ρ i_z / pdf = i_z / ((o·h) h_z) = 2 i_z / (i_z + o_z)
  return BrdfSample{s->i, 2.0 * s->i.z / (s->i.z + o.z), s->pdf};
}

double WardBounded::pdf(const glm::dvec3& i, const glm::dvec3& o) const {
  return half_vector_sampler_pdf(i, o, alpha());
}

}  // namespace lobelight
