#include "image/panorama_faces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/pi.h"
#include "image/cube_faces.h"
#include "image/round_kernel.h"

namespace lobelight {

namespace {

// The sRGB decoding of IEC 61966-2-1.
double srgb_to_linear(double value) {
  return value > 0.04045 ? std::pow((value + 0.055) / 1.055, 2.4) : value / 12.92;
}

// The angles by which Godot's sky looks its panorama up (servers/rendering/renderer_rd/shaders/
// environment/sky.glsl, acos_approx and atan2_approx, after Eberly).
double sky_acos(double x) {
  const double magnitude = std::min(std::abs(x), 1.0);
  const double angle = (0.5 * kPi - 0.156583 * std::abs(x)) * std::sqrt(1.0 - magnitude);
  return x >= 0.0 ? angle : kPi - angle;
}

double sky_atan(double y, double x) {
  const double a = std::min(std::abs(x), std::abs(y)) / std::max({std::abs(x), std::abs(y), 1e-12});
  const double s = a * a;
  double angle = ((0.0872929 * s - 0.301895) * s + 1.0) * a;
  if (std::abs(y) > std::abs(x)) angle = 0.5 * kPi - angle;
  if (x < 0.0) angle = kPi - angle;
  return y < 0.0 ? -angle : angle;
}

glm::dvec3 mean_over_texel(const PanoramaLight& light, const PyramidOptions& options, int face,
                           int column, int row) {
  const int samples = options.samples;
  glm::dvec3 sum(0.0);
  for (int j = 0; j < samples; ++j) {
    for (int i = 0; i < samples; ++i) {
      const glm::dvec2 place(column + (i + 0.5) / samples, row + (j + 0.5) / samples);
      sum += light.sample(face_direction(face, place * (2.0 / options.size) - 1.0));
    }
  }
  return sum / static_cast<double>(samples * samples);
}

// How much of the tent 1 − |t| lies below t.
double tent_below(double t) {
  const double within = std::clamp(t, -1.0, 1.0);
  return 0.5 + within - 0.5 * within * std::abs(within);
}

// The mean over a square about the unit vector d, of a variance in solid angles of the texels in
// the middle of a face.
glm::dvec3 mean_over_square(const PanoramaLight& light, const PyramidOptions& options,
                            const glm::dvec3& d, double variance) {
  const double half = std::sqrt(3.0 * variance) * 2.0 / options.size;
  return light.mean(d, 2.0 * std::atan2(half, 2.0 * std::hypot(d.x, d.z)), half);
}

}  // namespace

glm::dvec3 PanoramaLight::texel(int column, int row) const {
  const std::size_t at =
      3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(panorama_.width) +
           static_cast<std::size_t>(column));
  glm::dvec3 value;
  for (int channel = 0; channel < 3; ++channel) {
    const float stored = panorama_.rgb[at + static_cast<std::size_t>(channel)];
    const double sound = stored > 0.0f && stored < 3e38f ? static_cast<double>(stored) : 0.0;
    value[channel] = is_srgb_ ? srgb_to_linear(sound) : sound;
  }
  return value;
}

glm::dvec2 PanoramaLight::position(const glm::dvec3& d) const {
  double turn = 0.0, polar = 0.0;
  if (as_sky_) {
    turn = sky_atan(d.x, -d.z);
    polar = sky_acos(d.y / glm::length(d));
  } else {
    turn = std::atan2(d.x, -d.z);
    polar = std::atan2(std::hypot(d.x, d.z), d.y);
  }
  const double u = turn / (2.0 * kPi);
  return {(u - std::floor(u)) * panorama_.width - 0.5, polar / kPi * panorama_.height - 0.5};
}

glm::dvec3 PanoramaLight::sample(const glm::dvec3& d) const {
  const int width = panorama_.width, height = panorama_.height;
  const glm::dvec2 at = position(d);
  const double left = std::floor(at.x), top = std::floor(at.y);
  const double across = at.x - left, along = at.y - top;
  const int x0 = (static_cast<int>(left) + width) % width;
  const int x1 = (static_cast<int>(left) + 1) % width;
  const int y0 = std::clamp(static_cast<int>(top), 0, height - 1);
  const int y1 = std::clamp(static_cast<int>(top) + 1, 0, height - 1);
  const glm::dvec3 above = glm::mix(texel(x0, y0), texel(x1, y0), across);
  const glm::dvec3 below = glm::mix(texel(x0, y1), texel(x1, y1), across);
  return glm::mix(above, below, along);
}

glm::dvec3 PanoramaLight::mean(const glm::dvec3& d, double azimuth, double polar) const {
  const int width = panorama_.width, height = panorama_.height;
  const glm::dvec2 at = position(d);
  const glm::dvec2 half(azimuth / (2.0 * kPi) * width, polar / kPi * height);
  const glm::dvec2 begin = at - half, end = at + half;
  const auto last_row = static_cast<int>(std::ceil(end.y));
  const auto last_column = static_cast<int>(std::ceil(end.x));
  glm::dvec3 sum(0.0);
  for (int y = static_cast<int>(std::floor(begin.y)); y <= last_row; ++y) {
    const double weight_y = tent_below(end.y - y) - tent_below(begin.y - y);
    if (!(weight_y > 0.0)) continue;
    const int row = std::clamp(y, 0, height - 1);
    for (int x = static_cast<int>(std::floor(begin.x)); x <= last_column; ++x) {
      const double weight_x = tent_below(end.x - x) - tent_below(begin.x - x);
      sum += weight_y * weight_x * texel((x + 2 * width) % width, row);
    }
  }
  return sum / (4.0 * half.x * half.y);
}

glm::dvec3 sky_direction(const glm::dvec3& d) {
  // Both of its angles grow with the true ones.
  const auto invert = [](const auto& sky_angle, double wanted, double below, double above) {
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (below + above);
      (sky_angle(middle) < wanted ? below : above) = middle;
    }
    return 0.5 * (below + above);
  };
  const double polar = invert([](double angle) { return sky_acos(std::cos(angle)); },
                              std::acos(std::clamp(d.y, -1.0, 1.0)), 0.0, kPi);
  const double azimuth =
      invert([](double angle) { return sky_atan(std::sin(angle), std::cos(angle)); },
             std::atan2(d.x, -d.z), -kPi, kPi);
  return {std::sin(polar) * std::sin(azimuth), std::cos(polar),
          -std::sin(polar) * std::cos(azimuth)};
}

glm::dvec3 level_0_texel(const PanoramaLight& light, const PyramidOptions& options, int face,
                         int column, int row) {
  if (!(options.base_variance > 0.0)) return mean_over_texel(light, options, face, column, row);
  const glm::dvec2 p = texel_middle(column, row, options.size);
  const double shrinking = 1.0 - std::pow(1.0 + glm::dot(p, p), -1.5);
  return mean_over_square(light, options, glm::normalize(face_direction(face, p)),
                          options.base_variance + kTentVariance * shrinking);
}

}  // namespace lobelight
