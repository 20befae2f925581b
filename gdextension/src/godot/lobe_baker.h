#pragma once

#include <godot_cpp/variant/packed_byte_array.hpp>
#include <godot_cpp/variant/packed_float32_array.hpp>
#include <godot_cpp/variant/vector2.hpp>
#include <godot_cpp/variant/vector3.hpp>

#include "godot/lobe_task.h"

namespace lobelight {

// Recipe in, lobe table out.
class LobeBaker : public LobeTask {
  GDCLASS(LobeBaker, LobeTask)

 public:
  godot::Dictionary bake(const godot::Dictionary& recipe) const;

  // One table of a set again, from the set's texels: {"data"}.
  godot::Dictionary refit(const godot::Dictionary& recipe, const godot::PackedByteArray& data,
                          int table) const;

  // NaN, and an error in the log, for what `bake` would refuse and for a view below the horizon.
  static double directional_albedo(const godot::String& brdf, const godot::Vector2& alpha,
                                   const godot::Vector3& view);

  // ρ(i, o) i_z for `count` light directions i in the plane of the normal and the view o; empty,
  // and an error in the log, for what directional_albedo() refuses.
  static godot::PackedFloat32Array slice_in_plane(const godot::String& brdf,
                                                  const godot::Vector2& alpha,
                                                  const godot::Vector3& view, int count);

 protected:
  static void _bind_methods();

  Work prepare(const godot::Dictionary& recipe) const override;
};

}  // namespace lobelight
