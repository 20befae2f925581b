class_name ComparisonStage
extends RefCounted
## What the methods of one comparison share: the scene tree, the surroundings in the forms that the
## methods need, and the options of the command.

const PanoramaFilter := preload("res://addons/lobelight/editor/light/panorama_filter.gd")
const Pyramid := preload("res://addons/lobelight/runtime/pyramid/pyramid.gd")
const DualParaboloidMap := preload("dual_paraboloid_map.gd")
const PrefilteredMap := preload("prefiltered_map.gd")
const RoomProbe := preload("room_probe.gd")
const FILTERS: Dictionary[String, LobeEnvironment3D.Filter] = {
	"box": LobeEnvironment3D.Filter.BOX,
	"binomial": LobeEnvironment3D.Filter.BINOMIAL,
	"gaussian": LobeEnvironment3D.Filter.GAUSSIAN,
	"disc": LobeEnvironment3D.Filter.DISC,
}

## The best kernels and samplers there are; the chapter of 2007; kernels of the density's integral
## for GGX too. See the method.
const FIS_FORMS: PackedStringArray = ["best", "published", "integral"]
const LARGEST_HALF := 65504.0
## How the project's own light is made: on the GPU while the program runs, or as it is saved.
const LIGHTS: PackedStringArray = ["live", "baked"]

const _MEASURED_UPDATES := 3
# The times of the GPU come some frames late.
const _FRAMES_LATE := 4
# Frames in which sources are taken out of a live light after its first update, and some more.
const _SOURCE_FRAMES := 24

var tree: SceneTree
## What lights the sphere; null in a room.
var panorama: Texture2D
## The room that the sphere is in, whose light is captured at its probe; null under a panorama.
var room: CompareRoom
## A key of [constant FILTERS]: how the project's own pyramid is made.
var filter := "disc"
## One of [constant LIGHTS].
var light_form := "live"
## Suns and lamps that are taken out of the project's own light, at most.
var max_sources := 4
## Texels along the side of the faces of the pyramids; 0 for what [LobeEnvironment3D] chooses.
var pyramid_size := 0
## Of gmm: the views of its table, elevations and azimuths; 0 for what [LobeBaker] chooses.
var table_views := Vector2i.ZERO
## Tables that were baked, by their recipes; several comparisons can share them.
var tables: Dictionary[String, LobeTable] = {}
## Of toral: the share c of a lobe that the texels of its level cover (the thesis' alpha). 0.47, or
## 1 - exp(-2 / pi), makes their variance the lobe's.
var toral_coverage := 0.47
## Of toral: the views that are fitted, elevations and azimuths; 0 for the method's own choice.
var toral_views := Vector2i.ZERO
## Of fis: added to the level. The chapter of 2007 adds nothing; Křivánek and Colbert 2008,
## "Real-time Shading with Filtered Importance Sampling", take four times the solid angle, which
## is 1.
var fis_bias := 0.0
## Of fis: which publications it follows, one of [constant FIS_FORMS].
var fis_form := "best"

## What the project's own light is multiplied by before it is drawn, so that pictures, which have
## half floats, hold what a map above 65504 reflects; known after [method light_materials].
var energy := 1.0

var _environment: LobeEnvironment3D
# Worlds with the room's walls, one for each capture.
var _room_worlds: Array[SubViewport] = []
var _room_probe: RoomProbe
var _lights: Dictionary[String, LobeLight] = {}
var _prefiltered: Dictionary[String, PrefilteredMap] = {}
var _update_costs: Dictionary[String, Dictionary] = {}
var _map: DualParaboloidMap


func _init(scene_tree: SceneTree) -> void:
	tree = scene_tree


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE and is_instance_valid(_environment):
		_environment.free()
	if what == NOTIFICATION_PREDELETE:
		for world in _room_worlds:
			if is_instance_valid(world):
				world.free()


## The table of a recipe of [LobeBaker], baked for the method [param title] unless [member tables]
## has it: {"table"} or {"error"}. To be awaited.
func bake(recipe: Dictionary, title: String) -> Dictionary:
	var key := str(recipe)
	if not tables.has(key):
		var result := await ResultCache.run(&"LobeBaker", recipe, "baking %s" % title, tree)
		if result.has("error"):
			return result
		tables[key] = LobeTable.from_baked(result)
	return {"table": tables[key]}


## Lights every [LobeMaterial3D] by the panorama. Returns one sentence on failure, otherwise empty.
## To be awaited.
func light_materials() -> String:
	if _environment == null:
		_environment = _make_environment(filter)
		_environment.max_sources = max_sources
		if room == null:
			energy = _find_energy()
			_environment.energy = energy
		if light_form == "baked":
			var failure := await _bake_light()
			if failure:
				return failure
		if room == null:
			tree.root.add_child(_environment)
	if _environment.get_cubemap() != null:
		return ""
	if not await _environment.rebuild():
		return _environment.get_rebuild_error()
	if max_sources > 0 and light_form != "baked":
		# Suns and lamps are taken out some frames later.
		for frame in _SOURCE_FRAMES:
			await RenderingServer.frame_post_draw
	return ""


# A power of two that brings the brightest texel below what half floats hold.
func _find_energy() -> float:
	var image := panorama.get_image()
	if image == null or image.get_format() != Image.FORMAT_RGBF:
		return 1.0
	var values := image.get_data().to_float32_array()
	values.sort()
	return pow(2.0, -maxf(ceilf(log(values[-1] / LARGEST_HALF) / log(2.0)), 0.0))


