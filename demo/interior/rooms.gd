extends Node3D
## The light of the rooms and of the yard: this project's probes, and the engine's around the
## same rooms for its own material.

const Layers := preload("../layers.gd")
const Plan := preload("plan.gd")
const _CAPTURED := Layers.COMMON | Layers.REFLECTED
const _BLEND := 0.5
const _ENGINE_BLEND := 0.15
# Beyond what can be seen from the yard, in metres.
const _REACH := 100.0
# In the yard the house and the paving are captured with the sky.
const _YARD_PRIORITY := -1

var _lobe_probes: Array[LobeProbe3D] = []
var _engine_probes: Array[ReflectionProbe] = []


func _init() -> void:
	_add(Plan.WARM, Vector3(0.0, 0.1, 0.25), true)
	_add(Plan.COOL, Vector3(0.0, 0.1, 0.25), true)
	_add(Plan.YARD, Vector3(0.0, -1.0, 0.3), false)


## Whether the engine's probes are there, too: they are for its own material.
func show_engine_probes(are_shown: bool) -> void:
	for probe in _engine_probes:
		probe.visible = are_shown


## Captures the warm room anew, in which something has changed; the others keep their light.
func rebuild_warm_room() -> void:
	if is_inside_tree():
		_lobe_probes[0].rebuild()
	_rebuild_engine_probe(_engine_probes[0])


## Ends when all rooms have been captured. Returns "", or one sentence.
func prepare() -> String:
	for probe in _lobe_probes:
		if not await probe.rebuild():
			return probe.get_rebuild_error()
	return ""


func _add(box: AABB, origin: Vector3, is_room: bool) -> void:
	var lobes := LobeProbe3D.new()
	lobes.position = box.get_center()
	lobes.size = box.size
	lobes.origin_offset = origin
	lobes.interior = is_room
	lobes.blend_distance = _BLEND
	lobes.cull_mask = _CAPTURED
	lobes.max_distance = 0.0 if is_room else _REACH
	lobes.priority = 0 if is_room else _YARD_PRIORITY
	_lobe_probes.append(lobes)
	add_child(lobes)
	var engine := ReflectionProbe.new()
	engine.position = lobes.position
	# Inside its box the light of such a probe fades towards the faces, here from the room's on.
	engine.size = box.grow(_ENGINE_BLEND).size
	engine.origin_offset = origin
	engine.interior = is_room
	engine.box_projection = true
	engine.blend_distance = _ENGINE_BLEND
	engine.cull_mask = _CAPTURED
	engine.ambient_mode = ReflectionProbe.AMBIENT_DISABLED
	engine.max_distance = _REACH
	engine.visible = false
	_engine_probes.append(engine)
	add_child(engine)


# One that is drawn once is drawn anew when it reaches farther, or less far.
static func _rebuild_engine_probe(probe: ReflectionProbe) -> void:
	probe.max_distance = 2.0 * _REACH + 1.0 - probe.max_distance
