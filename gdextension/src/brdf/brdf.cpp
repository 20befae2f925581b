#include "brdf/brdf.h"

#include <sstream>
#include <stdexcept>

#include "brdf/ggx.h"
#include "brdf/measured.h"
#include "brdf/ward.h"

namespace lobelight {

namespace {

bool valid_width(double alpha) { return alpha >= kMinAlpha && alpha <= kMaxAlpha; }

}  // namespace

const std::vector<std::string>& brdf_names() {
  static const std::vector<std::string> names{"ward", "ward_bounded", "ggx"};
  return names;
}

std::unique_ptr<Brdf> make_brdf(std::string_view name, const glm::dvec2& alpha,
                                const Progress* progress) {
  const bool is_file = is_measured_file(name);
  const bool estimated = is_file && alpha == glm::dvec2(0.0);
  // Negated comparisons would let NaN through.
  if (!estimated && (!valid_width(alpha.x) || !valid_width(alpha.y))) {
    std::ostringstream message;
    message << "alpha is (" << alpha.x << ", " << alpha.y << "), but both widths must be between "
            << kMinAlpha << " and " << kMaxAlpha << ".";
    throw std::invalid_argument(message.str());
  }
  if (is_file) {
    const std::string path(name);
    return std::make_unique<MeasuredBrdf>(
        read_measured(path), path.substr(path.find_last_of("/\\") + 1), alpha, progress);
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
  message << ", and files of measurements (.binary, .bsdf).";
  throw std::invalid_argument(message.str());
}

}  // namespace lobelight
