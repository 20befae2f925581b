#include "brdf/brdf.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "base/one_line.h"
#include "brdf/charlie.h"
#include "brdf/ggx.h"
#include "brdf/measured.h"
#include "brdf/ward.h"

namespace lobelight {

namespace {

constexpr char kCharlie[] = "charlie";

bool valid_width(double alpha) { return alpha >= kMinAlpha && alpha <= kMaxAlpha; }

}  // namespace

const std::vector<std::string>& brdf_names() {
  static const std::vector<std::string> names{"ward", "ward_bounded", "ggx", kCharlie};
  return names;
}

bool is_always_isotropic(std::string_view name) { return name == kCharlie; }

void validate_brdf(std::string_view name, const glm::dvec2& alpha) {
  const bool is_file = is_measured_file(name);
  const bool estimated = is_file && alpha == glm::dvec2(0.0);
  std::ostringstream message;
  // Negated comparisons would let NaN through.
  if (!estimated && (!valid_width(alpha.x) || !valid_width(alpha.y))) {
    message << "alpha is (" << alpha.x << ", " << alpha.y << "), but both widths must be between "
            << kMinAlpha << " and " << kMaxAlpha << ".";
    throw std::invalid_argument(message.str());
  }
  if (is_always_isotropic(name) && (alpha.x != alpha.y || alpha.x > 1.0)) {
    message << "alpha is (" << alpha.x << ", " << alpha.y << "), but the widths of \"" << name
            << "\" must be equal and at most 1.";
    throw std::invalid_argument(message.str());
  }
  const auto& names = brdf_names();
  if (is_file || std::find(names.begin(), names.end(), name) != names.end()) return;
  message << "brdf is \"" << one_line(name) << "\", which is not known; known are";
  const char* separator = " ";
  for (const std::string& known : names) {
    message << separator << '"' << known << '"';
    separator = ", ";
  }
  message << ", and files of measurements (.binary, .bsdf).";
  throw std::invalid_argument(message.str());
}

std::unique_ptr<Brdf> make_brdf(std::string_view name, const glm::dvec2& alpha,
                                const Progress* progress) {
  validate_brdf(name, alpha);
  if (name == "ward") return std::make_unique<Ward>(alpha);
  if (name == "ward_bounded") return std::make_unique<WardBounded>(alpha);
  if (name == "ggx") return std::make_unique<Ggx>(alpha);
  if (name == kCharlie) return std::make_unique<Charlie>(alpha.x);
  const std::string path(name);
  return std::make_unique<MeasuredBrdf>(read_measured(path),
                                        path.substr(path.find_last_of("/\\") + 1), alpha, progress);
}

}  // namespace lobelight
