#include "godot/lobe_image_file.h"

#include <exception>
#include <vector>

#include "godot/convert.h"
#include "image/exr.h"
#include "image/panorama.h"
#include "table/half_float.h"

using namespace godot;

namespace lobelight {

namespace {

Array to_array(const std::vector<std::string>& texts) {
  Array result;
  for (const std::string& text : texts) result.append(to_godot(text));
  return result;
}

// What the results of both readers have in common.
Dictionary describe(const Panorama& panorama, std::size_t clamped) {
  Dictionary result;
  result["width"] = panorama.width;
  result["height"] = panorama.height;
  result["clamped"] = static_cast<std::int64_t>(clamped);
  result["notes"] = to_array(panorama.notes);
  result["warnings"] = to_array(panorama.warnings);
  return result;
}

// What `read` makes of the file, or the sentence of what it throws.
template <class Read>
Dictionary result_of(const String& path, const Read& read) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
    return error_result(to_std(path) + ": there is not enough memory for it.");
  } catch (const std::exception& error) {
    return error_result(error.what());
  }
}

}  // namespace

void LobeImageFile::_bind_methods() {
  ClassDB::bind_static_method(
      "LobeImageFile", D_METHOD("load_panorama", "path", "layer", "max_side"),
      &LobeImageFile::load_panorama, DEFVAL(String()), DEFVAL(kMaxPanoramaSide));
  ClassDB::bind_static_method("LobeImageFile",
                              D_METHOD("load_half_panorama", "path", "layer", "exposure"),
                              &LobeImageFile::load_half_panorama, DEFVAL(String()), DEFVAL(0.0));
  ClassDB::bind_static_method("LobeImageFile", D_METHOD("list_layers", "path"),
                              &LobeImageFile::list_layers);
  ClassDB::bind_static_method("LobeImageFile",
                              D_METHOD("save_exr", "path", "width", "height", "pixels"),
                              &LobeImageFile::save_exr);
}

Dictionary LobeImageFile::load_panorama(const String& path, const String& layer,
                                        std::int64_t max_side) {
  return result_of(path, [&] {
    Panorama panorama = lobelight::load_panorama(file_system_path(path), to_std(layer), max_side);
    const std::size_t clamped = panorama.sanitise();
    Dictionary result = describe(panorama, clamped);
    result["pixels"] = to_godot(panorama.rgb);
    return result;
  });
}

Dictionary LobeImageFile::load_half_panorama(const String& path, const String& layer,
                                             double exposure) {
  return result_of(path, [&] {
    Panorama panorama =
        lobelight::load_panorama(file_system_path(path), to_std(layer), kMaxTextureSide);
    const std::size_t clamped = panorama.sanitise();
    const std::size_t capped = panorama.expose(exposure);
    const std::uint16_t one = half_from_double(1.0);
    std::vector<std::uint16_t> halves;
    halves.reserve(panorama.rgb.size() / 3 * 4);
    for (std::size_t texel = 0; texel + 2 < panorama.rgb.size(); texel += 3) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        halves.push_back(half_from_double(static_cast<double>(panorama.rgb[texel + channel])));
      }
      halves.push_back(one);
    }
    Dictionary result = describe(panorama, clamped);
    result["data"] = to_bytes(halves);
    result["capped"] = static_cast<std::int64_t>(capped);
    return result;
  });
}

Dictionary LobeImageFile::list_layers(const String& path) {
  return result_of(path, [&] {
    Dictionary result;
    result["layers"] = to_array(panorama_layers(file_system_path(path)));
    return result;
  });
}

String LobeImageFile::save_exr(const String& path, std::int32_t width, std::int32_t height,
                               const PackedFloat32Array& pixels) {
  try {
    const std::vector<float> values(pixels.ptr(), pixels.ptr() + pixels.size());
    write_exr(file_system_path(path), width, height, {"R", "G", "B"}, values);
    return String();
  } catch (const std::exception& error) {
    return to_godot(error.what());
  }
}

}  // namespace lobelight
