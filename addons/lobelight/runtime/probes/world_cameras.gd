@tool
extends RefCounted
## Tells shaders which world they draw: four bits of the cull masks of its cameras.
##
## CAMERA_VISIBLE_LAYERS is all that a shader sees of the world it is drawn in. Layers end at 20,
## and the editor's own begin at 24. The masks are changed on the rendering server only, so that
## [member Camera3D.cull_mask] stays what it is; and as nodes hand theirs on when they like, it is
## done in each frame while there are several worlds.

# Of the first layer that is no layer of nodes.
const _SHIFT := 20
const _BITS := 0xF << _SHIFT

var _worlds: Array[RID] = []
var _tree: SceneTree
var _nodes: Array[Camera3D] = []


## These worlds, by their scenarios, are to be told from one another; the first one is what cameras
## show that nobody told.
func tell(worlds: Array[RID]) -> void:
	var had_several := _worlds.size() > 1
	_worlds = worlds
	var has_several := worlds.size() > 1
	if has_several and not had_several:
		_begin()
	elif had_several and not has_several:
		_end()
	if has_several:
		_mark()


func get_worlds() -> Array[RID]:
	return _worlds


## [param more] is added to the world's number.
func get_bits(scenario: RID, more := 0) -> int:
	return (maxi(_worlds.find(scenario), 0) + more) << _SHIFT


func _begin() -> void:
	_tree = Engine.get_main_loop() as SceneTree
	if _tree == null:
		return
	for camera: Camera3D in _tree.root.find_children("*", "Camera3D", true, false):
		_nodes.append(camera)
	_tree.node_added.connect(_on_node_added)
	RenderingServer.frame_pre_draw.connect(_mark)


func _end() -> void:
	if _tree == null:
		return
	_tree.node_added.disconnect(_on_node_added)
	RenderingServer.frame_pre_draw.disconnect(_mark)
	for i in _nodes.size():
		if is_instance_valid(_nodes[i]):
			var camera := _nodes[i]
			RenderingServer.camera_set_cull_mask(camera.get_camera_rid(), camera.cull_mask)
	_nodes.clear()
	_tree = null


func _on_node_added(node: Node) -> void:
	var camera := node as Camera3D
	if camera != null and camera not in _nodes:
		_nodes.append(camera)


func _mark() -> void:
	for i in range(_nodes.size() - 1, -1, -1):
		if not is_instance_valid(_nodes[i]):
			_nodes.remove_at(i)
			continue
		var camera := _nodes[i]
		if camera.is_inside_tree():
			var mask := camera.cull_mask & ~_BITS | get_bits(camera.get_world_3d().scenario)
			RenderingServer.camera_set_cull_mask(camera.get_camera_rid(), mask)
