@tool
extends RefCounted
## Draws the light of a [LobeEnvironment3D] while the game runs: when, in which slices, and what
## came of it. Exports leave it out where all light is baked.

const EnvironmentSource := preload("environment_source.gd")
const FirstFrame := preload("first_frame.gd")
const FrameWait := preload("../light/frame_wait.gd")
const LightRegistry := preload("../light/light_registry.gd")
const LightSettings := preload("../light/light_settings.gd")
const LiveTextures := preload("../light/live_textures.gd")
const Pyramid := preload("../pyramid/pyramid.gd")
const PyramidChain := preload("../pyramid/pyramid_chain.gd")

# Frames without an update after which the memory for drawing is given back.
const _IDLE_FRAMES := 120
# After this many frames without a change, the source is looked at only once in _STILL_STEP frames.
const _STILL_FRAMES := 120
const _STILL_STEP := 6
# After a change, captures that follow the first one; each adds one more reflection between
# materials.
const _ECHOES := 3
# How long a scene may take to set the sky that its light lacks, in milliseconds, before it is
# warned of.
const _PATIENCE := 2000

## What has been drawn; [code]null[/code] until then, and where it cannot be.
var light: LobeLight
## Why there is none, in a sentence.
var error := ""
## What the light is drawn with; given back some time after the last update.
var chain: PyramidChain
var source: EnvironmentSource
## Whether materials show no light at the moment, so that the node's capture has none in it.
var is_in_the_dark := false
## What the last update cost, in milliseconds, and the frames that it was drawn in.
var cpu_time := 0.0
var frames := 0

var _settings: LightSettings
# To be called when an update has ended; whether the light is another object than before.
var _on_end: Callable
# Whether the light is older than the properties, and whether its source has signalled a change.
var _stale := true
var _is_told_of_change := false
var _kind := EnvironmentSource.Kind.NONE
# The update under way: whether there is one, how and over how many frames it is spread, the next
# slice, and whether that has been drawn.
var _running := false
var _pace := PyramidChain.Pace.WHOLE
var _count := 1
var _slice := 0
var _drawn := false
# When the next one may begin by itself, in milliseconds.
var _next_time := 0
var _idle := 0
# Frames since the source was last found changed.
var _still := 0
var _waits: Array[FrameWait] = []
var _is_watching := false
# Captures that are still to follow, and whether materials have shown nothing but this node's
# captures, the first of which was made in the dark.
var _echoes := 0
var _lit_by_itself := false
# What materials draw besides the light's faces.
var _sources: Texture2D
# Whether the warning of a missing light has been given, and the time for it, in milliseconds.
var _is_told := false
var _tell_time := 0
var _gpu_time := 0.0


func _init(settings: LightSettings, on_end: Callable) -> void:
	_settings = settings
	_on_end = on_end
	source = EnvironmentSource.new(settings)


## Stops drawing, and ends the wait of everybody who waits for an update.
func end() -> void:
	_running = false
	light = null
	chain = null
	_stop_watching()
	for wait: FrameWait in _waits.duplicate():
		wait.go_on()


## To be called when the source or the way to filter it has changed.
func mark_stale() -> void:
	_stale = true
	_watch_frames()


## To be called when the source signals a change.
func follow_change() -> void:
	_is_told_of_change = true
	if light == null:
		_stale = true
	_watch_frames()


## Whether a light is to come that has not been drawn yet.
func is_awaited() -> bool:
	return (_stale or _running and light == null) and source.find_obstacle().is_empty()


## Frames in which an update that is spread over frames is drawn; 0 until the first.
func get_slices() -> int:
	return chain.get_slices() if chain != null else 0


## Milliseconds of the GPU for the last update.
func get_gpu_time() -> float:
	return chain.get_gpu_time() if chain != null else _gpu_time


## Draws the light anew, in one frame; whether it could be done.
func rebuild() -> bool:
	if not _begin(PyramidChain.Pace.WHOLE):
		return false
	return await _wait()


## The node has become the one that lights its world, or has ceased to be.
func follow_activity() -> void:
	if not _settings.is_active:
		return
	_watch_frames()
	if _kind == EnvironmentSource.Kind.SCENE_VIEWS and not _lit_by_itself:
		# It was captured in another's light.
		mark_stale()


## Gives the light its rotation and energy; whether they are others than before.
func place() -> bool:
	return light != null and source.place(light, _kind)


## To be called when the node leaves its world: that world's light is dropped.
func leave_world() -> void:
	_lit_by_itself = false
	is_in_the_dark = false
	if _kind == EnvironmentSource.Kind.PANORAMA and not _running:
		return
	if source.leave_world():
		mark_stale()
		chain = null
		_stop("The node has left the world whose light it was taking.")


