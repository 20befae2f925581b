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
## [b]The first frame[/b] that shows a scene has the light, unless another light is shown until it
## has been made: a frame that nobody sees is drawn before it. Not so in the editor, with a
## rendering thread of its own, with a headset, with lights in several worlds, with filters that are
## not round, and with panoramas that are pictures of other viewports; there, materials show the
## neutral light in one frame.
## [br][br]
## [b]Cost.[/b] In Forward+ and Mobile, updates stay on the GPU and allocate nothing there. In
## Compatibility nothing can draw into a cube map, so the faces are read back, which waits for the
## GPU, one in each frame but for the first light, [method rebuild] and [constant EVERY_FRAME];
## meanwhile the engine takes memory for a face. The cube map stays; what draws it is given back 120
## frames after the last update, and is made anew for the next one. With software drivers, 256
## texels of a sky take about as long as a frame of 720p with eight lobes, and in Compatibility
## 1 ms of the processor besides ([code]./dev bench runtime[/code]); [member update_gpu_time] and
## [member update_cpu_time] tell for yours.
## [br][br]
## [b]Baked light.[/b] What does not change when the game runs can be filtered in the editor, by
## [i]Bake Light[/i] in the inspector, or by importing a panorama as [i]Light (Lobelight)[/i]:
## [member light] is shown from the first drawn frame on and costs no update.
## [br][br]
## There is to be one per [World3D]; a second one waits until the first has left. Hidden and waiting
## nodes make nothing. Each of up to four worlds shows its own light. When the node leaves, its
## light stays until that of the next one has been made; [member fade_time] has one fade into the
## other. [LobeProbe3D] has the light of rooms.

## The pyramid has been made anew and the materials have it. Of a baked [member light] it tells
## once, at the end of the frame in which the node has begun to show it.
signal rebuilt
## A rebuild has ended, with a pyramid or, as [method get_rebuild_error] says, without. It comes
## after [signal rebuilt], too.
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
	## take another mode, or call [method rebuild]. Moving the node counts, where it captures. What has
	## not changed for 120 frames is looked at in every sixth frame.
	WHEN_CHANGED,
	## In every frame.
	EVERY_FRAME,
	## All the time, spread over frames, see [method get_sliced_frames]. The light is replaced at the
	## end of each turn. The first one is drawn in one frame where no other light is shown meanwhile.
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

const LightRegistry := preload("light_registry.gd")
const LightSettings := preload("light_settings.gd")
const OnDemand := preload("../on_demand.gd")

## Texels along the side of a face: the least that can be asked for.
const MIN_SIZE := 4
## The most.
const MAX_SIZE := 2048

const _GROUP := &"_lobelight_environments"
const _LIVE := "res://addons/lobelight/runtime/live/live_light.gd"
# What says nothing of a baked light.
const _OF_UPDATES: Array[StringName] = [
	&"update_mode",
	&"update_interval",
	&"measure_cost",
	&"update_gpu_time",
	&"update_cpu_time",
	&"update_frames",
]

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
		_settings.update_mode = value as LightSettings.UpdateMode
		_mark_stale()
		notify_property_list_changed()
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
		_settings.filter = value
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
		size = 0 if value <= 0 else clampi(nearest_po2(value), MIN_SIZE, MAX_SIZE)
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

## How many compact bright lights, suns and lamps, are taken out of the light at most and drawn as
## what they are: sharp, without fireflies, and with light that half floats do not hold. Live light
## is drawn whole at first, and without them some frames later. Materials look none of them up where
## the light has none.
@export_range(0, 4) var max_sources := LightSettings.MAX_SOURCES:
	set(value):
		max_sources = clampi(value, 0, LightSettings.MAX_SOURCES)
		_settings.max_sources = max_sources
		_mark_stale()

## Seconds in which a new light takes the place of the one before, when this node becomes the one
## that lights its world, or its source changes; 0 changes it at once. While lights fade, materials
## draw both.
@export_range(0.0, 10.0, 0.05, "or_greater", "suffix:s") var fade_time := 0.0:
	set(value):
		fade_time = maxf(value, 0.0) if is_finite(value) else 0.0

