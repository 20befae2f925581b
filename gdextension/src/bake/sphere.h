#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "base/progress.h"
#include "reference/sphere_renderer.h"

namespace lobelight {

// The room whose walls light the sphere, instead of an environment.
struct RoomRequest {
  glm::dvec3 size{0.0};                   // in metres
  std::array<std::string, kWalls> walls;  // paths of pictures, UTF-8, in the order of Room::walls
  RoomSphere sphere;
};

// A reference picture: the sphere of render_sphere() in the light of files.
struct SphereRequest {
  std::string environment;  // path of a panorama, UTF-8
  std::optional<RoomRequest> room;
  std::string brdf = "ward";   // as make_brdf() takes it
  glm::dvec2 alpha{0.1, 0.1};  // (0, 0) for files: estimated
  SphereOptions options;
};

struct SpherePicture {
  SphereImage image;
  std::string brdf;         // the model's name, or the file's without its folder
  glm::dvec2 alpha;         // of what was rendered
  std::size_t clamped = 0;  // texels that were no light
  double seconds = 0.0;
};

// Throws std::invalid_argument with one sentence that names the key. No file is read.
void validate(const SphereRequest& request);

// Throws what validate() does, MeasuredFileError, ImageError and Cancelled; std::invalid_argument
// also for an environment so large that bake/memory.h's limit does not do.
SpherePicture render_picture(const SphereRequest& request, Progress& progress);

}  // namespace lobelight
