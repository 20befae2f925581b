#include "godot/lobe_reference.h"

#include <chrono>

#include "brdf/brdf.h"
#include "brdf/measured.h"
#include "godot/convert.h"
#include "godot/request.h"
#include "image/panorama.h"
#include "reference/sphere_renderer.h"

using namespace godot;

namespace lobelight {

namespace {

struct SphereRequest {
  std::string env;
  std::string path;  // env, as the file system knows it
  std::shared_ptr<const Brdf> brdf;
  SphereOptions options;
};

SphereRequest read_request(const Dictionary& values) {
  const Request request(values, "a sphere to render",
                        {"env", "brdf", "alpha", "size", "samples", "seed", "threads"});
  SphereRequest sphere;
  sphere.env = request.required_text("env");
  sphere.path = file_system_path(to_godot(sphere.env));
  std::string brdf = request.text("brdf", "ward");
  if (is_measured_file(brdf)) brdf = file_system_path(to_godot(brdf));
  sphere.brdf = make_brdf(brdf, request.widths("alpha", {0.1, 0.1}));
  SphereOptions& options = sphere.options;
  options.size = request.integer("size", options.size);
  options.samples = request.integer("samples", options.samples);
  options.seed = request.unsigned_integer("seed", options.seed);
  options.threads = request.integer("threads", options.threads);
  validate(options);
  return sphere;
}

Dictionary render(const SphereRequest& sphere, Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  Panorama panorama = load_panorama(sphere.path);
  const std::size_t clamped = panorama.sanitise();
  const SphereImage image =
      lobelight::render_sphere(panorama, *sphere.brdf, sphere.options, progress);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  Dictionary result;
  result["env"] = to_godot(sphere.env);
  result["brdf"] = to_godot(sphere.brdf->name());
  result["alpha"] = to_godot(sphere.brdf->alpha());
  result["size"] = image.size;
  result["samples"] = sphere.options.samples;
  result["seed"] = sphere.options.seed;
  result["pixels"] = to_godot(image.radiance);
  result["standard_error"] = to_godot(image.standard_error);
  result["clamped"] = static_cast<std::int64_t>(clamped);
  result["seconds"] = elapsed.count();
  return result;
}

}  // namespace

void LobeReference::_bind_methods() {
  ClassDB::bind_method(D_METHOD("render_sphere", "options"), &LobeReference::render_sphere);
}

Dictionary LobeReference::render_sphere(const Dictionary& options) const { return run(options); }

LobeTask::Work LobeReference::prepare(const Dictionary& options) const {
  return [sphere = read_request(options)](Progress& progress) { return render(sphere, progress); };
}

}  // namespace lobelight