## A light that was baked, see [LobeLight]. The node shows it instead of its source, from the first
## drawn frame on, and nothing is filtered when the game runs. That of a panorama is turned by the
## node's rotation; that of a sky or a capture stays as the world had it when it was baked, however
## the node is turned. The properties above and those of captures say what [i]Bake Light[/i] bakes.
## Without a light, or with one that is damaged, the node's light is live.
@export var light: LobeLight:
	set(value):
		if light == value:
			return
		if light != null:
			light.changed.disconnect(_show_baked)
		light = value
		if light != null:
			light.changed.connect(_show_baked)
		_show_baked()
		notify_property_list_changed()
		update_configuration_warnings()

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
## Whether [constant WHEN_CHANGED] draws the light of a change in slices, one a frame, as
## [constant TIME_SLICED] does: for skies that change slowly. The light is replaced when all have
## been drawn.
@export var spread_changes := false:
	set(value):
		spread_changes = value
		_settings.spread_changes = value
## Seconds between the updates that begin by themselves, at least: 0.1 for at most ten a second.
## What changes meanwhile is drawn then. Changes of the node's own properties do not wait.
@export_range(0.0, 10.0, 0.01, "or_greater", "suffix:s") var update_interval := 0.0:
	set(value):
		update_interval = maxf(value, 0.0) if is_finite(value) else 0.0
		_settings.update_interval = update_interval
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
		return _live.get_gpu_time() if _live != null else 0.0
## Milliseconds of the processor for handing the last update to the cube map. In Compatibility it
## contains the wait for the GPU.
@export var update_cpu_time: float:
	get:
		return _live.cpu_time if _live != null else 0.0
## Frames that the last update was drawn in.
@export var update_frames: int:
	get:
		return _live.frames if _live != null else 0

var _arrival := 0
var _settings := LightSettings.new()
# Draws the light. Made when the node first enters a world, or is asked for a light; null in exports
# that leave it out.
var _live: RefCounted
# Why there is none, in a sentence.
var _loss := ""
# What is shown in place of it: the baked light at this node's place; whether the signals have told.
var _baked: LobeLight
var _is_baked_told := false


func _init() -> void:
	set_notify_transform(true)
	_settings.node = self
	_settings.on_panorama_changed = _on_panorama_changed


func _notification(what: int) -> void:
	match what:
		NOTIFICATION_ENTER_WORLD:
			_arrivals += 1
			_arrival = _arrivals
			add_to_group(_GROUP)
			_load_live()
			_update_placement()
			_check_in()
			if is_visible_in_tree() and not is_active():
				push_warning(
					"LobeEnvironment3D: %s waits, another one lights its world." % get_path()
				)
		NOTIFICATION_EXIT_WORLD:
			remove_from_group(_GROUP)
			LightRegistry.withdraw(get_instance_id())
			_settings.is_active = false
			_is_baked_told = false
			if _live != null:
				_live.leave_world()
			for other in _get_others():
				other._check_in.call_deferred()
		NOTIFICATION_VISIBILITY_CHANGED:
			_check_in()
			for other in _get_others():
				other._check_in()
		NOTIFICATION_TRANSFORM_CHANGED:
			_update_placement()
			if _live != null:
				_live.follow_move()
		NOTIFICATION_PREDELETE:
			LightRegistry.withdraw(get_instance_id())
			if _live != null:
				_live.end()


func _validate_property(property: Dictionary) -> void:
	if property.name in ["update_gpu_time", "update_cpu_time", "update_frames"]:
		property.usage = PROPERTY_USAGE_EDITOR | PROPERTY_USAGE_READ_ONLY
	elif property.name.begins_with("capture_") and source != Source.CAPTURE:
		property.usage &= ~PROPERTY_USAGE_EDITOR
	elif property.name == "spread_changes" and update_mode != UpdateMode.WHEN_CHANGED:
		property.usage &= ~PROPERTY_USAGE_EDITOR
	elif property.name == "update_interval" and update_mode == UpdateMode.ONCE:
		property.usage &= ~PROPERTY_USAGE_EDITOR
	if _baked != null and property.name in _OF_UPDATES:
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


## The pyramid as six faces with mip levels, half floats unless it was baked in another format;
## [code]null[/code] until it has been made. It is a [Cubemap] if it was baked and in Compatibility,
## otherwise a [TextureCubemapRD].
func get_cubemap() -> TextureLayered:
	var shown := get_light()
	return shown.cubemap if shown != null else null


