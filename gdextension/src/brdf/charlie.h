#pragma once

#include "brdf/brdf.h"

namespace lobelight {

// Density of the normals of upright fibres, alpha in (0, 1], for the sine of the angle between the
// half-vector and the normal:
//   D(h) = (2 + 1/α) sin^{1/α}(θ_h) / (2π)
// Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF", eq. 2.
double charlie_normal_density(double sine, double alpha);

// Λ(v) for the cosine of a direction above the horizon, a curve fitted to Smith's integral:
//   Λ(c) = e^{L(c)} for c < 0.5, e^{2 L(0.5) − L(1 − c)} from there on,
//   L(x) = a / (1 + b x^c) + d x + e,  each of a … e mixed between α = 1 and 0 by (1 − α)².
// Estevez and Kulla 2017, eq. 3 and table 1.
double charlie_lambda(double cosine, double alpha);

// The sheen of cloth, as glTF's KHR_materials_sheen has it: microfacet reflection with the normals
// of "Charlie", ρ(i, o) = D(h) / (4 i_z o_z (1 + Λ(i) + Λ(o))). The glTF text also allows a
// visibility without Λ (Ashikhmin and Premože 2007), but notes that what lies below then gets too
// much light: its albedo exceeds 1 at grazing views. The paper's softened terminator is left out,
// because it is not reciprocal. Isotropic: both widths are equal. Samples the hemisphere evenly,
// which is what the paper does, too.
class Charlie final : public Brdf {
 public:
  explicit Charlie(double alpha) : Brdf(glm::dvec2(alpha)) {}
  double evaluate(const glm::dvec3& i, const glm::dvec3& o) const override;
  std::optional<BrdfSample> sample(const glm::dvec3& o, const glm::dvec2& u) const override;
  double pdf(const glm::dvec3& i, const glm::dvec3& o) const override;
  std::string_view name() const override { return "charlie"; }
};

}  // namespace lobelight
