#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "brdf/brdf.h"

namespace lobelight::testing {

// The model of these widths; of the first alone, where a model has one only.
inline std::unique_ptr<Brdf> model(const std::string& name, const glm::dvec2& alpha) {
  return make_brdf(name, is_always_isotropic(name) ? glm::dvec2(std::min(alpha.x, 1.0)) : alpha);
}

}  // namespace lobelight::testing
