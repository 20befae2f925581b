@tool
@icon("../../icons/lobe_environment_3d.svg")
class_name LobeEnvironment3D
extends Node3D
## Where the light of [LobeMaterial3D]s comes from.
##
## The node filters its [member source] into a pyramid and hands it to all [LobeMaterial3D]s, which
## are lit by it from the next frame on. A hidden node gives no light.
## [br][br]
## [b]The scene's sky[/b] is that of the [Environment] which the engine takes for the camera of the
## node's viewport: the camera's own, else the world's. All kinds of skies are taken as a camera
## sees them, with their rotation and energy, the suns of [DirectionalLight3D]s and fog, also where
## another background hides a sky that lights. [member Environment.sky_custom_fov] and volumetric
## fog count as absent.
## [br][br]
## [b]Without a sky[/b], light comes from all sides as the engine has it for its own materials: the
## ambient light's colour, or that of the background. (Where ambient light is disabled, the
## background's colour is still reflected.) Metals show it too. Where it is black, or the clear
## colour, which smooth metals vanish in, the running game warns once.
## [br][br]
## [b]Units.[/b] Light is linear, in the units of the scene, up to 65504 (half floats). In
## Compatibility, skies and scenes are taken as the engine shows them there: it takes sky
## colours and HDR panoramas for sRGB, so that they are not the same as in the other renderers, and
## below 0.00084 they are black. A panorama of the node's is the same in all three.
## [br][br]
## [b]Cost.[/b] In Forward+ and Mobile, updates stay on the GPU. In Compatibility nothing can draw
## into a cube map, so the faces are read back, which waits for the GPU: [constant TIME_SLICED] and
## small sizes are advised there. With software drivers, 256 texels of a sky take about two thirds
## of a frame of 720p with eight lobes, and in Compatibility 2 ms of the processor besides
## ([code]./dev bench runtime[/code]); [member update_gpu_time] and
## [member update_cpu_time] tell for yours. Updates allocate nothing on the GPU.
## [br][br]
## There is to be one per [World3D]; a second one waits until the first has left. Hidden and waiting
## nodes make nothing. Each of up to four worlds shows its own light. When the node leaves, its
## light stays until that of the next one has been made; [member fade_time] has one fade into the
## other. [LobeProbe3D] has the light of rooms.

## The pyramid has been made anew and the materials have it.
signal rebuilt
## A rebuild has ended, with a pyramid or, as [method get_rebuild_error] says, without.
signal rebuild_finished

## What the light is taken from.
enum Source {
	## [member panorama] if it is set, otherwise the scene's sky.
	AUTOMATIC,
	## The sky that the camera sees. The node's transform does not matter.
	SKY,
	## [member panorama], turned by the node's rotation. Its position and scale do not matter.
	PANORAMA,
	## The scene around the node's position, and its sky. The node's rotation does not matter.
	## [LobeMaterial3D]s in it show the light of the capture before, and none at the first one, so that
	## each capture brings one more reflection between them. Four are made one after the other when
	## something has changed.
	CAPTURE,
}

## When the pyramid is made anew.
enum UpdateMode {
	## When the node enters the tree, when its own properties change, and by [method rebuild].
	ONCE,
	## Also when the source changes: another panorama or sky, any property of the
	## [Environment]'s background and of the sky's material, and [DirectionalLight3D]s. A panorama or
	## a texture of the sky's that is a [ViewportTexture], or that a camera or the rendering device
	## fills, counts as changed in every frame. Nothing tells of shaders that move by themselves
	## (TIME) or with the camera (POSITION), of global uniforms, of textures that are
	## filled without their signal [signal Resource.changed], and of what happens in a captured scene:
	## take another mode, or call [method rebuild]. Moving the node counts, where it captures.
	WHEN_CHANGED,
	## In every frame.
	EVERY_FRAME,
	## All the time, spread over frames, see [method get_sliced_frames]. The light is replaced at the
	## end of each turn.
	TIME_SLICED,
}

