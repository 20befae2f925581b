@tool
extends Object
## Tells probes of lamps that have changed and reach their boxes.
##
## Nothing in the engine tells of a lamp's colour or energy, so that all lamps are looked at in each
## frame, while there are probes that want to know.

# What a capture shows of a lamp, besides its place.
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
	&"omni_range",
	&"omni_attenuation",
	&"spot_range",
	&"spot_attenuation",
	&"spot_angle",
]

# By the probe's light: what is called when a lamp in its reach has changed.
static var _listeners: Dictionary[LobeLight, Callable] = {}
static var _lamps: Dictionary[Light3D, Array] = {}
static var _tree: SceneTree


## [param on_change] is called when a lamp that reaches the light's box has changed.
static func add(light: LobeLight, on_change: Callable) -> void:
	_listeners[light] = on_change
	if _tree != null:
		return
	_tree = Engine.get_main_loop() as SceneTree
	if _tree == null:
		return
	for lamp: Light3D in _tree.root.find_children("*", "Light3D", true, false):
		_lamps[lamp] = _look_at(lamp)
	_tree.node_added.connect(_on_node_added)
	_tree.process_frame.connect(_look)
	_tree.root.tree_exiting.connect(_end)


static func remove(light: LobeLight) -> void:
	if _listeners.erase(light) and _listeners.is_empty():
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
	var lamp := node as Light3D
	if lamp != null and not _lamps.has(lamp):
		_lamps[lamp] = []


static func _look() -> void:
	for lamp: Variant in _lamps.keys():
		if not is_instance_valid(lamp):
			# Where it shone, nobody knows any more.
			_lamps.erase(lamp)
			for on_change: Callable in _listeners.values():
				on_change.call()
			continue
		var light: Light3D = lamp
		var before := _lamps[light]
		var now := _look_at(light)
		if now != before:
			_lamps[light] = now
			_tell(light, before)
			_tell(light, now)


# What is seen of a lamp; nothing of one that is not lit.
static func _look_at(lamp: Light3D) -> Array:
	if not lamp.is_inside_tree() or not lamp.is_visible_in_tree() or lamp.light_energy == 0.0:
		return []
	var seen: Array = [lamp.global_transform]
	for name in _PROPERTIES:
		seen.append(lamp.get(name))
	return seen


static func _tell(lamp: Light3D, seen: Array) -> void:
	if seen.is_empty():
		return
	var place: Transform3D = seen[0]
	var reach := INF
	if lamp is OmniLight3D:
		reach = lamp.omni_range
	elif lamp is SpotLight3D:
		reach = lamp.spot_range
	for light: LobeLight in _listeners.keys():
		var local := (place.origin - light.box_middle) * light.rotation
		var distance := (local.abs() - 0.5 * light.box_size).max(Vector3.ZERO).length()
		if distance <= reach:
			_listeners[light].call()
