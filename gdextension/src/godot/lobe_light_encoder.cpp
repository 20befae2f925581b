#include "godot/lobe_light_encoder.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "godot/convert.h"
#include "godot/pack.h"
#include "godot/request.h"
#include "image/bc6h_encode.h"
#include "image/pyramid.h"

using namespace godot;

namespace lobelight {

namespace {

int count_levels(int size) {
  int levels = 1;
  while (size >> levels > 0) ++levels;
  return levels;
}

LightPyramid read_light(const Request& request, const Dictionary& values) {
  LightPyramid light;
  light.size = request.integer("size", 0);
  PyramidOptions options;
  options.size = light.size;
  validate(options);
  const std::size_t halves = level_begin(light.size, count_levels(light.size));
  const Variant faces = request.has("faces") ? values["faces"] : Variant();
  const Array given = faces;
  bool is_sound = faces.get_type() == Variant::ARRAY && given.size() == kCubeFaces;
  for (int face = 0; is_sound && face < kCubeFaces; ++face) {
    const Variant& data = given[face];
    const PackedByteArray bytes = data;
    is_sound = data.get_type() == Variant::PACKED_BYTE_ARRAY &&
               static_cast<std::size_t>(bytes.size()) == 2 * halves;
    if (!is_sound) break;
    std::vector<std::uint16_t>& target = light.faces[static_cast<std::size_t>(face)];
    target.resize(halves);
    std::memcpy(target.data(), bytes.ptr(), 2 * halves);
  }
  if (!is_sound) {
    throw std::invalid_argument("faces must be an Array of six PackedByteArrays of " +
                                std::to_string(2 * halves) + " bytes, half floats of all levels.");
  }
  return light;
}

}  // namespace

void LobeLightEncoder::_bind_methods() {
  ClassDB::bind_method(D_METHOD("encode", "request"), &LobeLightEncoder::encode);
}

Dictionary LobeLightEncoder::encode(const Dictionary& request) const { return run(request); }

LobeTask::Work LobeLightEncoder::prepare(const Dictionary& values) const {
  const Request request(values, "a light to encode", {"faces", "size", "threads"});
  const int threads = request.integer("threads", 0);
  const auto light = std::make_shared<const LightPyramid>(read_light(request, values));
  return [light, threads](Progress& progress) {
    Array faces;
    for (const auto& face : light->faces) {
      Progress part(progress, 1.0 / kCubeFaces);
      faces.append(
          pack<PackedByteArray>(encode_bc6h_face(face.data(), light->size, threads, part)));
    }
    Dictionary result;
    result["size"] = light->size;
    result["faces"] = faces;
    return result;
  };
}

}  // namespace lobelight