## How a level of the pyramid is made from the finer one.
enum Filter {
	## Means of 2 × 2 texels, as graphics hardware makes them.
	BOX,
	## [1 3 3 1] / 8 along each axis, across the edges of the cube.
	BINOMIAL,
	## Spherical Gaussians, which unlike the above blur equally along all directions. Less error at
	## the same cost per frame; making the pyramid takes longer.
	GAUSSIAN,
	## Means over discs, as round as the Gaussians. The least error, because mixtures of two levels,
	## which is what lobes look up, come nearer to Gaussians; the same cost as Gaussians.
	DISC,
}

const EnvironmentSource := preload("environment_source.gd")
const FrameWait := preload("frame_wait.gd")
const LightRegistry := preload("light_registry.gd")
const LightSettings := preload("light_settings.gd")
const LiveTextures := preload("live_textures.gd")
const Pyramid := preload("../pyramid/pyramid.gd")
const PyramidChain := preload("../pyramid/pyramid_chain.gd")

const _GROUP := &"_lobelight_environments"
# Frames without an update after which the memory for drawing is given back.
const _IDLE_FRAMES := 120
# Captures after that of a change, each of which brings one more reflection between materials.
const _ECHOES := 3
# Milliseconds in which a scene may still get the sky that its light lacks.
const _PATIENCE := 2000
# What is drawn in one frame has no slices.
const _WHOLE := -1

# Counts the environments that have come, so that the first of a world can be told.
static var _arrivals := 0

## What the light is taken from.
@export var source := Source.AUTOMATIC:
	set(value):
		source = value
		_settings.source = value as LightSettings.Source
		_mark_stale()
		notify_property_list_changed()
		update_configuration_warnings()
## When the pyramid is made anew.
@export var update_mode := UpdateMode.WHEN_CHANGED:
	set(value):
		update_mode = value
		_mark_stale()
		update_configuration_warnings()
## The surroundings, in the same projection as [PanoramaSkyMaterial]: +z in the middle, −z at the
## left and right edges. Linear light up to 65504; negative values and NaN count as dark. Formats
## of 8 bits are taken for sRGB.
@export var panorama: Texture2D:
	set(value):
		if panorama == value:
			return
		if panorama != null:
			panorama.changed.disconnect(_on_panorama_changed)
		panorama = value
		_settings.panorama = value
		# A sky may have the same one.
		if panorama != null and not panorama.changed.is_connected(_on_panorama_changed):
			panorama.changed.connect(_on_panorama_changed)
		_mark_stale()
		update_configuration_warnings()
## How the pyramid's levels are made.
@export var filter := Filter.DISC:
	set(value):
		filter = value
		_settings.filter = value as Pyramid.Filter
		_mark_stale()
## Texels along the side of the cube map's faces. Automatic is 256, and for panoramas their width,
## rounded up to a power of two, at most 512, which takes 17 MB. Half the size takes a quarter of
## that; what it loses shows in the sharpest reflections. Other values are rounded to a power of
## two.
@export_enum(
	"Automatic:0", "32:32", "64:64", "128:128", "256:256", "512:512", "1024:1024", "2048:2048"
)
var size := 0:
	set(value):
		size = 0 if value <= 0 else clampi(nearest_po2(value), Pyramid.MIN_SIZE, Pyramid.MAX_SIZE)
		_settings.size = size
		_mark_stale()
		update_configuration_warnings()
## A factor for the light.
@export_range(0.0, 16.0, 0.01, "or_greater") var energy := 1.0:
	set(value):
		energy = value if is_finite(value) and value > 0.0 else 0.0
		_settings.energy = energy
		_update_placement()
		update_configuration_warnings()

