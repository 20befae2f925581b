#pragma once

#include "godot/lobe_task.h"

namespace lobelight {

// Makes of a panorama what LobeLight holds: the faces of a cube map with blurred levels.
class LobeLightFilter : public LobeTask {
  GDCLASS(LobeLightFilter, LobeTask)

 public:
  godot::Dictionary filter(const godot::Dictionary& request) const;
  godot::Dictionary find_sources(const godot::Dictionary& request) const;

 protected:
  static void _bind_methods();

  Work prepare(const godot::Dictionary& request) const override;
};

}  // namespace lobelight