## The scene may look different from where the node is now.
func follow_move() -> void:
	var captures := _settings.source == LightSettings.Source.CAPTURE
	if captures and _settings.update_mode == LightSettings.UpdateMode.WHEN_CHANGED:
		mark_stale()


# Waits until the update has ended. A later call may start the update again; both calls then get its
# result. The awaited object is not this one, so that the caller may free the node afterwards.
func _wait() -> bool:
	var wait := FrameWait.new()
	_waits.append(wait)
	while _running:
		if FrameWait.is_rendering_paused():
			mark_stale()
			_stop("Rendering is paused, so nothing is drawn.")
			break
		await wait.went_on
	_waits.erase(wait)
	return light != null and error.is_empty()


# Ends an update under way without a light of its own.
func _stop(why: String) -> void:
	if _running:
		_running = false
		error = why
		_on_end.call(false)


# Servers load scenes without a renderer and need no light.
func _watch_frames() -> void:
	if not _is_watching and Pyramid.has_renderer():
		_is_watching = true
		RenderingServer.frame_pre_draw.connect(_on_frame_pre_draw)
		RenderingServer.frame_post_draw.connect(_on_frame_post_draw)


func _stop_watching() -> void:
	if _is_watching:
		_is_watching = false
		RenderingServer.frame_pre_draw.disconnect(_on_frame_pre_draw)
		RenderingServer.frame_post_draw.disconnect(_on_frame_post_draw)


# Stops the calls in each frame if nothing can change without a call to the node.
func _rest_if_settled() -> void:
	var is_due := _stale or _is_told_of_change or _echoes > 0
	if _running or chain != null or _settings.is_active and is_due:
		return
	var is_still := _settings.update_mode == LightSettings.UpdateMode.ONCE
	if (
		_settings.update_mode == LightSettings.UpdateMode.WHEN_CHANGED
		and _kind == EnvironmentSource.Kind.PANORAMA
	):
		is_still = _settings.takes_panorama() and not LiveTextures.is_live(_settings.panorama)
	if is_still or not _settings.is_active:
		_stop_watching()


# Called when the frame's changes have all been made.
func _on_frame_pre_draw() -> void:
	# Hidden nodes, and those that wait for another one to leave, make nothing.
	if _settings.is_active and not _running:
		_stale = chain != null and source.follow_search(chain) or _stale
		_start_if_due()
	if _running:
		if chain != null:
			chain.draw(_slice)
		_drawn = true
		_idle = 0
		if _count == 1 and _settings.is_active and _is_first():
			_draw_ahead()
	elif chain != null and not chain.draw_for_clock() and not source.awaits_search(chain):
		_idle += 1
		var is_over := _settings.update_mode == LightSettings.UpdateMode.ONCE
		if _idle > _IDLE_FRAMES or is_over and not _settings.measure_cost:
			_gpu_time = get_gpu_time()
			chain = null
	if chain == null:
		_rest_if_settled()


# Has the first light in the first frame that is seen, where that is possible.
func _draw_ahead() -> void:
	var is_even := Pyramid.is_round(_settings.filter as Pyramid.Filter)
	if LightRegistry.needs_variants(_settings.node.get_world_3d(), is_even, source.takes_sources()):
		return
	if chain == null or source.is_there_before_the_frame() and FirstFrame.draw():
		_take_drawn()


# Whether materials show no light until this one comes.
func _is_first() -> bool:
	var owner := _settings.node.get_instance_id()
	if light != null or not _settings.node.is_inside_tree():
		return light == null
	return not LightRegistry.is_lit_by_other(_settings.node.get_world_3d(), owner)


func _start_if_due() -> void:
	var mode := _settings.update_mode
	if not _stale:
		# Without a light there is something in the way, which only a property can change.
		if light == null:
			return
		if _echoes > 0:
			var changed := mode == LightSettings.UpdateMode.WHEN_CHANGED and source.look()
			var echoes := _ECHOES if changed else _echoes - 1
			if _begin(PyramidChain.Pace.FACE_BY_FACE):
				_echoes = echoes
			return
		_still += 1
		var rests := _still > _STILL_FRAMES and _still % _STILL_STEP > 0 and not _is_told_of_change
		if mode == LightSettings.UpdateMode.ONCE or rests:
			return
		if _kind == EnvironmentSource.Kind.SKY_PANORAMA and place():
			_still = 0
			LightRegistry.update_placement(light, true)
		if Time.get_ticks_msec() < _next_time:
			return
		_stale = _is_continual() or source.look() or _is_told_of_change
		if not _stale:
			return
	var pace := _find_pace()
	if pace == PyramidChain.Pace.SLICED and chain != null and chain.awaits_clock():
		return
	_begin(pace)


