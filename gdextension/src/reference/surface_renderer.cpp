#include "reference/surface_renderer.h"

#include <atomic>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "base/parallel.h"
#include "reference/environment_distribution.h"
#include "reference/sobol.h"

namespace lobelight {
namespace {

// Sines of angles below this are rounding.
constexpr double kParallel = 1e-6;

void check_size(const SurfaceOptions& options) {
  if (options.width < 1 || options.height < 1) {
    throw std::invalid_argument("A picture has at least one pixel.");
  }
}

}  // namespace

std::optional<SurfaceFrame> frame_about(const glm::dvec3& normal, const glm::dvec3& tangent) {
  const double scale = glm::length(normal) * glm::length(tangent);
  const glm::dvec3 across = glm::cross(normal, tangent);
  const double sine_times_scale = glm::length(across);
  // False for numbers that are not finite, too.
  if (!(std::isfinite(scale) && sine_times_scale > kParallel * scale)) return std::nullopt;
  const glm::dvec3 n = glm::normalize(normal);
  const glm::dvec3 b = across / sine_times_scale;
  return SurfaceFrame{glm::cross(b, n), b, n};
}

SurfaceImage render_surface(const Panorama& panorama, const Brdf& brdf, const glm::dvec3& view,
                            const SurfaceAt& surface, const SurfaceOptions& options,
                            Progress& progress) {
  check_size(options);
  return render_surface(std::make_shared<const EnvironmentDistribution>(panorama, &progress), brdf,
                        view, surface, options, progress);
}

SurfaceImage render_surface(std::shared_ptr<const IncomingLight> light, const Brdf& brdf,
                            const glm::dvec3& view, const SurfaceAt& surface,
                            const SurfaceOptions& options, Progress& progress) {
  check_size(options);
  const Integrator integrator(std::move(light), brdf, options.samples, &progress);
  const std::size_t width = static_cast<std::size_t>(options.width);
  const std::size_t height = static_cast<std::size_t>(options.height);
  SurfaceImage image;
  image.width = options.width;
  image.height = options.height;
  image.radiance.resize(3 * width * height);
  image.standard_error.resize(3 * width * height);

  std::atomic<int> finished_rows{0};
  progress.set(0.0);
  parallel_for(height, options.threads, [&](std::size_t row) {
    for (std::size_t column = 0; column < width; ++column) {
      progress.throw_if_cancelled();
      const auto frame = surface(static_cast<int>(column), static_cast<int>(row));
      if (!frame) continue;
      const std::size_t pixel = row * width + column;
      const RadianceEstimate estimate =
          integrator.integrate(view, *frame, mix_bits(options.seed) ^ mix_bits(~pixel), &progress);
      for (int channel = 0; channel < 3; ++channel) {
        const std::size_t target = 3 * pixel + static_cast<std::size_t>(channel);
        image.radiance[target] = static_cast<float>(estimate.radiance[channel]);
        image.standard_error[target] = static_cast<float>(estimate.standard_error[channel]);
      }
    }
    progress.set(static_cast<double>(++finished_rows) / options.height);
  });
  return image;
}

}  // namespace lobelight
