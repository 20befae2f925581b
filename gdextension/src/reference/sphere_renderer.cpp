#include "reference/sphere_renderer.h"

#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>

#include "base/parallel.h"
#include "reference/sobol.h"

namespace lobelight {
namespace {

constexpr int kMaxSize = 8192;
constexpr int kMinSamples = 16;
constexpr int kMaxSamples = 1 << 24;

}  // namespace

void validate(const SphereOptions& options) {
  if (options.size < 1 || options.size > kMaxSize) {
    throw std::invalid_argument("size must be 1 to " + std::to_string(kMaxSize) + ", not " +
                                std::to_string(options.size) + ".");
  }
  if (options.samples < kMinSamples || options.samples > kMaxSamples) {
    throw std::invalid_argument("samples must be " + std::to_string(kMinSamples) + " to " +
                                std::to_string(kMaxSamples) + ", not " +
                                std::to_string(options.samples) + ".");
  }
}

std::optional<SurfaceFrame> sphere_frame(int column, int row, int size) {
  const double x = (2.0 * column + 1.0) / size - 1.0;
  const double y = 1.0 - (2.0 * row + 1.0) / size;
  const double z_squared = 1.0 - x * x - y * y;
  if (!(z_squared > 0.0)) return std::nullopt;
  const glm::dvec3 normal(x, y, std::sqrt(z_squared));
  const glm::dvec3 tangent = glm::normalize(glm::dvec3(normal.z, 0.0, -normal.x));
  return SurfaceFrame{tangent, glm::cross(normal, tangent), normal};
}

SphereImage render_sphere(const Panorama& panorama, const Brdf& brdf, const SphereOptions& options,
                          Progress& progress) {
  validate(options);
  const Integrator integrator(panorama, brdf, options.samples);
  const std::size_t size = static_cast<std::size_t>(options.size);
  SphereImage image;
  image.size = options.size;
  image.radiance.resize(3 * size * size);
  image.standard_error.resize(3 * size * size);

  const glm::dvec3 view(0.0, 0.0, 1.0);
  std::atomic<int> finished_rows{0};
  progress.set(0.0);
  parallel_for(size, options.threads, [&](std::size_t row) {
    for (std::size_t column = 0; column < size; ++column) {
      progress.throw_if_cancelled();
      const auto frame =
          sphere_frame(static_cast<int>(column), static_cast<int>(row), options.size);
      if (!frame) continue;
      const std::size_t pixel = row * size + column;
      const RadianceEstimate estimate =
          integrator.integrate(view, *frame, mix_bits(options.seed) ^ mix_bits(~pixel));
      for (int channel = 0; channel < 3; ++channel) {
        const std::size_t target = 3 * pixel + static_cast<std::size_t>(channel);
        image.radiance[target] = static_cast<float>(estimate.radiance[channel]);
        image.standard_error[target] = static_cast<float>(estimate.standard_error[channel]);
      }
    }
    progress.set(static_cast<double>(++finished_rows) / options.size);
  });
  return image;
}

}  // namespace lobelight