## Seconds in which a new light takes the place of the one before, when this node becomes the one
## that lights its world, or its source changes; 0 changes it at once. While lights fade, materials
## draw both.
@export_range(0.0, 10.0, 0.05, "or_greater", "suffix:s") var fade_time := 0.0:
	set(value):
		fade_time = maxf(value, 0.0) if is_finite(value) else 0.0

@export_group("Capture", "capture_")
## Layers of the scene that are captured.
@export_flags_3d_render var capture_cull_mask := 0xFFFFF:
	set(value):
		capture_cull_mask = value
		_settings.capture.cull_mask = value
		_mark_stale()
		update_configuration_warnings()
## What is nearer than this along the axes is not captured, in metres.
@export_range(0.001, 10.0, 0.001, "or_greater", "suffix:m") var capture_near := 0.05:
	set(value):
		capture_near = maxf(value, 0.001) if is_finite(value) else 0.05
		_settings.capture.near = capture_near
		_mark_stale()
		update_configuration_warnings()
## What is farther than this along the axes is not captured, in metres.
@export_range(0.01, 4000.0, 0.01, "or_greater", "suffix:m") var capture_far := 1000.0:
	set(value):
		capture_far = maxf(value, 0.01) if is_finite(value) else 1000.0
		_settings.capture.far = capture_far
		_mark_stale()
		update_configuration_warnings()

@export_group("Cost")
## Whether updates are measured. It costs a few queries of the GPU's clock per update, and updates
## that nothing follows are drawn again in a few frames, until the clock has answered.
@export var measure_cost := false:
	set(value):
		measure_cost = value
		_settings.measure_cost = value
		_mark_stale()
## Milliseconds of the GPU for an update, some frames late, without the copies into the cube map;
## 0 if it is not measured. An update that is spread over frames takes it in all.
@export var update_gpu_time: float:
	get:
		if not measure_cost:
			return 0.0
		return _chain.get_gpu_time() if _chain != null else _gpu_time
## Milliseconds of the processor for handing the last update to the cube map. In Compatibility it
## contains the wait for the GPU.
@export var update_cpu_time: float:
	get:
		return _cpu_time
## Frames that the last update was drawn in.
@export var update_frames: int:
	get:
		return _frames

var _arrival := 0
var _light: LobeLight
var _error := ""
# Whether the light is older than the properties.
var _stale := true
var _settings := LightSettings.new()
var _source := EnvironmentSource.new(_settings)
var _chain: PyramidChain
# Of the update under way: whether there is one, which slice comes next, and whether it is drawn.
var _running := false
var _slice := _WHOLE
var _drawn := false
var _idle := 0
var _waits: Array[FrameWait] = []
var _is_watching := false
# Captures that are still to follow, and whether materials have shown no light but the node's
# captures since these began without any; whether they show none at the moment.
var _echoes := 0
var _lit_by_itself := false
var _in_the_dark := false
# Whether the node lights its world, and from what its light was made.
var _active := false
var _light_kind := EnvironmentSource.Kind.NONE
# Whether it has been told what the light lacks, and when, in milliseconds, it is to be.
var _is_told := false
var _tell_time := 0
# What the last update cost.
var _gpu_time := 0.0
var _cpu_time := 0.0
var _frames := 0


func _init() -> void:
	set_notify_transform(true)
	_settings.node = self
	_settings.on_panorama_changed = _on_panorama_changed
	_watch_frames()


func _notification(what: int) -> void:
	match what:
		NOTIFICATION_ENTER_WORLD:
			_arrivals += 1
			_arrival = _arrivals
			add_to_group(_GROUP)
			_update_placement()
			_check_in()
			if is_visible_in_tree() and not is_active():
				push_warning(
					"LobeEnvironment3D: %s waits, another one lights its world." % get_path()
				)
		NOTIFICATION_EXIT_WORLD:
			remove_from_group(_GROUP)
			LightRegistry.withdraw(get_instance_id())
			_leave_world()
			for other in _get_others():
				other._check_in.call_deferred()
		NOTIFICATION_VISIBILITY_CHANGED:
			_check_in()
			for other in _get_others():
				other._check_in()
		NOTIFICATION_TRANSFORM_CHANGED:
			_update_placement()
			if source == Source.CAPTURE and update_mode == UpdateMode.WHEN_CHANGED:
				_mark_stale()
		NOTIFICATION_PREDELETE:
			LightRegistry.withdraw(get_instance_id())
			_running = false
			_light = null
			for wait: FrameWait in _waits.duplicate():
				wait.go_on()


