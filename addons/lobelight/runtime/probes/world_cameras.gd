@tool
extends RefCounted
## Tells shaders which world they draw: four bits of the cull masks of its cameras.
##
## CAMERA_VISIBLE_LAYERS is all that a shader can know of its world. Layers of nodes end at 20, and
## the editor's own begin at 24. The masks are changed on the rendering server only, so [member
## Camera3D.cull_mask] stays as it is. Nodes may set theirs again at any time, so the masks are
## written in each frame while there are cameras in several worlds.

# Of the first layer that is no layer of nodes.
const _SHIFT := 20
const _BITS := 0xF << _SHIFT
## The number of worlds that have no light.
const UNLIT := 7

var _worlds: Array[RID] = []
var _tree: SceneTree
var _nodes: Array[Camera3D] = []


## Sets the worlds, by their scenarios, that are told apart. Cameras whose masks are not set show
## the first one.
func tell(worlds: Array[RID]) -> void:
	_worlds = worlds
	if not worlds.is_empty() and _tree == null:
		_begin()
	elif worlds.is_empty():
		_end()
	_mark()


func get_worlds() -> Array[RID]:
	return _worlds


## [param more] is added to the world's number.
func get_bits(scenario: RID, more := 0) -> int:
	var found := _worlds.find(scenario)
	return (found + more if found >= 0 else UNLIT) << _SHIFT


func _begin() -> void:
	_tree = Engine.get_main_loop() as SceneTree
	if _tree == null:
		return
	for camera: Camera3D in _tree.root.find_children("*", "Camera3D", true, false):
		_nodes.append(camera)
	_tree.node_added.connect(_on_node_added)


func _end() -> void:
	if _tree == null:
		return
	_tree.node_added.disconnect(_on_node_added)
	_follow(false)
	for i in _nodes.size():
		if is_instance_valid(_nodes[i]):
			var camera := _nodes[i]
			RenderingServer.camera_set_cull_mask(camera.get_camera_rid(), camera.cull_mask)
	_nodes.clear()
	_tree = null


func _on_node_added(node: Node) -> void:
	var camera := node as Camera3D
	if camera == null:
		return
	if camera not in _nodes:
		_nodes.append(camera)
	# Its world is known by then.
	_follow(true)


# Whether the cameras are looked at in each frame.
func _follow(always: bool) -> void:
	if always == RenderingServer.frame_pre_draw.is_connected(_mark):
		return
	if always:
		RenderingServer.frame_pre_draw.connect(_mark)
	else:
		RenderingServer.frame_pre_draw.disconnect(_mark)


func _mark() -> void:
	# All others show the first world's lights as they are.
	var has_several := false
	for i in range(_nodes.size() - 1, -1, -1):
		if not is_instance_valid(_nodes[i]):
			_nodes.remove_at(i)
			continue
		var camera := _nodes[i]
		if camera.is_inside_tree():
			var mask := camera.cull_mask & ~_BITS | get_bits(camera.get_world_3d().scenario)
			has_several = has_several or mask != camera.cull_mask
			RenderingServer.camera_set_cull_mask(camera.get_camera_rid(), mask)
	_follow(has_several)
