#include "image/panorama.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <limits>

#include "base/pi.h"
#include "image/exr.h"
#include "image/file_io.h"
#include "image/image_error.h"
#include "image/radiance_hdr.h"

namespace lobelight {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Of what importing a panorama offers.
constexpr double kLeastExposure = -16.0;

// NaN counts as 0 here too.
double light(float value) {
  return value > 0.0f ? static_cast<double>(value == kInfinity ? kLargestHalf : value) : 0.0;
}

// "1 texel was", "2 texels were" and the like.
std::string texels(std::size_t count, const char* one, const char* many) {
  return count == 1 ? std::string("1 texel ") + one : std::to_string(count) + " texels " + many;
}

// "12.3 %", never "0.0 %" or "100.0 %".
std::string percent(double share) {
  if (share < 0.001) return "less than 0.1 %";
  if (share > 0.999) return "more than 99.9 %";
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", 100.0 * share);
  return text;
}

// What of `exposure` keeps light as bright as `brightest`, in a sentence.
std::string exposure_hint(double exposure, double brightest) {
  const double needed = exposure - std::log2(brightest / static_cast<double>(kLargestHalf));
  if (needed < kLeastExposure) return "no Exposure keeps all of it";
  char text[64];
  // Rounded towards what keeps everything.
  std::snprintf(text, sizeof text, "an Exposure of %.1f EV keeps it",
                std::floor(10.0 * needed) / 10.0);
  return text;
}

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
  float brightest = kLargestHalf;
  for (const float value : rgb) {
    if (value > brightest && value != kInfinity) brightest = value;
  }
  std::size_t changed = 0, negative = 0, no_number = 0, infinite = 0;
  for (std::size_t texel = 0; texel + 2 < rgb.size(); texel += 3) {
    bool is_negative = false, is_no_number = false, is_infinite = false;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      float& value = rgb[texel + channel];
      if (value >= 0.0f && value != kInfinity) continue;
      is_infinite = is_infinite || value == kInfinity;
      is_negative = is_negative || value < 0.0f;
      is_no_number = is_no_number || std::isnan(value);
      value = value == kInfinity ? brightest : 0.0f;
    }
    negative += is_negative ? 1 : 0;
    no_number += is_no_number ? 1 : 0;
    infinite += is_infinite ? 1 : 0;
    changed += is_negative || is_no_number || is_infinite ? 1 : 0;
  }
  if (negative > 0) {
    notes.push_back("has " + texels(negative, "with a negative channel, which is 0 now",
                                    "with negative channels, which are 0 now"));
  }
  if (no_number > 0) {
    notes.push_back("has " + texels(no_number, "with a channel that is no number and is 0 now",
                                    "with channels that are no numbers and are 0 now"));
  }
  if (infinite > 0) {
    char value[32];
    std::snprintf(value, sizeof value, "%.6g", static_cast<double>(brightest));
    warnings.push_back(
        "has " + texels(infinite, "that is infinite and has ", "that are infinite and have ") +
        value + " now; how bright the light was there, the file does not say");
  }
  return changed;
}

void Panorama::brighten(double exposure) {
  if (exposure == 0.0) return;
  const double factor = std::exp2(exposure);
  constexpr double kLargest = std::numeric_limits<float>::max();
  for (float& value : rgb) {
    if (!std::isfinite(value)) continue;
    value = static_cast<float>(std::min(factor * static_cast<double>(value), kLargest));
  }
}

std::size_t Panorama::warn_of_limit(double exposure) {
  if (std::none_of(rgb.begin(), rgb.end(), [](float value) { return value > kLargestHalf; })) {
    return 0;
  }
  std::size_t above = 0;
  double all = 0.0, lost = 0.0, brightest = 0.0;
  std::size_t at = 0;
  for (int row = 0; row < height; ++row) {
    // As much of the sphere as each texel of the row covers, but for a factor.
    const double weight = std::sin(kPi * (row + 0.5) / height);
    for (int column = 0; column < width; ++column) {
      bool is_above = false;
      for (int channel = 0; channel < 3; ++channel, ++at) {
        const double value = std::isfinite(rgb[at]) ? light(rgb[at]) : 0.0;
        const double beyond = std::max(value - static_cast<double>(kLargestHalf), 0.0);
        all += weight * value;
        lost += weight * beyond;
        brightest = std::max(brightest, value);
        is_above = is_above || beyond > 0.0;
      }
      above += is_above ? 1 : 0;
    }
  }
  if (above > 0) {
    warnings.push_back("has " +
                       texels(above, "that is brighter than 65504 and has",
                              "that are brighter than 65504 and have") +
                       " that now: " + percent(lost / all) + " of the light is lost; " +
                       exposure_hint(exposure, brightest));
  }
  return above;
}

std::size_t Panorama::expose(double exposure) {
  brighten(exposure);
  const std::size_t capped = warn_of_limit(exposure);
  if (capped == 0) return 0;
  for (float& value : rgb) value = std::min(value, kLargestHalf);
  return capped;
}

void check_proportions(Panorama& panorama) {
  const std::int64_t width = panorama.width, height = panorama.height;
  // A row or a percent more or less is somebody's rounding.
  if (std::abs(width - 2 * height) <= std::max<std::int64_t>(2, width / 100)) return;
  std::string looks;
  if (width == height) looks = "; a square is a light probe or one face of a cube";
  if (3 * height == 4 * width || 3 * width == 4 * height) looks = "; this may be a cross of a cube";
  if (height == 6 * width || width == 6 * height) looks = "; this may be the faces of a cube";
  panorama.warnings.push_back("is " + std::to_string(width) + " x " + std::to_string(height) +
                              " texels, but a panorama (latitude-longitude, 360 x 180 degrees) is "
                              "twice as wide as high" +
                              looks);
}

void check_panorama_size(std::int64_t width, std::int64_t height, const std::string& name,
                         std::int64_t max_side) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width < 1 || height < 1) throw ImageError(name, "has no pixels (" + size + ")");
  if (width > kMaxPanoramaSide || height > kMaxPanoramaSide ||
      width * height > kMaxPanoramaTexels) {
    throw ImageError(name, "claims " + size + " pixels; the limits are " +
                               std::to_string(kMaxPanoramaSide) + " along a side and " +
                               std::to_string(kMaxPanoramaTexels) + " in all");
  }
  if (width > max_side || height > max_side) {
    throw ImageError(name, "has " + size + " texels, but a texture holds " +
                               std::to_string(max_side) + " along a side; make it smaller");
  }
}

Panorama decode_panorama(const std::vector<std::uint8_t>& bytes, const std::string& name,
                         const std::string& layer, std::int64_t max_side,
                         const Progress* progress) {
  if (bytes.empty()) throw ImageError(name, "is empty");
  Panorama panorama;
  if (looks_like_exr(bytes)) {
    panorama = decode_exr(bytes, name, layer, max_side, progress);
  } else {
    if (!looks_like_radiance_hdr(bytes)) {
      throw ImageError(name, "is neither an OpenEXR nor a Radiance (.hdr) picture");
    }
    if (!layer.empty()) throw ImageError(name, "is a Radiance picture, which has no layers");
    panorama = decode_radiance_hdr(bytes, name, max_side, progress);
  }
  check_proportions(panorama);
  return panorama;
}

Panorama load_panorama(const std::string& path, const std::string& layer, std::int64_t max_side,
                       const Progress* progress) {
  return decode_panorama(read_file(path, progress), path, layer, max_side, progress);
}

std::vector<std::string> panorama_layers(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  if (looks_like_exr(bytes)) return exr_layers(bytes, path);
  return {""};
}

}  // namespace lobelight
