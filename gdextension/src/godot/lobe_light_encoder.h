#pragma once

#include "godot/lobe_task.h"

namespace lobelight {

// Puts the faces of a LobeLight into blocks that desktops' graphics cards sample.
class LobeLightEncoder : public LobeTask {
  GDCLASS(LobeLightEncoder, LobeTask)

 public:
  godot::Dictionary encode(const godot::Dictionary& request) const;

 protected:
  static void _bind_methods();

  Work prepare(const godot::Dictionary& request) const override;
};

}  // namespace lobelight
