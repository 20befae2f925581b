#include "godot/lobe_reference.h"

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bake/sphere.h"
#include "brdf/measured.h"
#include "godot/convert.h"
#include "godot/request.h"

using namespace godot;

namespace lobelight {

namespace {

glm::dvec3 read_point(const Request& request, std::string_view key) {
  const std::vector<double> numbers = request.numbers(key);
  if (numbers.size() != 3) {
    throw std::invalid_argument(std::string(key) + " must be an Array of three numbers.");
  }
  return {numbers[0], numbers[1], numbers[2]};
}

RoomRequest read_room(const Request& request) {
  RoomRequest room;
  const std::vector<std::string> walls = request.texts("walls");
  if (walls.size() != kWalls) {
    throw std::invalid_argument("walls must be an Array of six paths.");
  }
  for (std::size_t w = 0; w < kWalls; ++w) {
    room.walls[w] = file_system_path(to_godot(walls[w]));
  }
  room.size = read_point(request, "room_size");
  room.sphere.centre = read_point(request, "centre");
  room.sphere.radius = request.real("radius", room.sphere.radius);
  return room;
}

SphereRequest read_request(const Request& request) {
  SphereRequest sphere;
  if (request.has("walls")) {
    if (request.has("env")) {
      throw std::invalid_argument("env and walls exclude each other.");
    }
    sphere.room = read_room(request);
  } else {
    sphere.environment = file_system_path(to_godot(request.required_text("env")));
  }
  sphere.brdf = request.text("brdf", sphere.brdf);
  if (is_measured_file(sphere.brdf)) sphere.brdf = file_system_path(to_godot(sphere.brdf));
  sphere.alpha = request.widths("alpha", sphere.alpha);
  SphereOptions& options = sphere.options;
  options.size = request.integer("size", options.size);
  options.samples = request.integer("samples", options.samples);
  options.seed = request.unsigned_integer("seed", options.seed);
  options.threads = request.integer("threads", options.threads);
  validate(sphere);
  return sphere;
}

Dictionary to_dictionary(const SpherePicture& picture, const std::string& env,
                         const SphereOptions& options) {
  Dictionary result;
  if (!env.empty()) result["env"] = to_godot(env);
  result["brdf"] = to_godot(picture.brdf);
  result["alpha"] = to_godot(picture.alpha);
  result["size"] = picture.image.size;
  result["samples"] = options.samples;
  result["seed"] = options.seed;
  result["pixels"] = to_godot(picture.image.radiance);
  result["standard_error"] = to_godot(picture.image.standard_error);
  result["clamped"] = static_cast<std::int64_t>(picture.clamped);
  result["seconds"] = picture.seconds;
  return result;
}

}  // namespace

void LobeReference::_bind_methods() {
  ClassDB::bind_method(D_METHOD("render_sphere", "options"), &LobeReference::render_sphere);
}

Dictionary LobeReference::render_sphere(const Dictionary& options) const { return run(options); }

LobeTask::Work LobeReference::prepare(const Dictionary& options) const {
  const Request request(options, "a sphere to render",
                        {"env", "brdf", "alpha", "size", "samples", "seed", "threads", "walls",
                         "room_size", "centre", "radius"});
  return [env = request.text("env", ""), sphere = read_request(request)](Progress& progress) {
    return to_dictionary(render_picture(sphere, progress), env, sphere.options);
  };
}

}  // namespace lobelight