func _validate_property(property: Dictionary) -> void:
	if property.name in ["update_gpu_time", "update_cpu_time", "update_frames"]:
		property.usage = PROPERTY_USAGE_EDITOR | PROPERTY_USAGE_READ_ONLY
	elif property.name.begins_with("capture_") and source != Source.CAPTURE:
		property.usage &= ~PROPERTY_USAGE_EDITOR


# The engine asks in the editor only; what answers is in no export.
func _get_configuration_warnings() -> PackedStringArray:
	const WARNINGS := "res://addons/lobelight/runtime/warnings/environment_warnings.gd"
	if not ResourceLoader.exists(WARNINGS):
		return []
	return load(WARNINGS).of(self, get_tree().edited_scene_root if is_inside_tree() else null)


## Whether the node is the one that lights its world.
func is_active() -> bool:
	if not is_inside_tree() or not is_visible_in_tree():
		return false
	for other in _get_others():
		if other.is_visible_in_tree() and other._arrival < _arrival:
			return false
	return true


## The pyramid as six half-float faces with mip levels; [code]null[/code] until it has been made.
## It is a [Cubemap] in Compatibility, otherwise a [TextureCubemapRD].
func get_cubemap() -> TextureLayered:
	return _light.cubemap if _light != null else null


## The light as materials take it, see [member LobeMaterial3D.light]; [code]null[/code] until it has
## been made. It goes on with the node's updates.
func get_light() -> LobeLight:
	return _light


## Frames in which [constant TIME_SLICED] makes the pyramid anew: 8 with views of a sky or a scene,
## 2 with a panorama; 6 more in Compatibility. 0 until the first update.
func get_sliced_frames() -> int:
	return _chain.get_slices() if _chain != null else 0


## Why the last [method rebuild] made no pyramid, in a sentence; empty if it did.
func get_rebuild_error() -> String:
	return _error


## Makes the pyramid anew, in one frame; three captures more follow that of a scene, see
## [constant CAPTURE]. Changing a property does so by itself; call it when the contents of textures
## have changed. It takes until the end of a frame: [code]await
## environment.rebuild()[/code] gives false if it could not be done, with the reason in
## [method get_rebuild_error].
func rebuild() -> bool:
	if not _begin(_WHOLE):
		return false
	return await _wait()


# Until the update has ended. A later call may start it anew; its result is this one's too. What is
# awaited is not the node's own, so that the caller may free the node then.
func _wait() -> bool:
	var wait := FrameWait.new()
	_waits.append(wait)
	while _running:
		if FrameWait.is_rendering_paused():
			_mark_stale()
			_stop("Rendering is paused, so nothing is drawn.")
			break
		await wait.went_on
	_waits.erase(wait)
	return _light != null and _error.is_empty()


# Ends an update under way without a light of its own.
func _stop(why: String) -> void:
	if _running:
		_running = false
		_error = why
		rebuild_finished.emit()


func _mark_stale() -> void:
	_stale = true
	_watch_frames()


# Servers load scenes without a renderer and need no light.
func _watch_frames() -> void:
	if not _is_watching and Pyramid.has_renderer():
		_is_watching = true
		RenderingServer.frame_pre_draw.connect(_on_frame_pre_draw)
		RenderingServer.frame_post_draw.connect(_on_frame_post_draw)


