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

// A Gaussian or a disc about a direction, on a square of samples in the plane that touches the
// sphere there.
glm::dvec3 mean_over_kernel(const PanoramaLight& light, const PyramidOptions& options,
                            const glm::dvec3& d, double variance) {
  const int samples = options.samples;
  const bool is_gaussian = options.is_gaussian;
  const glm::dvec3 right =
      glm::normalize(std::abs(d.y) < 0.9 ? glm::dvec3(d.z, 0.0, -d.x) : glm::dvec3(0.0, -d.z, d.y));
  const glm::dvec3 down = glm::cross(d, right);
  const double deviation =
      std::sqrt(is_gaussian ? variance / kReachedShare : variance) * 2.0 / options.size;
  // A disc has twice its standard deviation as radius, and half a sample's rim.
  const double reach = deviation * (is_gaussian ? kKernelReach : 2.0 * samples / (samples - 1));
  const double step = 2.0 * reach / samples;
  const double radius = 2.0 * std::sqrt(deviation * deviation - kRimVariance * step * step);
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (int j = 0; j < samples; ++j) {
    for (int i = 0; i < samples; ++i) {
      const glm::dvec2 offset((i + 0.5) * step - reach, (j + 0.5) * step - reach);
      const double squared = glm::dot(offset, offset);
      const double weight = is_gaussian ? std::exp(-0.5 * squared / (deviation * deviation))
                                        : disc_weight(radius, std::sqrt(squared), step);
      if (weight > 0.0) sum += weight * light.sample(d + right * offset.x + down * offset.y);
      weights += weight;
    }
  }
  return sum / weights;
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

glm::dvec3 PanoramaLight::sample(const glm::dvec3& d) const {
  double turn = 0.0, polar = 0.0;
  if (as_sky_) {
    turn = sky_atan(d.x, -d.z);
    polar = sky_acos(d.y / glm::length(d));
  } else {
    turn = std::atan2(d.x, -d.z);
    polar = std::atan2(std::hypot(d.x, d.z), d.y);
  }
  const int width = panorama_.width, height = panorama_.height;
  const double u = turn / (2.0 * kPi);
  const double x = (u - std::floor(u)) * width - 0.5;
  const double y = polar / kPi * height - 0.5;
  const double left = std::floor(x), top = std::floor(y);
  const double across = x - left, along = y - top;
  const int x0 = (static_cast<int>(left) + width) % width;
  const int x1 = (static_cast<int>(left) + 1) % width;
  const int y0 = std::clamp(static_cast<int>(top), 0, height - 1);
  const int y1 = std::clamp(static_cast<int>(top) + 1, 0, height - 1);
  const glm::dvec3 above = glm::mix(texel(x0, y0), texel(x1, y0), across);
  const glm::dvec3 below = glm::mix(texel(x0, y1), texel(x1, y1), across);
  return glm::mix(above, below, along);
}

glm::dvec3 level_0_texel(const PanoramaLight& light, const PyramidOptions& options, int face,
                         int column, int row) {
  if (!(options.base_variance > 0.0)) return mean_over_texel(light, options, face, column, row);
  const glm::dvec2 p = texel_middle(column, row, options.size);
  const double shrinking = 1.0 - std::pow(1.0 + glm::dot(p, p), -1.5);
  return mean_over_kernel(light, options, glm::normalize(face_direction(face, p)),
                          options.base_variance + kTentVariance * shrinking);
}

}  // namespace lobelight
