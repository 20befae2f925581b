@tool
extends Object
## Tells probes of lamps that have changed and reach their boxes.
##
## Nothing in the engine tells of a lamp's colour or energy, so that all lamps are looked at in each
## frame, while there are probes that want to know.

const ProbeView := preload("probe_view.gd")

# What a capture shows of a lamp, besides its place and reach.
const _PROPERTIES: Array[StringName] = [
	&"light_color",
	&"light_energy",
	&"light_indirect_energy",
	&"light_negative",
	&"light_projector",
	&"light_size",
	&"light_specular",
	&"light_temperature",
	&"light_cull_mask",
	&"shadow_enabled",
	&"omni_attenuation",
	&"spot_attenuation",
	&"spot_angle",
]

# What is called when a lamp that reaches a probe's box has changed.
static var _listeners: Dictionary[ProbeView, Callable] = {}
# By instance id, what was last seen of each lamp: its world, place, reach and properties.
static var _lamps: Dictionary[int, Array] = {}
static var _tree: SceneTree


## [param on_change] is called when a lamp that reaches the probe's box has changed.
static func add(view: ProbeView, on_change: Callable) -> void:
	_listeners[view] = on_change
	if _tree != null:
		return
	_tree = Engine.get_main_loop() as SceneTree
	if _tree == null:
		return
	for lamp: Light3D in _tree.root.find_children("*", "Light3D", true, false):
		_lamps[lamp.get_instance_id()] = _look_at(lamp)
	_tree.node_added.connect(_on_node_added)
	_tree.process_frame.connect(_look)
	_tree.root.tree_exiting.connect(_end)


static func remove(view: ProbeView) -> void:
	if _listeners.erase(view) and _listeners.is_empty():
		_end()


static func _end() -> void:
	if _tree == null:
		return
	_tree.node_added.disconnect(_on_node_added)
	_tree.process_frame.disconnect(_look)
	_tree.root.tree_exiting.disconnect(_end)
	_tree = null
	_listeners.clear()
	_lamps.clear()


static func _on_node_added(node: Node) -> void:
	if node is Light3D and not _lamps.has(node.get_instance_id()):
		_lamps[node.get_instance_id()] = []


static func _look() -> void:
	for id: int in _lamps.keys():
		var before := _lamps[id]
		var lamp := instance_from_id(id) as Light3D
		var now := _look_at(lamp) if lamp != null else []
		if lamp == null:
			_lamps.erase(id)
		if now == before:
			continue
		if lamp != null:
			_lamps[id] = now
		# Once for what both have reached.
		for view: ProbeView in _listeners.keys():
			if _reaches(before, view) or _reaches(now, view):
				_listeners[view].call()


# Nothing is seen of a lamp that is not lit.
static func _look_at(lamp: Light3D) -> Array:
	if not lamp.is_inside_tree() or not lamp.is_visible_in_tree() or lamp.light_energy == 0.0:
		return []
	var reach := INF
	if lamp is OmniLight3D:
		reach = lamp.omni_range
	elif lamp is SpotLight3D:
		reach = lamp.spot_range
	var seen: Array = [lamp.get_world_3d().scenario, lamp.global_transform, reach]
	for name in _PROPERTIES:
		seen.append(lamp.get(name))
	return seen


static func _reaches(seen: Array, view: ProbeView) -> bool:
	if seen.is_empty() or seen[0] != view.node.get_world_3d().scenario:
		return false
	var light := view.light
	var place: Transform3D = seen[1]
	var reach: float = seen[2]
	var local := (place.origin - light.box_middle) * light.rotation
	return (local.abs() - 0.5 * light.box_size).max(Vector3.ZERO).length() <= reach
