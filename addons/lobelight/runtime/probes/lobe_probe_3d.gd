@tool
@icon("../../icons/lobe_probe_3d.svg")
class_name LobeProbe3D
extends Node3D
## The light of a room, for [LobeMaterial3D]s.
##
## A box that is to have the size of the room. What stands in it reflects the room instead of the
## [LobeEnvironment3D]'s light, from where it stands: each lobe is moved to the place on the box's
## faces that it comes from. The box is turned with the node; its scale does not matter.
## [br][br]
## [b]Where the light comes from.[/b] Either from [member light], which was baked in the editor and
## is right in the first frame of the game; or, without one, from a capture of the scene around
## [member origin_offset], made when the game runs and as [member update_mode] says.
## [br][br]
## [b]Several probes.[/b] Each pixel of a mesh takes the light of the probes around it. Of probes
## that overlap, those of the highest [member priority] come first; equal ones are mixed. Outside a
## box its light fades over [member blend_distance] into what lies there: the next probe or the
## environment.
## [br][br]
## [b]Size and number.[/b] A light's faces have 256 × 256 texels, on phones 128 × 128, or as many
## as the project setting [code]lobelight/probes/size[/code] says; captures draw
## [code]lobelight/probes/views_per_frame[/code] of their six views in a frame. In Compatibility,
## the four probes nearest to the camera are shown, and where the others are, the environment.
## [br][br]
## Names and defaults are those of [ReflectionProbe], and so is what they do where nothing else is
## said. Its box projection is always on here, and its ambient light is not there:
## [LobeMaterial3D]s take no ambient light from probes. A hidden node gives no light.

## The room has been captured anew and the materials show it.
signal rebuilt
## A rebuild has ended, with a light or, as [method get_rebuild_error] says, without.
signal rebuild_finished

## When the room is captured anew. With a baked [member light] it never is.
enum UpdateMode {
	## When the node enters the tree, when its own properties change, and by [method rebuild].
	ONCE,
	## Also when the node moves, and when a lamp that reaches the box is switched, moved or changed.
	## The scene's lamps are looked at in each frame for it. Nothing tells of what else happens in
	## the scene: call [method rebuild] then, or take another mode.
	WHEN_CHANGED,
	## In every frame, as far as other probes leave them: one is captured in a frame.
	EVERY_FRAME,
	## All the time, spread over frames. The light is replaced at the end of each turn.
	TIME_SLICED,
}

const FrameWait := preload("../light/frame_wait.gd")
const LightRegistry := preload("../light/light_registry.gd")
const Pyramid := preload("../pyramid/pyramid.gd")
const LampWatch := preload("lamp_watch.gd")
const ProbeCapture := preload("probe_capture.gd")
const ProbeSchedule := preload("probe_schedule.gd")
const ProbeView := preload("probe_view.gd")
const WorldLight := preload("../light/world_light.gd")

## The box is at least that long along each axis, in metres.
const MIN_SIZE := 0.02

# The capture point keeps this distance from the box's faces, as that of a ReflectionProbe does.
const _MARGIN := 0.01
const _DEFAULT_SIZE := 20.0
# Captures after that of a change, each of which brings one more reflection between materials.
const _ECHOES := 2

## When the room is captured anew.
@export var update_mode := UpdateMode.ONCE:
	set(value):
		update_mode = value
		_mark_stale()
		_watch_lamps()
		update_configuration_warnings()
## A factor for the light.
@export_range(0.0, 1.0, 0.01, "or_greater") var intensity := 1.0:
	set(value):
		intensity = value if is_finite(value) and value > 0.0 else 0.0
		_update_placement()
		update_configuration_warnings()
## How far outside the box its light has faded into what lies there, in metres. Inside the box it is
## always whole, unlike that of a [ReflectionProbe], so that the box can have the room's size.
@export_range(0.0, 8.0, 0.01, "or_greater", "suffix:m") var blend_distance := 1.0:
	set(value):
		blend_distance = value if is_finite(value) and value > 0.0 else 0.0
		_update_placement()
		update_gizmos()
## Where boxes overlap, the light of the highest priority comes first, and others get what it
## leaves. Probes of one priority are mixed.
@export var priority := 0:
	set(value):
		priority = value
		_update_placement()
## How far from the capture point the scene is captured, in metres, and at least as far as the box's
## corners: what is farther is not drawn, which saves time where much lies outside the room.
@export_range(0.0, 16384.0, 0.1, "or_greater", "exp", "suffix:m") var max_distance := 0.0:
	set(value):
		max_distance = value if is_finite(value) and value > 0.0 else 0.0
		_mark_stale()
