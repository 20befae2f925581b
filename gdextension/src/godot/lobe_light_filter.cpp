#include "godot/lobe_light_filter.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "godot/convert.h"
#include "godot/request.h"
#include "image/panorama.h"
#include "image/pyramid.h"

using namespace godot;

namespace lobelight {

namespace {

// The only ones that are round on the sphere.
constexpr const char* kDisc = "disc";
constexpr const char* kGaussian = "gaussian";

Panorama read_panorama(const Request& request, const Dictionary& values) {
  const int width = request.integer("width", 0), height = request.integer("height", 0);
  check_panorama_size(width, height, "panorama", kMaxTextureSide);
  const Variant pixels = request.has("pixels") ? values["pixels"] : Variant();
  const auto count = 3 * static_cast<std::int64_t>(width) * static_cast<std::int64_t>(height);
  const PackedFloat32Array floats = pixels;
  if (pixels.get_type() != Variant::PACKED_FLOAT32_ARRAY || floats.size() != count) {
    throw std::invalid_argument("pixels must be a PackedFloat32Array of width * height * 3 = " +
                                std::to_string(count) + " numbers.");
  }
  return {width, height, std::vector<float>(floats.ptr(), floats.ptr() + count)};
}

PyramidOptions read_options(const Request& request) {
  PyramidOptions options;
  const std::string filter = request.text("filter", kDisc);
  if (filter != kDisc && filter != kGaussian) {
    throw std::invalid_argument("filter is \"" + filter +
                                "\", but must be \"disc\" or \"gaussian\".");
  }
  options.is_gaussian = filter == kGaussian;
  options.size = request.integer("size", options.size);
  options.is_srgb = request.truth("srgb", options.is_srgb);
  options.as_sky = request.truth("as_sky", options.as_sky);
  options.samples = request.integer("samples", options.samples);
  options.base_variance = request.real("base_variance", options.base_variance);
  options.level_variance = request.real("level_variance", options.level_variance);
  options.threads = request.integer("threads", options.threads);
  validate(options);
  return options;
}

}  // namespace

void LobeLightFilter::_bind_methods() {
  ClassDB::bind_method(D_METHOD("filter", "request"), &LobeLightFilter::filter);
}

Dictionary LobeLightFilter::filter(const Dictionary& request) const { return run(request); }

LobeTask::Work LobeLightFilter::prepare(const Dictionary& values) const {
  const Request request(values, "a panorama to filter",
                        {"pixels", "width", "height", "srgb", "as_sky", "size", "filter", "samples",
                         "base_variance", "level_variance", "threads"});
  const PyramidOptions options = read_options(request);
  // Work is copied, the panorama should not be.
  const auto panorama = std::make_shared<const Panorama>(read_panorama(request, values));
  return [panorama, options](Progress& progress) {
    const LightPyramid pyramid = filter_panorama(*panorama, options, progress);
    Array faces;
    for (const auto& face : pyramid.faces) faces.append(to_bytes(face));
    Dictionary result;
    result["size"] = pyramid.size;
    result["faces"] = faces;
    return result;
  };
}

}  // namespace lobelight
