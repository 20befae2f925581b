#pragma once

#include <cstdint>
#include <godot_cpp/classes/ref_counted.hpp>
#include <godot_cpp/core/class_db.hpp>

namespace lobelight {

// Image files as OpenEXR and the core read and write them, which is more than the engine does.
class LobeImageFile : public godot::RefCounted {
  GDCLASS(LobeImageFile, godot::RefCounted)

 public:
  static godot::Dictionary load_panorama(const godot::String& path, const godot::String& layer,
                                         std::int64_t max_side);

  // As RGBA16F, for a texture.
  static godot::Dictionary load_half_panorama(const godot::String& path, const godot::String& layer,
                                              double exposure);

  static godot::Dictionary list_layers(const godot::String& path);
  static godot::String save_exr(const godot::String& path, std::int32_t width, std::int32_t height,
                                const godot::PackedFloat32Array& pixels);

 protected:
  static void _bind_methods();
};

}  // namespace lobelight
