#pragma once

#include "godot/lobe_task.h"

namespace lobelight {

// Brute-force pictures to compare renderers with.
class LobeReference : public LobeTask {
  GDCLASS(LobeReference, LobeTask)

 public:
  godot::Dictionary render_sphere(const godot::Dictionary& options) const;

 protected:
  static void _bind_methods();

  Work prepare(const godot::Dictionary& options) const override;
};

}  // namespace lobelight
