#include "reference/table_renderer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "base/parallel.h"
#include "reference/sphere_renderer.h"

namespace lobelight {

namespace {

// Radiance from a surface of this frame, seen from +z.
glm::dvec3 shade(const GaussianConvolution& light, const LobeTable& table,
                 const SurfaceFrame& frame, const Progress& progress) {
  const glm::dvec3 o(frame.tangent.z, frame.bitangent.z, frame.normal.z);
  const Mixture lobes = table.interpolate(o);
  std::vector<glm::dvec3> channels;
  if (table.has_second_texels()) channels = table.interpolate_channel_weights(o);
  glm::dvec3 radiance(0.0);
  for (std::size_t k = 0; k < lobes.size(); ++k) {
    progress.throw_if_cancelled();
    const glm::dvec3& mean = lobes[k].gaussian.mean;
    const glm::dvec3 world =
        mean.x * frame.tangent + mean.y * frame.bitangent + mean.z * frame.normal;
    const glm::dvec3 weight = channels.empty() ? glm::dvec3(lobes[k].weight) : channels[k];
    radiance += weight * light.convolve({glm::normalize(world), lobes[k].gaussian.kappa});
  }
  return radiance;
}

}  // namespace

std::vector<float> render_table(const GaussianConvolution& light, const LobeTable& table, int size,
                                int threads, Progress& progress) {
  const auto side = static_cast<std::size_t>(size);
  std::vector<float> picture(3 * side * side, 0.0f);
  std::atomic<int> finished{0};
  parallel_for(side, threads, progress, [&](std::size_t row) {
    for (int column = 0; column < size; ++column) {
      const auto frame = sphere_frame(column, static_cast<int>(row), size);
      if (!frame) continue;
      const glm::dvec3 radiance = shade(light, table, *frame, progress);
      for (int channel = 0; channel < 3; ++channel) {
        picture[3 * (row * side + static_cast<std::size_t>(column)) +
                static_cast<std::size_t>(channel)] = static_cast<float>(radiance[channel]);
      }
    }
    progress.set(static_cast<double>(++finished) / size);
  });
  return picture;
}

double sphere_psnr(const std::vector<float>& picture, const std::vector<float>& reference,
                   int size) {
  std::vector<std::size_t> inside;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const double x = (2.0 * column + 1.0) / size - 1.0;
      const double y = 1.0 - (2.0 * row + 1.0) / size;
      if (x * x + y * y < 0.9995)
        inside.push_back(static_cast<std::size_t>(3 * (row * size + column)));
    }
  }
  std::vector<double> brightness;
  for (const std::size_t n : inside) {
    brightness.push_back((static_cast<double>(reference[n]) +
                          static_cast<double>(reference[n + 1]) +
                          static_cast<double>(reference[n + 2])) /
                         3.0);
  }
  std::sort(brightness.begin(), brightness.end());
  const std::size_t count = brightness.size();
  const double median =
      count > 0 ? 0.5 * (brightness[(count - 1) / 2] + brightness[count / 2]) : 0.0;
  if (!(median > 0.0) || !std::isfinite(median)) {
    throw std::invalid_argument("The reference picture's median is not a positive number.");
  }
  const auto shown = [&](float value) {
    if (!std::isfinite(value))
      throw std::invalid_argument("A picture has a pixel that is no number.");
    return std::pow(std::clamp(0.18 / median * static_cast<double>(value), 0.0, 1.0), 1.0 / 2.2);
  };
  double sum = 0.0;
  for (const std::size_t n : inside) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double difference = shown(picture[n + channel]) - shown(reference[n + channel]);
      sum += difference * difference;
    }
  }
  if (!(sum > 0.0)) return std::numeric_limits<double>::infinity();
  return -10.0 * std::log10(sum / (3.0 * static_cast<double>(count)));
}

}  // namespace lobelight
