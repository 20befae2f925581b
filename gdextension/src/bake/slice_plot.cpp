#include "bake/slice_plot.h"

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <tuple>

#include "base/pi.h"
#include "brdf/brdf.h"
#include "brdf/measured.h"
#include "fit/slice.h"

namespace lobelight {

namespace {

constexpr int kMaxPlaneDirections = 100000;

std::shared_ptr<const Brdf> find_brdf(const std::string& brdf, const glm::dvec2& alpha) {
  if (!is_measured_file(brdf)) return make_brdf(brdf, alpha);
  static std::mutex mutex;
  static std::shared_ptr<const Brdf> kept;
  static std::tuple<std::string, std::filesystem::file_time_type, double, double> kept_key;
  std::error_code missing;
  const auto time = std::filesystem::last_write_time(std::filesystem::u8path(brdf), missing);
  const auto key = std::make_tuple(brdf, time, alpha.x, alpha.y);
  {
    const std::lock_guard lock(mutex);
    if (kept && kept_key == key) return kept;
  }
  // Without the lock: who asks for another file need not wait.
  const std::shared_ptr<const Brdf> read = make_brdf(brdf, alpha);
  const std::lock_guard lock(mutex);
  kept = read;
  kept_key = key;
  return read;
}

glm::dvec3 unit_view(const glm::dvec3& view) {
  const double length = glm::length(view);
  if (!(view.z > 0.0) || !std::isfinite(length)) {
    throw std::invalid_argument("view must point above the horizon: its z must be positive.");
  }
  return view / length;
}

}  // namespace

double directional_albedo(const std::string& brdf, const glm::dvec2& alpha,
                          const glm::dvec3& view) {
  const std::shared_ptr<const Brdf> model = find_brdf(brdf, alpha);
  return sample_slice(*model, unit_view(view)).albedo;
}

std::vector<double> slice_in_plane(const std::string& brdf, const glm::dvec2& alpha,
                                   const glm::dvec3& view, int count) {
  if (count < 2 || count > kMaxPlaneDirections) {
    throw std::invalid_argument("count must be from 2 to 100000.");
  }
  const glm::dvec3 o = unit_view(view);
  const double side = std::hypot(o.x, o.y);
  const glm::dvec2 azimuth = side > 0.0 ? glm::dvec2(o.x, o.y) / side : glm::dvec2(1.0, 0.0);
  const std::shared_ptr<const Brdf> model = find_brdf(brdf, alpha);
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n) {
    const double angle = kPi * (n / (count - 1.0) - 0.5);
    const glm::dvec3 i(std::sin(angle) * azimuth, std::cos(angle));
    values.push_back(model->evaluate(i, o) * i.z);
  }
  return values;
}

}  // namespace lobelight
