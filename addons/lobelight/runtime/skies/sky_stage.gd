@tool
extends RefCounted
## A scenario with nothing in it but a world's directional lights, for views of its sky.
##
## Skies show these lights. The world's own scenario would do, but its cameras draw shadow maps and
## everything near the camera. The lights here are copies without shadows, in the order of the tree;
## lights that are no nodes are not among them.

var scenario := RenderingServer.scenario_create()

# The nodes, and by the same index their copies.
var _nodes: Array[DirectionalLight3D] = []
var _lights: Array[RID] = []
var _instances: Array[RID] = []
# What the copies were given.
var _seen: Array[Array] = []
var _world: World3D
var _tree: SceneTree


func _init(node: Node3D) -> void:
	_world = node.get_world_3d()
	_tree = node.get_tree()
	for light in _tree.root.find_children("*", "DirectionalLight3D", true, false):
		_add(light)
	_tree.node_added.connect(_add)


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE:
		for rid in _instances + _lights:
			RenderingServer.free_rid(rid)
		RenderingServer.free_rid(scenario)


## Copies what has changed in the lights; whether anything has.
func update() -> bool:
	var changed := false
	for i in range(_nodes.size() - 1, -1, -1):
		if not is_instance_valid(_nodes[i]) or not _nodes[i].is_inside_tree():
			_remove(i)
			changed = true
	for i in _nodes.size():
		if _update_light(i):
			changed = true
	return changed


func _add(node: Node) -> void:
	var light := node as DirectionalLight3D
	if light == null or light in _nodes:
		return
	var server := RenderingServer
	var copy := server.directional_light_create()
	server.light_directional_set_sky_mode(copy, RenderingServer.LIGHT_DIRECTIONAL_SKY_MODE_SKY_ONLY)
	_nodes.append(light)
	_lights.append(copy)
	_instances.append(server.instance_create2(copy, scenario))
	_seen.append([])


func _remove(index: int) -> void:
	RenderingServer.free_rid(_instances[index])
	RenderingServer.free_rid(_lights[index])
	_nodes.remove_at(index)
	_lights.remove_at(index)
	_instances.remove_at(index)
	_seen.remove_at(index)


func _update_light(index: int) -> bool:
	var node := _nodes[index]
	var shown := (
		node.is_visible_in_tree()
		and node.get_world_3d() == _world
		and node.sky_mode != DirectionalLight3D.SKY_MODE_LIGHT_ONLY
	)
	var state := [
		shown,
		node.global_basis.z,
		node.light_color,
		node.light_energy,
		node.light_angular_distance,
		node.light_negative,
		node.layers,
		node.light_temperature,
		node.light_intensity_lux,
	]
	if state == _seen[index]:
		return false
	_seen[index] = state
	var server := RenderingServer
	var light := _lights[index]
	var instance := _instances[index]
	server.instance_set_visible(instance, shown)
	server.instance_set_layer_mask(instance, node.layers)
	server.instance_set_transform(instance, Transform3D(node.global_basis, Vector3.ZERO))
	server.light_set_color(light, _colour_of(node))
	server.light_set_negative(light, node.light_negative)
	server.light_set_param(light, RenderingServer.LIGHT_PARAM_ENERGY, node.light_energy)
	server.light_set_param(light, RenderingServer.LIGHT_PARAM_SIZE, node.light_angular_distance)
	server.light_set_param(light, RenderingServer.LIGHT_PARAM_INTENSITY, node.light_intensity_lux)
	return true


# As Light3D hands its colour on.
static func _colour_of(node: Light3D) -> Color:
	if not ProjectSettings.get_setting("rendering/lights_and_shadows/use_physical_light_units"):
		return node.light_color
	var linear := node.light_color.srgb_to_linear()
	var tint := node.get_correlated_color().srgb_to_linear()
	return Color(linear.r * tint.r, linear.g * tint.g, linear.b * tint.b).linear_to_srgb()
