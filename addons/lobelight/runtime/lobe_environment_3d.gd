@tool
@icon("../icons/lobe_environment_3d.svg")
class_name LobeEnvironment3D
extends Node3D
## Where the light of [LobeMaterial3D]s comes from.
##
## The node filters a panorama into a pyramid and hands it to all [LobeMaterial3D]s, which are lit
## by it from the next frame on. Its rotation turns the light; its position and scale do not
## matter. A hidden node gives no light.
## [br][br]
## There is to be one per [World3D]; a second one waits until the first has left. Materials do not
## know worlds: with several worlds, all are lit by the environment that came last.

## The pyramid has been made anew and the materials have it.
signal rebuilt
## A rebuild has ended, with a pyramid or, as [method get_rebuild_error] says, without.
signal rebuild_finished

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

const EnvironmentLight := preload("environment_light.gd")
const LightRegistry := preload("light_registry.gd")
const Pyramid := preload("pyramid.gd")

const _GROUP := &"_lobelight_environments"

# Counts the environments that have come, so that the first of a world can be told.
static var _arrivals := 0

## The surroundings, in the same projection as [PanoramaSkyMaterial]: +z in the middle, −z at the
## left and right edges. Linear light up to 65504; negative values and NaN count as dark. Formats
## of 8 bits are taken for sRGB.
@export var panorama: Texture2D:
	set(value):
		if panorama == value:
			return
		if panorama != null:
			panorama.changed.disconnect(_queue_rebuild)
		panorama = value
		if panorama != null:
			panorama.changed.connect(_queue_rebuild)
		_queue_rebuild()
		update_configuration_warnings()
## How the pyramid's levels are made.
@export var filter := Filter.DISC:
	set(value):
		filter = value
		_queue_rebuild()
## Texels along the side of the cube map's faces. Automatic is half the panorama's width, rounded up
## to a power of two, at most 512. Other values are rounded to a power of two.
@export_enum(
	"Automatic:0", "32:32", "64:64", "128:128", "256:256", "512:512", "1024:1024", "2048:2048"
)
var size := 0:
	set(value):
		size = 0 if value <= 0 else clampi(nearest_po2(value), Pyramid.MIN_SIZE, Pyramid.MAX_SIZE)
		_queue_rebuild()
## A factor for the light.
@export_range(0.0, 16.0, 0.01, "or_greater") var energy := 1.0:
	set(value):
		energy = value if is_finite(value) and value > 0.0 else 0.0
		_update_placement()

var _arrival := 0
var _light: EnvironmentLight
var _error := ""
# Whether the light is older than the properties.
var _stale := true
var _queued := false
# What is being drawn. Not a variable of rebuild(), which would keep it for ever if the node were
# freed meanwhile.
var _pyramid: Pyramid
# Counts rebuilds, so that one that has been overtaken can tell.
var _generation := 0


func _init() -> void:
	set_notify_transform(true)


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
			if _stale:
				_queue_rebuild()
		NOTIFICATION_EXIT_WORLD:
			remove_from_group(_GROUP)
			LightRegistry.withdraw(get_instance_id())
			for other in _get_others():
				other._check_in.call_deferred()
		NOTIFICATION_VISIBILITY_CHANGED:
			_check_in()
			for other in _get_others():
				other._check_in()
		NOTIFICATION_TRANSFORM_CHANGED:
			_update_placement()
		NOTIFICATION_PREDELETE:
			LightRegistry.withdraw(get_instance_id())


func _get_configuration_warnings() -> PackedStringArray:
	var warnings: PackedStringArray = []
	if panorama == null:
		warnings.append("Set a panorama; until then LobeMaterial3Ds show a neutral map.")
	if is_inside_tree() and not is_active() and is_visible_in_tree():
		warnings.append("Another LobeEnvironment3D lights this world; this one waits for it to go.")
	return warnings


## Whether the node is the one that lights its world.
func is_active() -> bool:
	if not is_inside_tree() or not is_visible_in_tree():
		return false
	for other in _get_others():
		if other.is_visible_in_tree() and other._arrival < _arrival:
			return false
	return true


## The pyramid as six half-float faces with mip levels; [code]null[/code] until it has been made.
func get_cubemap() -> Cubemap:
	return _light.cubemap if _light != null else null


## Why the last [method rebuild] made no pyramid, in a sentence; empty if it did.
func get_rebuild_error() -> String:
	return _error


## Makes the pyramid anew. Changing a property does so by itself; call it when the panorama's
## contents have changed. It takes until the end of a frame: [code]await
## environment.rebuild()[/code] gives false if it could not be done, with the reason in
## [method get_rebuild_error].
func rebuild() -> bool:
	_queued = false
	_stale = false
	_generation += 1
	var generation := _generation
	_pyramid = null
	_error = _find_obstacle()
	if _error:
		if panorama != null:
			push_warning("LobeEnvironment3D: " + _error)
		_set_light(null)
		return false

	_pyramid = Pyramid.new()
	var face_size := size if size > 0 else Pyramid.automatic_size(panorama)
	var used_filter := filter as Pyramid.Filter
	_pyramid.start(panorama, face_size, used_filter)
	await RenderingServer.frame_post_draw
	if generation != _generation:
		# A later call is at it, or has been; its result is this one's too.
		while _pyramid != null:
			await rebuild_finished
		return _light != null
	var faces := _pyramid.finish()
	_pyramid = null
	if faces.is_empty():
		_error = "The renderer did not draw the pyramid."
		push_warning("LobeEnvironment3D: " + _error)
		_set_light(null)
		return false

	var light := EnvironmentLight.new()
	light.cubemap = Cubemap.new()
	light.cubemap.create_from_images(faces)
	light.size = face_size
	light.level_variance = Pyramid.LEVEL_VARIANCES[used_filter]
	light.is_even = Pyramid.is_round(used_filter)
	_set_light(light)
	return true


func _find_obstacle() -> String:
	if panorama == null:
		return "There is no panorama."
	if not Pyramid.has_renderer():
		return "There is no renderer to make the pyramid with: the engine runs headless."
	if panorama.get_width() < 1 or panorama.get_height() < 1:
		return "The panorama is empty."
	return ""


func _set_light(light: EnvironmentLight) -> void:
	_light = light
	_update_placement()
	_check_in()
	if light != null:
		rebuilt.emit()
	rebuild_finished.emit()


# Several changed properties make one rebuild.
func _queue_rebuild() -> void:
	_stale = true
	if _queued or not is_inside_tree():
		return
	_queued = true
	_rebuild_queued.call_deferred()


func _rebuild_queued() -> void:
	# A call of rebuild() may have come before.
	if not _queued:
		return
	_queued = false
	# Servers load scenes without a renderer and need no light.
	if is_inside_tree() and (Pyramid.has_renderer() or panorama == null):
		rebuild()


# Offers the light, or takes it back, as it is the node's turn or not.
func _check_in() -> void:
	if not is_inside_tree():
		return
	update_configuration_warnings()
	if _light != null and is_active():
		LightRegistry.offer(get_instance_id(), _light)
	else:
		LightRegistry.withdraw(get_instance_id())


func _update_placement() -> void:
	if _light == null:
		return
	_light.energy = energy
	if is_inside_tree():
		_light.rotation = global_basis.orthonormalized()
	LightRegistry.update_placement(get_instance_id())


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