func _find_pace() -> PyramidChain.Pace:
	if _is_first() or _settings.update_mode == LightSettings.UpdateMode.EVERY_FRAME:
		return PyramidChain.Pace.WHOLE
	return PyramidChain.Pace.SLICED if _settings.is_sliced() else PyramidChain.Pace.FACE_BY_FACE


# Starts an update from its first slice, instead of one under way.
func _begin(pace: PyramidChain.Pace) -> bool:
	_stale = false
	_still = 0
	_is_told_of_change = false
	_next_time = Time.get_ticks_msec() + roundi(1000.0 * _settings.update_interval)
	_running = false
	error = source.find_obstacle()
	var loss := source.find_loss() if error.is_empty() else ""
	if loss:
		error = loss
	if error:
		chain = null
		_set_light(null)
		if loss:
			push_error("LobeEnvironment3D: " + loss)
		# A panorama that is not set yet is no reason to warn.
		elif (
			_settings.panorama != null
			or _settings.source == LightSettings.Source.SKY
			or _settings.source == LightSettings.Source.CAPTURE
		):
			push_warning("LobeEnvironment3D: " + error)
		return false
	source.look()
	chain = source.make_chain(chain)
	_pace = pace
	_prepare_capture()
	_slice = 0
	_count = 1
	if chain != null:
		if _settings.is_sliced():
			chain.limit(EnvironmentSource.find_budget())
		_count = chain.plan(_pace)
	_running = true
	_drawn = false
	_watch_frames()
	return true


# Before the node's first capture materials show no light, because there is none of this scene's.
# But if another environment has lit the world until now, its light stays, so that nothing flashes.
func _prepare_capture() -> void:
	var captures := source.get_kind() == EnvironmentSource.Kind.SCENE_VIEWS
	_echoes = _ECHOES if captures and not _is_continual() else 0
	_lit_by_itself = _lit_by_itself and captures
	if captures and _settings.is_active and not _lit_by_itself:
		_lit_by_itself = true
		_pace = PyramidChain.Pace.WHOLE
		var world := _settings.node.get_world_3d()
		var owner := _settings.node.get_instance_id()
		if LightRegistry.is_lit_by_other(world, owner):
			return
		is_in_the_dark = true
		var is_even := Pyramid.is_round(_settings.filter as Pyramid.Filter)
		LightRegistry.offer(world, owner, LobeLight.make_dark(is_even))


func _is_continual() -> bool:
	return (
		_settings.update_mode == LightSettings.UpdateMode.EVERY_FRAME
		or _settings.update_mode == LightSettings.UpdateMode.TIME_SLICED
	)


func _on_frame_post_draw() -> void:
	if _running and _drawn:
		_take_drawn()


func _take_drawn() -> void:
	_drawn = false
	if chain != null and not chain.receive(_slice):
		_running = false
		chain = null
		error = "The renderer did not draw the pyramid."
		push_warning("LobeEnvironment3D: " + error)
		_set_light(null)
		return
	_slice += 1
	if _slice < _count:
		return
	_running = false
	frames = _count
	cpu_time = chain.transfer_time if chain != null else 0.0
	if chain == null:
		_gpu_time = 0.0
	_kind = source.get_kind()
	_lit_by_itself = _lit_by_itself and _settings.is_active
	_set_light(source.get_light(chain))


func _set_light(drawn: LobeLight) -> void:
	# Without a light, nobody has to wait for it any longer.
	var sources := drawn.sources if drawn != null else null
	var is_other := drawn != light or is_in_the_dark or drawn == null or sources != _sources
	light = drawn
	_sources = sources
	_lit_by_itself = _lit_by_itself and drawn != null
	is_in_the_dark = false
	if drawn != null and _kind == EnvironmentSource.Kind.EVEN:
		_tell_later()
	_on_end.call(is_other)


# In the editor, the scene tree says it.
func _tell_later() -> void:
	if _is_told or not _settings.node.is_inside_tree() or Engine.is_editor_hint():
		return
	var tree := _settings.node.get_tree()
	if not tree.process_frame.is_connected(_tell):
		_tell_time = Time.get_ticks_msec() + _PATIENCE
		tree.process_frame.connect(_tell)


func _tell() -> void:
	if Time.get_ticks_msec() < _tell_time:
		return
	var tree := Engine.get_main_loop() as SceneTree
	tree.process_frame.disconnect(_tell)
	var is_shown := _settings.node.is_inside_tree() and _settings.is_active
	var shortage := source.find_shortage() if is_shown else ""
	_is_told = not shortage.is_empty()
	if shortage:
		push_warning("LobeEnvironment3D: %s: %s" % [_settings.node.get_path(), shortage])