## The light as materials take it, see [member LobeMaterial3D.light]; [code]null[/code] until it has
## been made. It goes on with the node's updates.
func get_light() -> LobeLight:
	if _baked != null:
		return _baked
	return _live.light if _live != null else null


## Frames in which [constant TIME_SLICED] makes the pyramid anew: one for each of six views of a sky
## or a scene, two or more for the levels, and in Compatibility one for each face that is read back.
## The project setting [code]lobelight/environments/budget_ms[/code], 2 ms by default, says how long
## the GPU may take for the levels in a frame: as long as nothing has been measured, a slow phone is
## assumed, and slower GPUs take longer. With 0 the levels take two frames. The views take what the
## scene takes. 0 until the first update.
func get_sliced_frames() -> int:
	return _live.get_slices() if _live != null else 0


## Why the last [method rebuild] made no pyramid, in a sentence; empty if it did.
func get_rebuild_error() -> String:
	return _live.error if _live != null else _loss


## Makes the pyramid anew, in one frame in every mode and renderer; three captures more follow that
## of a scene, see [constant CAPTURE]. Changing a property does so by itself; call it when the
## contents of textures have changed. It takes until the end of a frame: [code]await
## environment.rebuild()[/code] gives false if it could not be done, with the reason in
## [method get_rebuild_error]. A baked [member light] is there at once, and stays as it is.
func rebuild() -> bool:
	_load_live()
	if _baked != null:
		return true
	if _live == null:
		return false
	return await _live.rebuild()


# What draws the light, unless it is baked. Exports may have left it out.
func _load_live() -> void:
	if _live != null or _baked != null:
		return
	_loss = OnDemand.find_loss(_LIVE, OnDemand.LIVE)
	# A light that is damaged has been told of by now.
	if _loss.is_empty() or light == null:
		var script := OnDemand.fetch(_LIVE, OnDemand.LIVE) as GDScript
		_live = script.new(_settings, _on_drawn) if script != null else null


func _show_baked() -> void:
	_baked = null
	_is_baked_told = false
	var problem := light.get_problem() if light != null else ""
	if problem:
		push_error(
			(
				"LobeEnvironment3D: %s: %s"
				% [light.resource_path if light.resource_path else "Light", problem]
			)
		)
	elif light != null:
		_baked = light.at_another_place()
		_loss = ""
		if _live != null:
			_live.end()
			_live = null
	if _baked == null and is_inside_tree():
		_load_live()
	_update_placement()
	_check_in()


# For those who wait for the light without knowing that it is baked.
func _tell_of_baked() -> void:
	if _baked != null:
		rebuilt.emit()
		rebuild_finished.emit()


func _mark_stale() -> void:
	if _live != null:
		_live.mark_stale()


func _on_panorama_changed() -> void:
	if update_mode != UpdateMode.ONCE and _live != null:
		_live.follow_change()
	update_configuration_warnings()


# An update has ended, with another light than before or not.
func _on_drawn(is_other: bool) -> void:
	_update_placement()
	if is_other:
		_check_in()
		LightRegistry.follow_sources(get_light())
	if _live != null and _live.light != null:
		rebuilt.emit()
	rebuild_finished.emit()


# Offers the light, or takes it back, as it is the node's turn or not.
func _check_in() -> void:
	if not is_inside_tree():
		return
	update_configuration_warnings()
	_settings.is_active = is_active()
	if _live != null:
		_live.follow_activity()
		# What is dark for the first capture's sake stays so.
		if _settings.is_active and _live.is_in_the_dark:
			return
	var shown := get_light()
	if _settings.is_active and shown != null:
		LightRegistry.offer(get_world_3d(), get_instance_id(), shown, fade_time)
		if _baked != null and not _is_baked_told:
			_is_baked_told = true
			_tell_of_baked.call_deferred()
		return
	LightRegistry.withdraw(get_instance_id())
	# The old light stays until this one has been made.
	if _settings.is_active and _live != null and _live.is_awaited():
		LightRegistry.expect(get_world_3d(), get_instance_id())


func _update_placement() -> void:
	if _baked != null:
		_baked.place(global_basis if is_inside_tree() else basis, energy)
		LightRegistry.update_placement(_baked)
	elif _live != null and _live.place():
		LightRegistry.update_placement(_live.light)


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