# While nothing can change but by what calls the node, nothing is called in each frame.
func _rest_if_settled() -> void:
	if _running or _chain != null or _active and (_stale or _echoes > 0):
		return
	var is_still := update_mode == UpdateMode.ONCE
	if update_mode == UpdateMode.WHEN_CHANGED and _light_kind == EnvironmentSource.Kind.PANORAMA:
		is_still = _settings.takes_panorama() and not LiveTextures.is_live(panorama)
	if is_still or not _active:
		_is_watching = false
		RenderingServer.frame_pre_draw.disconnect(_on_frame_pre_draw)
		RenderingServer.frame_post_draw.disconnect(_on_frame_post_draw)


func _on_panorama_changed() -> void:
	if update_mode != UpdateMode.ONCE:
		_mark_stale()
	update_configuration_warnings()


# All the frame's changes have been made by now.
func _on_frame_pre_draw() -> void:
	# Hidden nodes, and those that wait for another one to leave, make nothing.
	if _active and not _running:
		_start_if_due()
	if _running:
		if _chain != null:
			_chain.draw(_slice)
		_drawn = true
		_idle = 0
	elif _chain != null and not _chain.draw_for_clock():
		_idle += 1
		if _idle > _IDLE_FRAMES or update_mode == UpdateMode.ONCE and not measure_cost:
			_gpu_time = update_gpu_time
			_chain = null
	if _chain == null:
		_rest_if_settled()


func _start_if_due() -> void:
	if not _stale:
		# Without a light there is something in the way, which only a property can change.
		if _light == null:
			return
		if _echoes > 0:
			var changed := update_mode == UpdateMode.WHEN_CHANGED and _source.look()
			var echoes := _ECHOES if changed else _echoes - 1
			if _begin(_WHOLE):
				_echoes = echoes
			return
		if update_mode == UpdateMode.ONCE:
			return
		if _light_kind == EnvironmentSource.Kind.SKY_PANORAMA:
			_update_placement(true)
		_stale = _is_live() or _source.look()
		if not _stale:
			return
	if update_mode == UpdateMode.TIME_SLICED and _chain != null and _chain.awaits_clock():
		return
	var is_sliced := update_mode == UpdateMode.TIME_SLICED and _light != null
	_begin(0 if is_sliced else _WHOLE)


# Starts an update from its first slice, instead of one under way.
func _begin(slice: int) -> bool:
	_stale = false
	_running = false
	_error = _source.find_obstacle()
	var loss := _source.find_loss() if _error.is_empty() else ""
	if loss:
		_error = loss
	if _error:
		_chain = null
		_set_light(null)
		if loss:
			push_error("LobeEnvironment3D: " + loss)
		# A panorama that is not set yet is no reason to warn.
		elif panorama != null or source == Source.SKY or source == Source.CAPTURE:
			push_warning("LobeEnvironment3D: " + _error)
		return false
	_source.look()
	_chain = _source.make_chain(_chain)
	_slice = slice if _chain != null else _WHOLE
	_prepare_capture()
	_running = true
	_drawn = false
	_watch_frames()
	return true


# What materials show before the node's first capture is no light of the scene's, unless another
# environment has lit it until now: that one stays, so that nothing flashes.
func _prepare_capture() -> void:
	var captures := _source.get_kind() == EnvironmentSource.Kind.SCENE_VIEWS
	_echoes = _ECHOES if captures and not _is_live() else 0
	_lit_by_itself = _lit_by_itself and captures
	if captures and _active and not _lit_by_itself:
		_lit_by_itself = true
		_slice = _WHOLE
		if LightRegistry.is_lit_by_other(get_world_3d(), get_instance_id()):
			return
		_in_the_dark = true
		var is_even := Pyramid.is_round(filter as Pyramid.Filter)
		LightRegistry.offer(get_world_3d(), get_instance_id(), LobeLight.make_dark(is_even))


