@tool
extends RefCounted
## Watches what the engine has in some worlds: global illumination, and effects of the screen that
## darken diffuse light.
##
## New nodes, and other environments of a world, are signalled. The switches of environments and the
## data of nodes change without a signal, so these are looked at twice a second.

const DiffuseSource := preload("../light/diffuse_source.gd")

# What the materials' shaders include then, so that exported projects contain it.
const _INCLUDE := preload("engine_light.gdshaderinc")
# In seconds.
const _INTERVAL := 0.5
const _KINDS: Array[String] = ["Camera3D", "LightmapGI", "ReflectionProbe", "VoxelGI"]
const _UNITS := "rendering/lights_and_shadows/use_physical_light_units"

## Whether a visible [LightmapGI] or [VoxelGI] has data, an environment has SDFGI, or, where the
## addon has no probes, a visible [ReflectionProbe] has ambient light.
var has_global_illumination := false
## Whether an environment has SSAO or SSIL that needs the diffuse light apart. Compatibility's SSAO
## takes the whole picture.
var has_screen_occlusion := false

var _on_change: Callable
# Worlds by their ids: a reference would keep a world alive, which would then count as shown.
var _worlds: Array[int] = []
# Those of them in which diffuse light comes from probes of the addon, if not from the engine.
var _with_probes: Array[int] = []
# The ids of cameras, and of nodes with global illumination.
var _nodes: Array[int] = []
var _tree: SceneTree
var _timer: SceneTreeTimer
var _setting := 0
var _is_queued := false


func _init(on_change: Callable) -> void:
	_on_change = on_change


func has_any() -> bool:
	return has_global_illumination or has_screen_occlusion


## Counts what these worlds have from now on, some of them [param with_probes]. Whether it is
## something else than before.
func follow(worlds: Array[World3D], with_probes: Array[World3D]) -> bool:
	_leave_worlds()
	for world in with_probes:
		_with_probes.append(world.get_instance_id())
	for world in worlds:
		world.changed.connect(_queue_look)
		_worlds.append(world.get_instance_id())
	if _tree == null:
		_begin()
	return _look()


func end() -> void:
	_leave_worlds()
	_nodes.clear()
	if _tree != null:
		_tree.node_added.disconnect(_on_node_added)
		_timer.timeout.disconnect(_on_timeout)
		# So that the tree lets go of it.
		_timer.time_left = 0.0
	_tree = null
	_timer = null


func _leave_worlds() -> void:
	for id in _worlds:
		var world := instance_from_id(id) as World3D
		if world != null:
			world.changed.disconnect(_queue_look)
	_worlds.clear()
	_with_probes.clear()


func _begin() -> void:
	_tree = Engine.get_main_loop() as SceneTree
	if _tree == null:
		return
	_setting = ProjectSettings.get_setting(DiffuseSource.SETTING, 0)
	for kind: String in _KINDS:
		for node in _tree.root.find_children("*", kind, true, false):
			_nodes.append(node.get_instance_id())
	_tree.node_added.connect(_on_node_added)
	_wait()


func _wait() -> void:
	_timer = _tree.create_timer(_INTERVAL, true, false, true)
	_timer.timeout.connect(_on_timeout)


func _on_timeout() -> void:
	_wait()
	_look_and_tell()


func _on_node_added(node: Node) -> void:
	if _KINDS.any(func(kind: String) -> bool: return node.is_class(kind)):
		if node.get_instance_id() not in _nodes:
			_nodes.append(node.get_instance_id())
		_queue_look()


# In which world a node is, and which camera is the current one, is known a little later.
func _queue_look() -> void:
	if not _is_queued:
		_is_queued = true
		_look_and_tell.call_deferred()


func _look_and_tell() -> void:
	_is_queued = false
	if _tree != null and _look():
		_on_change.call()


# Whether something has changed.
func _look() -> bool:
	var had_illumination := has_global_illumination
	var had_occlusion := has_screen_occlusion
	has_global_illumination = false
	has_screen_occlusion = false
	for id in _worlds:
		var world := instance_from_id(id) as World3D
		if world != null:
			var own := world.environment
			_look_at_environment(own if own != null else world.fallback_environment)
	for i in range(_nodes.size() - 1, -1, -1):
		var node := instance_from_id(_nodes[i]) as Node3D
		if node == null:
			_nodes.remove_at(i)
		elif node.is_inside_tree() and node.get_world_3d().get_instance_id() in _worlds:
			_look_at_node(node)
	var setting: int = ProjectSettings.get_setting(DiffuseSource.SETTING, 0)
	var has_changed := setting != _setting
	_setting = setting
	has_changed = has_changed or has_global_illumination != had_illumination
	return has_changed or has_screen_occlusion != had_occlusion


func _look_at_node(node: Node3D) -> void:
	if node is Camera3D:
		var camera: Camera3D = node
		if camera.current:
			_look_at_environment(camera.environment)
	elif node.is_visible_in_tree():
		if node is LightmapGI:
			has_global_illumination = has_global_illumination or node.light_data != null
		elif node is ReflectionProbe:
			has_global_illumination = has_global_illumination or _lights(node)
		elif _is_forward_plus():
			has_global_illumination = has_global_illumination or node.data != null


# In Compatibility a shader's ambient light counts instead of theirs.
func _lights(probe: ReflectionProbe) -> bool:
	if RenderingServer.get_current_rendering_method() == "gl_compatibility":
		return false
	var is_alone := probe.get_world_3d().get_instance_id() not in _with_probes
	return is_alone and probe.ambient_mode != ReflectionProbe.AMBIENT_DISABLED


func _look_at_environment(environment: Environment) -> void:
	if environment == null or not _is_forward_plus():
		return
	has_global_illumination = has_global_illumination or environment.sdfgi_enabled
	# With physical units the engine scales what a shader emits, and does not what it gives for ambient
	# light: diffuse and reflected light would be apart.
	if not ProjectSettings.get_setting(_UNITS, false):
		var has_occlusion := environment.ssao_enabled or environment.ssil_enabled
		has_screen_occlusion = has_screen_occlusion or has_occlusion


static func _is_forward_plus() -> bool:
	return RenderingServer.get_current_rendering_method() == "forward_plus"
