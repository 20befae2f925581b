#pragma once

namespace godot {

// The component type of the engine's vectors in its usual, single-precision build.
using real_t = float;

}  // namespace godot
