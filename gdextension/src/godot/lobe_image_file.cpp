#include "godot/lobe_image_file.h"

#include <exception>
#include <vector>

#include "godot/convert.h"
#include "image/exr.h"
#include "image/panorama.h"

using namespace godot;

namespace lobelight {

void LobeImageFile::_bind_methods() {
  ClassDB::bind_static_method("LobeImageFile", D_METHOD("load_panorama", "path"),
                              &LobeImageFile::load_panorama);
  ClassDB::bind_static_method("LobeImageFile",
                              D_METHOD("save_exr", "path", "width", "height", "pixels"),
                              &LobeImageFile::save_exr);
}

Dictionary LobeImageFile::load_panorama(const String& path) {
  try {
    Panorama panorama = lobelight::load_panorama(file_system_path(path));
    const std::size_t clamped = panorama.sanitise();
    Dictionary result;
    result["width"] = panorama.width;
    result["height"] = panorama.height;
    result["pixels"] = to_godot(panorama.rgb);
    result["clamped"] = static_cast<std::int64_t>(clamped);
    return result;
  } catch (const std::bad_alloc&) {
    return error_result(to_std(path) + ": there is not enough memory for it.");
  } catch (const std::exception& error) {
    return error_result(error.what());
  }
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
