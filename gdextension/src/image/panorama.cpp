#include "image/panorama.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "base/pi.h"
#include "image/exr.h"
#include "image/file_io.h"
#include "image/image_error.h"
#include "image/radiance_hdr.h"

namespace lobelight {
namespace {

bool is_light(float value) { return value >= 0.0f && std::isfinite(value); }

double light(float value) { return is_light(value) ? static_cast<double>(value) : 0.0; }

}  // namespace

glm::dvec2 panorama_position(const glm::dvec3& direction) {
  const double turn = std::atan2(direction.x, -direction.z) / (2.0 * kPi);
  // A tiny negative turn rounds up to 1, which is 0 again.
  const double u = turn - std::floor(turn);
  return {u < 1.0 ? u : 0.0, std::acos(glm::clamp(direction.y, -1.0, 1.0)) / kPi};
}

glm::dvec3 panorama_direction(const glm::dvec2& position) {
  const double azimuth = 2.0 * kPi * position.x;
  const double polar = kPi * position.y;
  const double radius = std::sin(polar);
  return {radius * std::sin(azimuth), std::cos(polar), -radius * std::cos(azimuth)};
}

glm::dvec3 Panorama::sample(const glm::dvec3& direction) const {
  const glm::dvec2 position = panorama_position(direction);
  const double x = position.x * width - 0.5;
  const double y = glm::clamp(position.y * height - 0.5, 0.0, height - 1.0);
  const double left = std::floor(x);
  const double top = std::floor(y);
  const double weight_x = x - left;
  const double weight_y = y - top;
  const int columns[2] = {left < 0.0 ? width - 1 : static_cast<int>(left),
                          left + 1.0 < width ? static_cast<int>(left) + 1 : 0};
  const int rows[2] = {static_cast<int>(top), std::min(static_cast<int>(top) + 1, height - 1)};

  glm::dvec3 sum(0.0);
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const std::size_t texel =
          static_cast<std::size_t>(rows[j]) * static_cast<std::size_t>(width) +
          static_cast<std::size_t>(columns[i]);
      const float* value = &rgb[3 * texel];
      const double weight =
          (i == 0 ? 1.0 - weight_x : weight_x) * (j == 0 ? 1.0 - weight_y : weight_y);
      sum += weight * glm::dvec3(light(value[0]), light(value[1]), light(value[2]));
    }
  }
  return sum;
}

std::size_t Panorama::sanitise() {
  std::size_t changed = 0;
  for (std::size_t texel = 0; texel + 2 < rgb.size(); texel += 3) {
    bool touched = false;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      float& value = rgb[texel + channel];
      if (is_light(value)) continue;
      value = 0.0f;
      touched = true;
    }
    changed += touched ? 1 : 0;
  }
  return changed;
}

void check_panorama_size(std::int64_t width, std::int64_t height, const std::string& name) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width < 1 || height < 1) throw ImageError(name, "has no pixels (" + size + ")");
  if (width > kMaxPanoramaSide || height > kMaxPanoramaSide ||
      width * height > kMaxPanoramaTexels) {
    throw ImageError(name, "claims " + size + " pixels; the limits are " +
                               std::to_string(kMaxPanoramaSide) + " along a side and " +
                               std::to_string(kMaxPanoramaTexels) + " in all");
  }
}

Panorama decode_panorama(const std::vector<std::uint8_t>& bytes, const std::string& name,
                         const std::string& layer) {
  if (bytes.empty()) throw ImageError(name, "is empty");
  if (looks_like_exr(bytes)) return decode_exr(bytes, name, layer);
  if (!looks_like_radiance_hdr(bytes)) {
    throw ImageError(name, "is neither an OpenEXR nor a Radiance (.hdr) picture");
  }
  if (!layer.empty()) throw ImageError(name, "is a Radiance picture, which has no layers");
  return decode_radiance_hdr(bytes, name);
}

Panorama load_panorama(const std::string& path, const std::string& layer) {
  return decode_panorama(read_file(path), path, layer);
}

std::vector<std::string> panorama_layers(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  if (looks_like_exr(bytes)) return exr_layers(bytes, path);
  return {""};
}

}  // namespace lobelight
