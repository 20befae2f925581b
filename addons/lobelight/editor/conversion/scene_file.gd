@tool
extends RefCounted
## The file of a scene in which materials are converted, before and after.

const Plan := preload("conversion_plan.gd")

## What changes in it.
var plan: Plan
var path := ""

var _root: Node
var _scene: PackedScene
# Both states of the scene and of its file.
var _states: Array[Dictionary] = [{}, {}]
var _bytes: Array[PackedByteArray] = [[], []]
# Of each change: path of the node, property, and both values.
var _values: Array[Array] = []


func _init(of_path := "", to_lobes := true, locked: Dictionary[String, String] = {}) -> void:
	path = of_path
	_scene = load(path) as PackedScene
	_root = _scene.instantiate(PackedScene.GEN_EDIT_STATE_MAIN) if _scene != null else null
	if _root != null:
		plan = Plan.make([_root], _root, to_lobes, true, locked)


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE and is_instance_valid(_root):
		_root.free()


## Forgets what is only needed until the file has been saved: the history keeps this object.
func release() -> void:
	plan = null
	if is_instance_valid(_root):
		_root.free()


## Works out the file's new state; a sentence if that fails. No file is changed by it.
func prepare() -> String:
	_bytes[0] = FileAccess.get_file_as_bytes(path)
	_states[0] = _scene.get("_bundled")
	for instance in plan.instances:
		_root.set_editable_instance(instance, true)
	for change in plan.changes:
		change.node.set(change.property, change.after)
		_values.append(
			[_root.get_path_to(change.node), change.property, change.before, change.after]
		)
	var packed := PackedScene.new()
	var error := packed.pack(_root)
	_states[1] = packed.get("_bundled")
	return "" if error == OK else "%s cannot be packed: %s." % [path, error_string(error)]


## Writes the new state for the first time; a sentence if that fails.
func save() -> String:
	_scene.set("_bundled", _states[1])
	# The editor writes beside the file and renames.
	var error := ResourceSaver.save(_scene, path, ResourceSaver.FLAG_REPLACE_SUBRESOURCE_PATHS)
	if error != OK:
		switch(false)
		return "%s cannot be written: %s." % [path, error_string(error)]
	_bytes[1] = FileAccess.get_file_as_bytes(path)
	return ""


## Gives the scene and its file the state after the conversion, or that before it.
func switch(is_converted: bool) -> void:
	_scene.set("_bundled", _states[int(is_converted)])
	var current := FileAccess.get_file_as_bytes(path)
	if current == _bytes[int(is_converted)]:
		return
	if current != _bytes[int(not is_converted)] and not _bytes[1].is_empty():
		push_warning("%s has been changed since: it stays as it is." % path)
		return
	var error := _write(_bytes[int(is_converted)])
	if error != OK:
		push_error("%s cannot be written: %s." % [path, error_string(error)])


func _write(bytes: PackedByteArray) -> Error:
	var temporary := path + ".tmp"
	var file := FileAccess.open(temporary, FileAccess.WRITE)
	if file == null:
		return FileAccess.get_open_error()
	file.store_buffer(bytes)
	file.close()
	var error := DirAccess.rename_absolute(temporary, path)
	if error != OK:
		DirAccess.remove_absolute(temporary)
	return error


## Gives the instances of the scene below [param node], which are open, the values that they have
## when they are loaded anew.
func refresh(node: Node, is_converted: bool) -> void:
	if _is_instance(node):
		_refresh_instance(node, is_converted)
	for child in node.get_children():
		refresh(child, is_converted)


func _refresh_instance(instance: Node, is_converted: bool) -> void:
	for value in _values:
		var node := instance.get_node_or_null(value[0] as NodePath)
		var from: Variant = value[2 if is_converted else 3]
		if node != null and is_same(node.get(value[1]), from):
			node.set(value[1], value[3 if is_converted else 2])


# Scenes that inherit from it have its nodes too.
func _is_instance(node: Node) -> bool:
	if node.scene_file_path == path:
		return true
	if node.scene_file_path.is_empty() or not ResourceLoader.exists(node.scene_file_path):
		return false
	var scene := load(node.scene_file_path) as PackedScene
	var state := scene.get_state().get_base_scene_state() if scene != null else null
	while state != null:
		if state.get_path() == path:
			return true
		state = state.get_base_scene_state()
	return false