# The environment's light as its import makes it, in half floats. Returns one sentence on failure.
func _bake_light() -> String:
	var kernel := FILTERS[filter] as Pyramid.Filter
	if not Pyramid.is_round(kernel):
		return "--light baked takes the filters disc and gaussian."
	var request := PanoramaFilter.make_request(panorama.get_image(), pyramid_size, kernel)
	request["max_sources"] = max_sources
	var worker := NativeLibrary.create(&"LobeLightFilter")
	var result := await NativeLibrary.run(worker, request, "filtering the light", tree)
	if result.has("error"):
		return result["error"]
	_environment.light = PanoramaFilter.make_light(request, result)
	return ""


## The light of [member room] as a [LobeProbe3D] has it: {"probe"} or {"error"}. To be awaited.
func room_probe() -> Dictionary:
	if _room_probe == null:
		var made := RoomProbe.new(room, tree)
		var failure := await made.capture()
		if not failure.is_empty():
			return {"error": failure}
		_room_probe = made
	return {"probe": _room_probe}


## What a changing environment costs: an update of the pyramid made with the filter
## [param used_filter]. {"prefilter_ms"}, milliseconds of the GPU, 0 where the driver gives none;
## in Compatibility, where the engine has no times of it, {"prefilter_wall_ms"}, the median of what
## whole updates take, which end with reading back and so wait for the GPU. To be awaited.
func update_cost(used_filter: String) -> Dictionary:
	if _update_costs.has(used_filter):
		return _update_costs[used_filter]
	if light_form == "baked" or not (await light_materials()).is_empty():
		return {}
	_environment.filter = FILTERS[used_filter]
	_update_costs[used_filter] = (
		{"prefilter_wall_ms": await _update_wall_time()}
		if LinearViewport.is_compatibility()
		else {"prefilter_ms": await _update_gpu_time()}
	)
	_environment.filter = FILTERS[filter]
	await _environment.rebuild()
	return _update_costs[used_filter]


## Texels along the side of the faces that light materials; 0 before [method light_materials].
func face_size() -> int:
	var cubemap := _environment.get_cubemap() if _environment != null else null
	return cubemap.get_width() if cubemap != null else 0


## The panorama's pyramid as materials of other kinds need it, made as [LobeEnvironment3D] makes
## it; null on failure. [param used_filter] is a key of [constant FILTERS]. To be awaited.
func light(used_filter: String) -> LobeLight:
	if _lights.has(used_filter):
		return _lights[used_filter]
	# The one that lights materials has it already, unless its suns and lamps have been taken out.
	var is_shared := used_filter == filter and face_size() > 0
	is_shared = is_shared and _environment.get_light().sources == null
	var environment := _environment if is_shared else _make_environment(used_filter)
	var made: LobeLight = null
	if is_shared or await environment.rebuild():
		made = _light_of(environment, FILTERS[used_filter] as Pyramid.Filter)
		_lights[used_filter] = made
	if not is_shared:
		environment.free()
	return made


## The panorama filtered for a BRDF of these widths, made once for equal arguments; null on failure.
## To be awaited.
func prefiltered_map(brdf: String, widths: PackedFloat64Array, size: int) -> PrefilteredMap:
	var key := str([brdf, widths, size])
	if not _prefiltered.has(key):
		var source := await light("box")
		if source == null:
			return null
		_prefiltered[key] = await PrefilteredMap.make(source, brdf, widths, size, tree)
	return _prefiltered[key]


## The panorama as a dual-paraboloid map, whose halves have about the texels of three faces of the
## cube; null on failure. To be awaited.
func dual_paraboloid_map() -> DualParaboloidMap:
	if _map == null:
		var side := 2 * Pyramid.automatic_size(panorama)
		_map = await DualParaboloidMap.make(panorama, side, tree)
	return _map


func _update_gpu_time() -> float:
	_environment.measure_cost = true
	_environment.update_mode = LobeEnvironment3D.UpdateMode.EVERY_FRAME
	for frame in _MEASURED_UPDATES:
		await RenderingServer.frame_post_draw
	_environment.update_mode = LobeEnvironment3D.UpdateMode.ONCE
	for frame in _FRAMES_LATE:
		await RenderingServer.frame_post_draw
	var time := _environment.update_gpu_time
	_environment.measure_cost = false
	_environment.update_mode = LobeEnvironment3D.UpdateMode.WHEN_CHANGED
	return time


func _update_wall_time() -> float:
	# The first compiles shaders.
	await _environment.rebuild()
	var times := PackedFloat32Array()
	for update in _MEASURED_UPDATES:
		var started := Time.get_ticks_usec()
		await _environment.rebuild()
		times.append(0.001 * (Time.get_ticks_usec() - started))
	return LinearViewport.median(times)


func _make_environment(used_filter: String) -> LobeEnvironment3D:
	var environment := LobeEnvironment3D.new()
	environment.filter = FILTERS[used_filter]
	environment.size = pyramid_size
	environment.panorama = panorama
	environment.max_sources = 0
	if room != null:
		environment.source = LobeEnvironment3D.Source.CAPTURE
		environment.position = room.probe
		environment.capture_cull_mask = CompareRoom.WALL_LAYER
		environment.capture_far = 2.0 * room.size.length()
		_enter_room(environment)
	return environment


func _enter_room(environment: LobeEnvironment3D) -> void:
	var world := room.make_world()
	world.add_child(environment)
	tree.root.add_child(world)
	_room_worlds.append(world)


static func _light_of(environment: LobeEnvironment3D, kind: Pyramid.Filter) -> LobeLight:
	var made := LobeLight.new()
	made.cubemap = environment.get_cubemap()
	made.size = made.cubemap.get_width()
	made.level_variance = Pyramid.LEVEL_VARIANCES[kind]
	# Captures are as sharp as they were drawn.
	if environment.panorama != null:
		made.base_variance = Pyramid.base_variance(environment.panorama, made.size, kind)
	made.is_even = Pyramid.is_round(kind)
	return made
