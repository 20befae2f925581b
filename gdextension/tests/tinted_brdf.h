#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "brdf/ggx.h"

namespace lobelight::testing {

// GGX in a colour; sampled as what it is by its mean.
class Tinted final : public Brdf {
 public:
  Tinted(const glm::dvec2& alpha, const glm::dvec3& tint)
      : Brdf(alpha), grey_(alpha), tint_(tint), mean_((tint.x + tint.y + tint.z) / 3.0) {}

  double evaluate(const glm::dvec3& i, const glm::dvec3& o) const override {
    return mean_ * grey_.evaluate(i, o);
  }
  glm::dvec3 evaluate_rgb(const glm::dvec3& i, const glm::dvec3& o) const override {
    return tint_ * grey_.evaluate(i, o);
  }
  std::optional<BrdfSample> sample(const glm::dvec3& o, const glm::dvec2& u) const override {
    auto drawn = grey_.sample(o, u);
    if (drawn) drawn->weight *= mean_;
    return drawn;
  }
  double pdf(const glm::dvec3& i, const glm::dvec3& o) const override { return grey_.pdf(i, o); }
  std::string_view name() const override { return "tinted"; }
  bool is_coloured() const override { return true; }

 private:
  Ggx grey_;
  glm::dvec3 tint_;
  double mean_;
};

}  // namespace lobelight::testing
