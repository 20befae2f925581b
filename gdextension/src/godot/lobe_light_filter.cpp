#include "godot/lobe_light_filter.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "godot/convert.h"
#include "godot/request.h"
#include "image/compact_sources.h"
#include "image/panorama.h"
#include "image/panorama_faces.h"
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

int read_most_sources(const Request& request) {
  const int most = request.integer("max_sources", 0);
  if (most < 0 || most > kMaxSources) {
    throw std::invalid_argument("max_sources is " + std::to_string(most) +
                                ", but must be from 0 to " + std::to_string(kMaxSources) + ".");
  }
  return most;
}

double read_exposure(const Request& request) {
  const double exposure = request.real("exposure", 0.0);
  if (!(std::abs(exposure) <= 64.0)) {
    throw std::invalid_argument("exposure must be from -64 to 64.");
  }
  return exposure;
}

// Takes sources out of a panorama for a result, and says what of the rest is too bright for it.
// Pictures in sRGB, which end at white, have neither.
Dictionary take_sources_of(Panorama& panorama, int most, double exposure,
                           const PyramidOptions& options, Progress& progress) {
  std::vector<CompactSource> sources;
  if (!options.is_srgb) {
    panorama.brighten(exposure);
    sources = take_sources(panorama, most, options.threads, progress);
    panorama.warn_of_limit(exposure);
  }
  if (options.as_sky) {
    for (CompactSource& source : sources) source.direction = sky_direction(source.direction);
  }
  Array warnings;
  for (const std::string& warning : panorama.warnings) warnings.append(to_godot(warning));
  Dictionary result;
  result["source_count"] = static_cast<std::int64_t>(sources.size());
  result["sources"] = to_godot(source_texels(sources));
  result["warnings"] = warnings;
  return result;
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
  ClassDB::bind_method(D_METHOD("find_sources", "request"), &LobeLightFilter::find_sources);
}

Dictionary LobeLightFilter::filter(const Dictionary& request) const { return run(request); }

Dictionary LobeLightFilter::find_sources(const Dictionary& values) const {
  Dictionary only;
  const Array keys = values.keys();
  for (std::int64_t n = 0; n < keys.size(); ++n) only[keys[n]] = values[keys[n]];
  only["only_sources"] = true;
  return run(only);
}

LobeTask::Work LobeLightFilter::prepare(const Dictionary& values) const {
  const Request request(
      values, "a panorama to filter",
      {"pixels", "width", "height", "srgb", "as_sky", "size", "filter", "samples", "base_variance",
       "level_variance", "threads", "exposure", "max_sources", "only_sources"});
  const PyramidOptions options = read_options(request);
  const int most_sources = read_most_sources(request);
  const double exposure = read_exposure(request);
  const bool only_sources = request.truth("only_sources", false);
  // Work is copied, the panorama should not be.
  const auto panorama = std::make_shared<Panorama>(read_panorama(request, values));
  return [=](Progress& progress) {
    Dictionary result = take_sources_of(*panorama, most_sources, exposure, options, progress);
    if (only_sources) return result;
    const LightPyramid pyramid = filter_panorama(*panorama, options, progress);
    Array faces;
    for (const auto& face : pyramid.faces) faces.append(to_bytes(face));
    result["size"] = pyramid.size;
    result["faces"] = faces;
    return result;
  };
}

}  // namespace lobelight
