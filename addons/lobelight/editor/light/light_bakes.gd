@tool
extends RefCounted
## Bakes the light of probes and environments, one after the other: captures the room, or makes the
## environment's light, saves it beside the scene, and gives it to the node by an action that can be
## undone. Where that fails or is cancelled, node and file stay as they are.

## Nodes have been added, or a bake has begun or ended.
signal changed
## A node has its light.
signal baked(node: Node3D)
## A node's light could not be baked; the message is a sentence.
signal failed(node: Node3D, message: String)
## A bake has been cancelled.
signal cancelled(node: Node3D)

const EnvironmentBake := preload("environment_bake.gd")
const LightFile := preload("light_file.gd")
const LightFormats := preload("light_formats.gd")

## Gives the light of a node, ready to be saved, or a sentence that says why it cannot.
var capture := _capture

var _undo_redo: EditorUndoRedoManager
var _waiting: Array[Node3D] = []
var _running: Node3D
var _is_cancelling := false
# The same for all: what is freed while its own function ends leaves that behind (Godot 4.6).
var _environment_bake := EnvironmentBake.new()
var _done := 0
# This object, while it bakes: captures end also when the addon is disabled meanwhile.
var _itself: RefCounted


func _init(undo_redo: EditorUndoRedoManager = null) -> void:
	_undo_redo = undo_redo


## Bakes the light of a node, after those that have been added before.
func add(node: Node3D) -> void:
	if is_baking(node):
		return
	_waiting.append(node)
	# A node that has gone while it was baked is none, but its bake is not over.
	if _itself == null:
		_run()
	else:
		changed.emit()


## Bakes the probes of a scene that are saved with it; how many these are.
func add_all(root: Node) -> int:
	var count := 0
	for probe in LightFile.find_probes(root):
		if LightFile.is_saved(probe, root):
			count += 1
			add(probe)
	return count


## Whether a node's light is being baked or waits for it.
func is_baking(node: Node3D) -> bool:
	return node == _running or node in _waiting


## The node whose light is baked, or [code]null[/code].
func get_running() -> Node3D:
	return _running if is_instance_valid(_running) else null


## How much of the bake under way is done, from 0 to 1, as far as it is known.
func get_fraction() -> float:
	return _environment_bake.get_progress()


## How many bakes have ended, and how many there are with them, since there was none.
func get_progress() -> Vector2i:
	return Vector2i(_done, _done + _waiting.size() + (0 if _running == null else 1))


## Cancels the bake under way, and all that wait.
func cancel_all() -> void:
	var waiting := _waiting.duplicate()
	_waiting.clear()
	for node: Variant in waiting:
		if is_instance_valid(node):
			cancelled.emit(node)
	_is_cancelling = _itself != null
	_environment_bake.cancel()
	changed.emit()


## Has a node's light be live again. The file stays, for undo.
func clear(node: Node3D) -> void:
	if LightFile.get_light(node) == null:
		return
	_undo_redo.create_action("Clear Baked Light", UndoRedo.MERGE_DISABLE, node)
	_undo_redo.add_do_property(node, "light", null)
	_undo_redo.add_undo_property(node, "light", LightFile.get_light(node))
	_undo_redo.commit_action()


func _run() -> void:
	_itself = self
	_done = 0
	# Captures wait for frames, which the editor draws only if something has changed.
	var was_frugal := OS.low_processor_usage_mode
	OS.low_processor_usage_mode = false
	while not _waiting.is_empty():
		# It may be gone with its scene.
		var next: Variant = _waiting.pop_front()
		if is_instance_valid(next):
			_running = next
			_is_cancelling = false
			changed.emit()
			await _bake(_running)
		_done += 1
	_running = null
	OS.low_processor_usage_mode = was_frugal
	changed.emit()
	_itself = null


func _bake(node: Node3D) -> void:
	var root := EditorInterface.get_edited_scene_root()
	var problem := LightFile.find_problem(node, root)
	if problem:
		failed.emit(node, problem)
		return
	var result: Variant = await capture.call(node)
	if not is_instance_valid(node):
		return
	if _is_cancelling:
		_show_again(node)
		cancelled.emit(node)
		return
	if result is LobeLight:
		# Another scene may be open by now.
		root = EditorInterface.get_edited_scene_root()
		problem = LightFile.find_problem(node, root)
		if problem.is_empty():
			problem = _keep(node, result, LightFile.choose_path(node, root))
	else:
		problem = result
	if problem:
		_show_again(node)
		failed.emit(node, problem)
	else:
		baked.emit(node)


func _keep(node: Node3D, light: LobeLight, path: String) -> String:
	var before := LightFile.get_light(node)
	var replaces := before != null and before.resource_path == path
	var problem := LightFile.write(light, path)
	if problem:
		return problem
	_undo_redo.create_action("Bake Light", UndoRedo.MERGE_DISABLE, node)
	_undo_redo.add_do_method(self, "_restore", light, path)
	_undo_redo.add_do_property(node, "light", light)
	_undo_redo.add_undo_property(node, "light", before)
	if replaces:
		_undo_redo.add_undo_method(self, "_restore", before, path)
	_undo_redo.commit_action()
	return ""


# The capture of a probe has taken the place of the light that was baked before.
func _show_again(node: Node3D) -> void:
	if LightFile.get_light(node) != null:
		node.set(&"light", LightFile.get_light(node))


# The file has the light that the node has, also after undo and redo.
func _restore(light: LobeLight, path: String) -> void:
	if light.resource_path == path:
		return
	var problem := LightFile.write(light, path)
	if problem:
		push_error("Lobelight: " + problem)


# An eighth of the bytes of half floats, and a little more.
static func _pack(light: LobeLight) -> Variant:
	var problem := LightFormats.convert_light(light, LightFormats.Format.BPTC)
	return problem if problem else light


func _capture(node: Node3D) -> Variant:
	if node is LobeEnvironment3D:
		var made: Variant = await _environment_bake.make(node as LobeEnvironment3D)
		return _pack(made as LobeLight) if made is LobeLight else made
	var probe := node as LobeProbe3D
	if not await probe.rebuild():
		var error := probe.get_rebuild_error() if is_instance_valid(probe) else ""
		return error if error else "The room was not captured."
	var light := probe.get_light()
	return light if light != null else "The room's light could not be read back from the GPU."