## The box's edges, in metres, along the node's own axes; its middle is the node. It should end at
## the walls.
@export_custom(PROPERTY_HINT_NONE, "suffix:m")
var size := Vector3(_DEFAULT_SIZE, _DEFAULT_SIZE, _DEFAULT_SIZE):
	set(value):
		for axis in 3:
			size[axis] = maxf(value[axis], MIN_SIZE) if is_finite(value[axis]) else _DEFAULT_SIZE
		# A smaller box may leave the capture point outside.
		origin_offset = origin_offset
		_update_placement()
		update_gizmos()
		update_configuration_warnings()
## The point that the room is captured from, from the box's middle, in metres. It stays inside the
## box, and should be in no object.
@export_custom(PROPERTY_HINT_NONE, "suffix:m") var origin_offset := Vector3.ZERO:
	set(value):
		var inside := _clamp_origin(value)
		if inside == origin_offset:
			return
		origin_offset = inside
		_mark_stale()
		_update_placement()
		update_gizmos()
## Whether the sky is left out of the capture: it is black then, so that it cannot shine through
## gaps. Lamps and what materials emit are captured nonetheless.
@export var interior := false:
	set(value):
		interior = value
		_mark_stale()
		update_configuration_warnings()
## Layers of the scene that are captured.
@export_flags_3d_render var cull_mask := 0xFFFFF:
	set(value):
		cull_mask = value
		_mark_stale()
		update_configuration_warnings()
## A light that was baked, by [i]Bake Light[/i] in the inspector. The probe shows it instead of
## captures, from the first frame on.
@export var light: LobeLight:
	set(value):
		light = value
		_show_baked()
		_mark_stale()
		_watch_lamps()
		_update_placement()
		notify_property_list_changed()
		update_configuration_warnings()

var _error := ""
var _view := ProbeView.new()
# Whether the light belongs to a world, and whether a capture has been asked for.
var _is_shown := false
var _is_awaited := false
var _waits: Array[FrameWait] = []


func _init() -> void:
	# The box is of metres, as that of a ReflectionProbe is.
	set_disable_scale(true)
	set_notify_transform(true)
	_view.on_end = _on_captured


func _notification(what: int) -> void:
	match what:
		NOTIFICATION_ENTER_WORLD:
			_view.node = self
			_view.world = WorldLight.of(self) if light == null else null
			_update_shown()
		NOTIFICATION_EXIT_WORLD:
			_leave()
			_view.node = null
			_view.world = null
		NOTIFICATION_VISIBILITY_CHANGED:
			_update_shown()
		NOTIFICATION_PREDELETE:
			_leave()
			for wait: FrameWait in _waits.duplicate():
				wait.go_on()
		NOTIFICATION_TRANSFORM_CHANGED:
			_update_placement()
			if update_mode == UpdateMode.WHEN_CHANGED:
				_mark_stale()
			update_configuration_warnings()


# The engine asks in the editor only; what answers is in no export.
func _get_configuration_warnings() -> PackedStringArray:
	const WARNINGS := "res://addons/lobelight/runtime/warnings/probe_warnings.gd"
	if not ResourceLoader.exists(WARNINGS):
		return []
	return load(WARNINGS).of(self)


## The box in the node's own axes.
func get_aabb() -> AABB:
	return AABB(-0.5 * size, size)


## The box's middle and axes in the world, without scale. It takes points of [method get_aabb] to
## the world.
func get_box() -> Transform3D:
	var place := global_transform if is_inside_tree() else transform
	return place.orthonormalized()


## Why the last [method rebuild] captured nothing, in a sentence; empty if it did.
func get_rebuild_error() -> String:
	return _error


## Captures the room anew, with the reflections between its materials, each capture in one frame.
## Changing a property does so by itself, spread over frames; call it when the scene has changed.
## [code]await probe.rebuild()[/code] gives false if it could not be done, with the reason in
## [method get_rebuild_error]. A baked [member light] is shown again when the
## node is shown or loaded anew.
func rebuild() -> bool:
	_error = _find_obstacle()
	if _error:
		rebuild_finished.emit()
		return false
	_ask_for_capture(true)
	var wait := FrameWait.new()
	_waits.append(wait)
	while _is_awaited:
		if FrameWait.is_rendering_paused():
			# It comes when rendering goes on.
			_is_awaited = false
			_error = "Rendering is paused, so nothing is drawn."
			rebuild_finished.emit()
			break
		await wait.went_on
	_waits.erase(wait)
	return _error.is_empty() and _is_shown


## The light that the probe shows, with its faces, so that it can be saved and given to
## [member light]; [code]null[/code] if there is none yet.
func get_light() -> LobeLight:
	var placed := LightRegistry.get_placed()
	if not _is_shown or placed == null:
		return null
	var faces: Array[Image] = placed.get_store().read(_view.light)
	if faces.is_empty():
		return null
	var stored := LobeLight.new()
	stored.faces = faces
	stored.size = faces[0].get_width()
	stored.level_variance = _view.light.level_variance
	stored.base_variance = _view.light.base_variance
	stored.is_even = _view.light.is_even
	_place(stored)
	return stored


