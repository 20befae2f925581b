#pragma once

#include "brdf/brdf.h"

namespace lobelight {

// Anisotropic GGX (Trowbridge–Reitz): density of the normals at the unit vector h, h_z > 0:
//   D(h) = 1 / (π α_x α_y ((h_x/α_x)² + (h_y/α_y)² + h_z²)²)
// Heitz 2014, "Understanding the masking-shadowing function in microfacet-based BRDFs", eq. 85.
double ggx_normal_density(const glm::dvec3& h, const glm::dvec2& alpha);

// Smith's Λ(v) = (√(1 + (α_x² v_x² + α_y² v_y²)/v_z²) − 1)/2, v_z > 0; G1 = 1/(1 + Λ).
// Heitz 2014, eqs. 72 and 86.
double ggx_lambda(const glm::dvec3& v, const glm::dvec2& alpha);

// Microfacet reflection with GGX normals and Smith's height-correlated masking and shadowing
// (Heitz 2014, eq. 99): ρ(i, o) = D(h) / (4 i_z o_z (1 + Λ(i) + Λ(o))).
// Samples visible normals: Heitz 2018, "Sampling the GGX distribution of visible normals".
class Ggx final : public Brdf {
 public:
  explicit Ggx(const glm::dvec2& alpha) : Brdf(alpha) {}
  double evaluate(const glm::dvec3& i, const glm::dvec3& o) const override;
  std::optional<BrdfSample> sample(const glm::dvec3& o, const glm::dvec2& u) const override;
  double pdf(const glm::dvec3& i, const glm::dvec3& o) const override;
  std::string_view name() const override { return "ggx"; }
};

}  // namespace lobelight
