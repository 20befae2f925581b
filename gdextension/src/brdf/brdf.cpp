#include "brdf/brdf.h"

#include <sstream>
#include <stdexcept>

#include "brdf/ggx.h"
#include "brdf/ward.h"

namespace lobelight {

namespace {

bool valid_width(double alpha) { return alpha >= kMinAlpha && alpha <= kMaxAlpha; }

}  // namespace

const std::vector<std::string>& brdf_names() {
  static const std::vector<std::string> names{"ward", "ward_bounded", "ggx"};
  return names;
}

std::unique_ptr<Brdf> make_brdf(std::string_view name, const glm::dvec2& alpha) {
  // Negated comparisons would let NaN through.
  if (!valid_width(alpha.x) || !valid_width(alpha.y)) {
    std::ostringstream message;
    message << "alpha is (" << alpha.x << ", " << alpha.y << "), but both widths must be between "
            << kMinAlpha << " and " << kMaxAlpha << ".";
    throw std::invalid_argument(message.str());
  }
  if (name == "ward") return std::make_unique<Ward>(alpha);
  if (name == "ward_bounded") return std::make_unique<WardBounded>(alpha);
  if (name == "ggx") return std::make_unique<Ggx>(alpha);

  std::ostringstream message;
  message << "brdf is \"" << name << "\", which is not known; known are";
  const char* separator = " ";
  for (const std::string& known : brdf_names()) {
    message << separator << '"' << known << '"';
    separator = ", ";
  }
  message << '.';
  throw std::invalid_argument(message.str());
}

}  // namespace lobelight