func _watch_lamps() -> void:
	if _is_shown and light == null and update_mode == UpdateMode.WHEN_CHANGED:
		LampWatch.add(_view, _mark_stale)
	else:
		LampWatch.remove(_view)


# Why there is nothing to capture, in a sentence; empty if there is.
func _find_obstacle() -> String:
	if not is_inside_tree():
		return "The probe is in no world that it could capture."
	if not is_visible_in_tree():
		return "The probe is hidden, so it gives no light."
	if not Pyramid.has_renderer():
		return "There is no renderer to capture the room with: the engine runs headless."
	return ProbeCapture.find_loss()


# Belongs to its world's lights or not, as it is visible or not.
func _update_shown() -> void:
	var shown := is_inside_tree() and is_visible_in_tree() and Pyramid.has_renderer()
	if shown and not _is_shown:
		if light != null and _view.light.faces.is_empty() and light.get_problem().is_empty():
			_show_baked()
		_is_shown = true
		_update_placement()
		LightRegistry.add_probe(get_world_3d(), get_instance_id(), _view.light)
		_mark_stale()
		_watch_lamps()
	elif not shown:
		_leave()


func _leave() -> void:
	ProbeSchedule.drop(_view)
	LampWatch.remove(_view)
	if _is_awaited:
		_is_awaited = false
		_error = "The probe has been hidden, or has left its world."
		rebuild_finished.emit()
	if _is_shown:
		_is_shown = false
		_view.has_light = false
		LightRegistry.withdraw(get_instance_id())


func _ask_for_capture(urgent: bool) -> void:
	if _view.world == null:
		_view.world = WorldLight.of(self)
	if _view.world == null:
		return
	_is_awaited = true
	_view.echoes = 0 if _is_live() else _ECHOES
	_view.place.cull_mask = cull_mask
	_view.place.far = _get_reach()
	_view.place.sees_background = not interior
	ProbeSchedule.request(_view, update_mode == UpdateMode.EVERY_FRAME, urgent)


func _is_live() -> bool:
	return update_mode == UpdateMode.EVERY_FRAME or update_mode == UpdateMode.TIME_SLICED


func _on_captured(succeeded: bool) -> void:
	_is_awaited = false
	_error = "" if succeeded else "The renderer did not draw the room."
	if succeeded:
		rebuilt.emit()
	else:
		push_warning("LobeProbe3D: " + _error)
	rebuild_finished.emit()
	if succeeded and _is_shown and light == null and _is_live():
		_ask_for_capture(false)


# Takes the faces of the baked light, which other probes may have as well, each at its own place.
func _show_baked() -> void:
	var before := _view.light
	_view.light = LobeLight.new()
	if light != null:
		# A capture under way would overwrite it.
		ProbeSchedule.drop(_view)
		_is_awaited = false
		var problem := light.get_problem()
		if problem:
			push_error(
				(
					"LobeProbe3D: %s: %s"
					% [light.resource_path if light.resource_path else "Light", problem]
				)
			)
		else:
			_view.light.faces = light.faces
			_view.light.size = light.size
			_view.light.level_variance = light.level_variance
			_view.light.base_variance = light.base_variance
			_view.light.is_even = light.is_even
	_view.light.box_size = before.box_size
	if _is_shown:
		_update_placement()
		LightRegistry.add_probe(get_world_3d(), get_instance_id(), _view.light)


# How far the views of a capture reach: to the box's farthest corner at least, so that no wall at a
# face of the box is cut off by rounding.
func _get_reach() -> float:
	return maxf(max_distance, (0.5 * size + origin_offset.abs()).length())


# What a capture would show is another from now on.
func _mark_stale() -> void:
	if _is_shown and light == null and _find_obstacle().is_empty():
		_ask_for_capture(false)


# The light is the same, but shows elsewhere, or by another factor or order.
func _update_placement() -> void:
	if not _is_shown:
		return
	_place(_view.light)
	LightRegistry.update_placement(_view.light)


func _place(placed: LobeLight) -> void:
	var box := get_box()
	placed.rotation = box.basis
	placed.box_middle = box.origin
	placed.box_size = size
	placed.box_origin = origin_offset
	placed.blend_distance = blend_distance
	placed.priority = priority
	placed.energy = intensity


func _clamp_origin(point: Vector3) -> Vector3:
	var inside := Vector3.ZERO
	for axis in 3:
		var limit := maxf(0.5 * size[axis] - _MARGIN, 0.0)
		if is_finite(point[axis]):
			inside[axis] = clampf(point[axis], -limit, limit)
	return inside
