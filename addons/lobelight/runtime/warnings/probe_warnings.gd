@tool
extends Object
## What keeps a [LobeProbe3D] from lighting its room as it could, each in a sentence or two that say
## what to do. The scene tree and the inspector show them; players never look.

const EnvironmentWarnings := preload("environment_warnings.gd")
const Pyramid := preload("../pyramid/pyramid.gd")

# No room is smaller, in metres.
const _LEAST_SIZE := 0.1
const _SCALE_TOLERANCE := 1e-3


## All of a probe's.
static func of(probe: LobeProbe3D) -> PackedStringArray:
	var warnings: PackedStringArray = []
	var shortest := probe.size[probe.size.min_axis_index()]
	if shortest < _LEAST_SIZE:
		(
			warnings
			. append(
				(
					"The box is only %s m thick: give Size the room's measures, or drag the box's handles."
					% String.num(shortest, 3)
				)
			)
		)
	if probe.scale.distance_to(Vector3.ONE) > _SCALE_TOLERANCE:
		warnings.append("The node's scale does not matter: set it to 1, and Size to the room's.")
	if probe.intensity == 0.0:
		warnings.append(
			"Intensity is 0, so LobeMaterial3Ds in the room reflect nothing: set it to 1."
		)
	if probe.light == null:
		warnings.append_array(_of_capture(probe))
	elif probe.update_mode != LobeProbe3D.UpdateMode.ONCE:
		warnings.append(
			"Update Mode does nothing, as the baked Light is shown: clear it, or take Once."
		)
	return warnings


static func _of_capture(probe: LobeProbe3D) -> PackedStringArray:
	if not Pyramid.has_renderer():
		return ["There is no renderer to capture the room with, as the engine runs headless."]
	var warnings: PackedStringArray = []
	if probe.cull_mask & 0xFFFFF == 0:
		warnings.append(
			(
				"Cull Mask has no layer, so %s is captured: set the room's layers."
				% ("nothing" if probe.interior else "only the sky")
			)
		)
	if (
		EnvironmentWarnings.is_compatibility()
		and probe.update_mode == LobeProbe3D.UpdateMode.EVERY_FRAME
	):
		(
			warnings
			. append(
				(
					"In Compatibility, every update waits for the GPU: bake the light, or set Update Mode to "
					+ "Once or Time Sliced."
				)
			)
		)
	return warnings
