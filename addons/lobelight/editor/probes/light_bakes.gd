@tool
extends RefCounted
## Bakes the light of probes, one after the other: captures the room, saves the light beside the
## scene, and gives it to the probe by an action that can be undone. Where that fails or is
## cancelled, probe and file stay as they are.

## Probes have been added, or a bake has begun or ended.
signal changed
## A probe has its light.
signal baked(probe: LobeProbe3D)
## A probe could not be baked; the message is a sentence.
signal failed(probe: LobeProbe3D, message: String)
## A bake has been cancelled.
signal cancelled(probe: LobeProbe3D)

const LightFile := preload("light_file.gd")

## Gives the light of a probe's room, ready to be saved, or a sentence that says why it cannot.
var capture := _capture

var _undo_redo: EditorUndoRedoManager
var _waiting: Array[LobeProbe3D] = []
var _running: LobeProbe3D
var _is_cancelling := false
var _done := 0
# This object, while it bakes: captures end also when the addon is disabled meanwhile.
var _itself: RefCounted


func _init(undo_redo: EditorUndoRedoManager = null) -> void:
	_undo_redo = undo_redo


## Bakes the light of a probe, after those that have been added before.
func add(probe: LobeProbe3D) -> void:
	if is_baking(probe):
		return
	_waiting.append(probe)
	if _running == null:
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


## Whether the probe's light is being baked or waits for it.
func is_baking(probe: LobeProbe3D) -> bool:
	return probe == _running or probe in _waiting


## The probe that is baked, or [code]null[/code].
func get_running() -> LobeProbe3D:
	return _running if is_instance_valid(_running) else null


## How many bakes have ended, and how many there are with them, since there was none.
func get_progress() -> Vector2i:
	return Vector2i(_done, _done + _waiting.size() + (0 if _running == null else 1))


## Cancels the bake under way, and all that wait.
func cancel_all() -> void:
	var waiting := _waiting.duplicate()
	_waiting.clear()
	for probe: Variant in waiting:
		if is_instance_valid(probe):
			cancelled.emit(probe)
	_is_cancelling = _running != null
	changed.emit()


## Has a probe show its room live again. The file stays, for undo.
func clear(probe: LobeProbe3D) -> void:
	if probe.light == null:
		return
	_undo_redo.create_action("Clear Baked Light", UndoRedo.MERGE_DISABLE, probe)
	_undo_redo.add_do_property(probe, "light", null)
	_undo_redo.add_undo_property(probe, "light", probe.light)
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


func _bake(probe: LobeProbe3D) -> void:
	var root := EditorInterface.get_edited_scene_root()
	var problem := LightFile.find_problem(probe, root)
	if problem:
		failed.emit(probe, problem)
		return
	var result: Variant = await capture.call(probe)
	if not is_instance_valid(probe):
		return
	if _is_cancelling:
		_show_again(probe)
		cancelled.emit(probe)
		return
	if result is LobeLight:
		# Another scene may be open by now.
		root = EditorInterface.get_edited_scene_root()
		problem = LightFile.find_problem(probe, root)
		if problem.is_empty():
			problem = _keep(probe, result, LightFile.choose_path(probe, root))
	else:
		problem = result
	if problem:
		_show_again(probe)
		failed.emit(probe, problem)
	else:
		baked.emit(probe)


func _keep(probe: LobeProbe3D, light: LobeLight, path: String) -> String:
	var before := probe.light
	var replaces := before != null and before.resource_path == path
	var problem := LightFile.write(light, path)
	if problem:
		return problem
	_undo_redo.create_action("Bake Light", UndoRedo.MERGE_DISABLE, probe)
	_undo_redo.add_do_method(self, "_restore", light, path)
	_undo_redo.add_do_property(probe, "light", light)
	_undo_redo.add_undo_property(probe, "light", before)
	if replaces:
		_undo_redo.add_undo_method(self, "_restore", before, path)
	_undo_redo.commit_action()
	return ""


# A capture has taken the place of the light that was baked before.
func _show_again(probe: LobeProbe3D) -> void:
	if probe.light != null:
		probe.light = probe.light


# The file has the light that the probe has, also after undo and redo.
func _restore(light: LobeLight, path: String) -> void:
	if light.resource_path == path:
		return
	var problem := LightFile.write(light, path)
	if problem:
		push_error("Lobelight: " + problem)


func _capture(probe: LobeProbe3D) -> Variant:
	if not await probe.rebuild():
		var error := probe.get_rebuild_error() if is_instance_valid(probe) else ""
		return error if error else "The room was not captured."
	var light := probe.get_light()
	return light if light != null else "The room's light could not be read back from the GPU."
