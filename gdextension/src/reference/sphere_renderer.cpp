#include "reference/sphere_renderer.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "reference/room_distribution.h"
#include "reference/surface_renderer.h"

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
  const int size = options.size;
  const auto surface = [size](int column, int row) { return sphere_frame(column, row, size); };
  SurfaceImage image =
      render_surface(panorama, brdf, {0.0, 0.0, 1.0}, surface,
                     {size, size, options.samples, options.seed, options.threads}, progress);
  return {size, std::move(image.radiance), std::move(image.standard_error)};
}

void validate(const Room& room, const RoomSphere& sphere) {
  if (!(sphere.radius > 0.0) || !std::isfinite(sphere.radius)) {
    throw std::invalid_argument("radius must be a positive number.");
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!(room.size[axis] > 0.0) || !std::isfinite(room.size[axis])) {
      throw std::invalid_argument("room_size must be three positive numbers.");
    }
    if (!(std::abs(sphere.centre[axis]) + sphere.radius < 0.5 * room.size[axis])) {
      throw std::invalid_argument("The sphere does not lie within the room.");
    }
  }
}

SphereImage render_sphere(const Room& room, const RoomSphere& sphere, const Brdf& brdf,
                          const SphereOptions& options, Progress& progress) {
  validate(options);
  validate(room, sphere);
  const int size = options.size;
  const auto surface = [&](int column, int row) {
    auto frame = sphere_frame(column, row, size);
    if (frame) frame->point = sphere.centre + sphere.radius * frame->normal;
    return frame;
  };
  SurfaceImage image = render_surface(
      std::make_shared<const RoomDistribution>(room, &progress), brdf, {0.0, 0.0, 1.0}, surface,
      {size, size, options.samples, options.seed, options.threads}, progress);
  return {size, std::move(image.radiance), std::move(image.standard_error)};
}

}  // namespace lobelight