func _is_live() -> bool:
	return update_mode == UpdateMode.EVERY_FRAME or update_mode == UpdateMode.TIME_SLICED


func _on_frame_post_draw() -> void:
	if not _running or not _drawn:
		return
	_drawn = false
	if _chain != null and not _chain.receive(_slice):
		_running = false
		_chain = null
		_error = "The renderer did not draw the pyramid."
		push_warning("LobeEnvironment3D: " + _error)
		_set_light(null)
		return
	if _slice != _WHOLE:
		_slice += 1
		if _slice < _chain.get_slices():
			return
	_running = false
	_frames = 1 if _slice == _WHOLE else _slice
	_cpu_time = _chain.transfer_time if _chain != null else 0.0
	if _chain == null:
		_gpu_time = 0.0
	_light_kind = _source.get_kind()
	_lit_by_itself = _lit_by_itself and _active
	_set_light(_source.get_light(_chain))


func _set_light(light: LobeLight) -> void:
	var is_other := light != _light
	_light = light
	_lit_by_itself = _lit_by_itself and light != null
	_update_placement()
	# Without a light, nobody has to wait for it any longer.
	if is_other or _in_the_dark or light == null:
		_in_the_dark = false
		_check_in()
	if light != null and _light_kind == EnvironmentSource.Kind.EVEN:
		_tell_later()
	if light != null:
		rebuilt.emit()
	rebuild_finished.emit()


# In the editor, the scene tree says it.
func _tell_later() -> void:
	if _is_told or not is_inside_tree() or Engine.is_editor_hint():
		return
	if not get_tree().process_frame.is_connected(_tell):
		_tell_time = Time.get_ticks_msec() + _PATIENCE
		get_tree().process_frame.connect(_tell)


func _tell() -> void:
	if Time.get_ticks_msec() < _tell_time:
		return
	var tree := Engine.get_main_loop() as SceneTree
	tree.process_frame.disconnect(_tell)
	var shortage := _source.find_shortage() if is_inside_tree() and is_active() else ""
	_is_told = not shortage.is_empty()
	if shortage:
		push_warning("LobeEnvironment3D: %s: %s" % [get_path(), shortage])


# What has been drawn of another world's light is of no use.
func _leave_world() -> void:
	_active = false
	_lit_by_itself = false
	_in_the_dark = false
	if _light_kind == EnvironmentSource.Kind.PANORAMA and not _running:
		return
	if _source.leave_world():
		_mark_stale()
		_chain = null
		_stop("The node has left the world whose light it was taking.")


# Offers the light, or takes it back, as it is the node's turn or not.
func _check_in() -> void:
	if not is_inside_tree():
		return
	update_configuration_warnings()
	_active = is_active()
	if _active:
		_watch_frames()
	if _active and _light_kind == EnvironmentSource.Kind.SCENE_VIEWS and not _lit_by_itself:
		# It was captured in another's light.
		_mark_stale()
	if not _active or _light == null and not _in_the_dark:
		LightRegistry.withdraw(get_instance_id())
		# The old light stays until this one has been made.
		if _active and _stale and _source.find_obstacle().is_empty():
			LightRegistry.expect(get_world_3d(), get_instance_id())
		return
	if _in_the_dark:
		return
	LightRegistry.offer(get_world_3d(), get_instance_id(), _light, fade_time)


func _update_placement(is_drawing := false) -> void:
	if _light != null and _source.place(_light, _light_kind):
		LightRegistry.update_placement(_light, is_drawing)


# The other environments of the same world.
func _get_others() -> Array[LobeEnvironment3D]:
	var others: Array[LobeEnvironment3D] = []
	if not is_inside_tree():
		return others
	for node in get_tree().get_nodes_in_group(_GROUP):
		var other := node as LobeEnvironment3D
		if other != self and other.get_world_3d() == get_world_3d():
			others.append(other)
	return others
