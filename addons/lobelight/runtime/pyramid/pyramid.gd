@tool
extends RefCounted
## Draws the levels of an environment's pyramid on the GPU, in any renderer.
##
## Each level is an atlas of the six faces, drawn from the finer one. Level 0 is drawn from a
## panorama or from six views. The viewports stay, and drawing again allocates nothing.

## How a level is made from the finer one.
enum Filter { BOX, BINOMIAL, GAUSSIAN, DISC }

const CanvasPass := preload("canvas_pass.gd")
const OnDemand := preload("../on_demand.gd")

const PanoramaShader := preload("../shaders/pyramid_panorama.gdshader")
const RoundShader := preload("../shaders/pyramid_round.gdshader")
const _VIEWS_SHADER := "res://addons/lobelight/runtime/skies/pyramid_views.gdshader"
const _REDUCE_SHADER := "res://addons/lobelight/runtime/filters/pyramid_reduce.gdshader"

## By filter, a third of the variance that a level's kernel has per axis, in solid angles of the
## finer level's texels: c in shaders/environment.gdshaderinc.
const LEVEL_VARIANCES: Array[float] = [1.0 / 12.0, 1.0 / 4.0, 5.0 / 6.0, 5.0 / 6.0]
## Of the coarsest levels, by the texels along the side of a face: what discs they are blurred with,
## by both round filters, as (kernel_variance, shrinking_variance, disc_slope) of
## shaders/pyramid_round.gdshader. They are those with which light of many kinds, looked up between
## texels and mixed between levels, comes closest to that light under a Gaussian of the variance
## that is asked for (least squares over spherical harmonics to degree 10 and over all variances).
const COARSE_DISCS: Dictionary[int, Vector3] = {
	8: Vector3(3.5345, 0.3712, -0.6316),
	4: Vector3(4.3997, 0.4158, -0.9311),
	2: Vector3(2.3639, 0.4549, 0.0),
	1: Vector3(0.7939, 0.0, 0.0),
}
## Texels along the side of a face: the least and the most that can be asked for.
const MIN_SIZE := 4
const MAX_SIZE := 2048
## The most that is chosen automatically.
const MAX_AUTOMATIC_SIZE := 512
## The atlas of the faces.
const COLUMNS := 3
const ROWS := 2
## Formats that hold linear light; the others hold sRGB.
const LINEAR_FORMATS: Array[Image.Format] = [
	Image.FORMAT_RF,
	Image.FORMAT_RGF,
	Image.FORMAT_RGBF,
	Image.FORMAT_RGBAF,
	Image.FORMAT_RH,
	Image.FORMAT_RGH,
	Image.FORMAT_RGBH,
	Image.FORMAT_RGBAH,
	Image.FORMAT_RGBE9995,
	Image.FORMAT_BPTC_RGBF,
	Image.FORMAT_BPTC_RGBFU,
	Image.FORMAT_ASTC_4x4_HDR,
	Image.FORMAT_ASTC_8x8_HDR,
]
const _MAX_SAMPLES := 8
# Between levels that blur by four times the variance of one another, and sharpness.
const _BASE_SHARE := 0.5
# The variance of the tent by which levels are looked up, in texels.
const _TENT_VARIANCE := 1.0 / 6.0
# What finding a texel's place costs, in fetches, and by filter what lies under the kernels: discs
# have radii of 3.6 texels of the finer level, Gaussians end at 4.9.
const _PLACE_FETCHES := 6.0
const _LEVEL_FETCHES: Array[float] = [4.0, 16.0, 75.0, 45.0]

var size := 0
var filter := Filter.DISC
## What level 0 is blurred by: b in shaders/environment.gdshaderinc.
var level_0_variance := 0.0
## The passes, the finest level first.
var levels: Array[CanvasPass] = []

# Of level 0: its material, and what shader draws it where nothing is taken out.
var _source_material: RID
var _source_shader: Shader
# Of a texel, by level.
var _fetches: Array[float] = []
# Keeps it on the GPU until it has been drawn.
var _panorama: Texture2D


## Whether there is anything to draw with; false with [code]--headless[/code].
static func has_renderer() -> bool:
	return DisplayServer.get_name() != "headless"


## Whether a filter blurs alike along all directions, and all over the sphere.
static func is_round(filter: Filter) -> bool:
	return filter == Filter.GAUSSIAN or filter == Filter.DISC


## Why levels cannot be made by a filter in this export; empty if they can.
static func find_loss(used_filter: Filter) -> String:
	return "" if is_round(used_filter) else OnDemand.find_loss(_REDUCE_SHADER, OnDemand.FILTERS)


## Whether a panorama holds linear light; sRGB otherwise.
static func is_linear(panorama: Texture2D) -> bool:
	return RenderingServer.texture_get_format(panorama.get_rid()) in LINEAR_FORMATS


## The size chosen for a panorama where none is asked for: its width up to a power of two. That is
## four texels along one of the panorama's, so that the sharpest lobes, no wider than these, are
## looked up between blurred levels.
static func automatic_size(panorama: Texture2D) -> int:
	return automatic_size_of(panorama.get_width())


## The same for a panorama's width in texels.
static func automatic_size_of(width: int) -> int:
	return clampi(nearest_po2(width), MIN_SIZE, MAX_AUTOMATIC_SIZE)


## What level 0 is blurred by, as [constant LEVEL_VARIANCES]. Where the panorama's texels are no
## finer than two of the cube's, round filters blur it by less than one of them: level 1 would blur
## by twenty times the variance of a sharp level 0, and narrow lobes, which are looked up between
## the two, would suffer. Finer panoramas stay as sharp as the cube can show them.
static func base_variance(panorama: Texture2D, face_size: int, used_filter: Filter) -> float:
	return base_variance_of(panorama.get_width(), face_size, used_filter)


## The same for a panorama's width in texels.
static func base_variance_of(width: int, face_size: int, used_filter: Filter) -> float:
	if is_round(used_filter) and width <= 2 * face_size:
		return _BASE_SHARE * LEVEL_VARIANCES[used_filter]
	return 0.0


## Samples along the side of a texel of level 0, where that is not blurred.
static func count_samples(width: int, face_size: int) -> int:
	return clampi(ceili(width / (2.0 * face_size)), 1, _MAX_SAMPLES)


## Makes level 0 from a panorama; faces will have [param face_size] texels a side, a power of two.
## [param as_sky] puts its texels where the engine's sky has them, by approximate angles that are
## up to half a degree off.
func set_up_panorama(
	panorama: Texture2D, face_size: int, used_filter: Filter, as_sky := false
) -> void:
	_panorama = panorama
	level_0_variance = base_variance(panorama, face_size, used_filter)
	var parameters := describe_panorama(panorama, as_sky)
	parameters[&"face_size"] = face_size
	parameters[&"samples"] = count_samples(panorama.get_width(), face_size)
	parameters[&"kernel_variance"] = level_0_variance
	parameters[&"shrinking_variance"] = _TENT_VARIANCE
	_fetches = [_PLACE_FETCHES + _count_panorama_fetches(panorama.get_width(), face_size)]
	_set_up_levels(face_size, used_filter, PanoramaShader, parameters)


## The parameters of shaders/panorama.gdshaderinc.
static func describe_panorama(panorama: Texture2D, as_sky: bool) -> Dictionary[StringName, Variant]:
	return {
		&"panorama": panorama.get_rid(),
		&"panorama_is_srgb": not is_linear(panorama),
		&"panorama_as_sky": as_sky,
	}


## The parameters of shaders/views.gdshaderinc.
static func describe_views(views: Array[RID]) -> Dictionary[StringName, Variant]:
	var parameters: Dictionary[StringName, Variant] = {}
	for face in 6:
		parameters[StringName("view_%d" % face)] = views[face]
	return parameters


## From now on level 0 is drawn by another shader, which has more parameters than its own;
## [code]null[/code] for that one again.
func draw_level_0_by(shader: Shader, parameters: Dictionary[StringName, Variant] = {}) -> void:
	var used := shader if shader != null else _source_shader
	RenderingServer.material_set_shader(_source_material, used.get_rid())
	for name: StringName in parameters:
		RenderingServer.material_set_param(_source_material, name, parameters[name])


## Makes level 0 from six square views of [param samples] times [param face_size] pixels, textures
## of the rendering server as [code]six_views.gd[/code] draws them.
func set_up_views(views: Array[RID], samples: int, face_size: int, used_filter: Filter) -> void:
	var parameters := describe_views(views)
	parameters[&"face_size"] = face_size
	parameters[&"samples"] = samples
	_fetches = [_PLACE_FETCHES + samples * samples]
	var shader: Shader = OnDemand.fetch(_VIEWS_SHADER, OnDemand.SKIES)
	_set_up_levels(face_size, used_filter, shader, parameters)


## Has all levels drawn in the next frame.
func draw() -> void:
	for level in levels:
		level.draw()


## Has [param count] rows of a level from [param first] on drawn in the next frame.
func draw_rows(level: int, first: int, count: int) -> void:
	if count == count_rows(level):
		levels[level].draw()
	else:
		levels[level].draw_rows(first, count)


func count_rows(level: int) -> int:
	return ROWS * (size >> level)


## About the fetches that drawing a level takes.
func count_fetches(level: int) -> float:
	return _fetches[level] * COLUMNS * (size >> level) * count_rows(level)


func _set_up_levels(
	face_size: int, used_filter: Filter, source: Shader, parameters: Dictionary[StringName, Variant]
) -> void:
	size = face_size
	filter = used_filter
	_source_shader = source
	_source_material = _add_level(size, source, parameters)
	var level_size := size >> 1
	while level_size > 0:
		var level: Dictionary[StringName, Variant] = {
			&"finer": levels.back().get_texture(), &"face_size": level_size
		}
		if is_round(filter):
			var finer_is_blurred := levels.size() > 1 or level_0_variance > 0.0
			var kernel := Vector3(3.0 * LEVEL_VARIANCES[filter], 3.0 * _TENT_VARIANCE, 0.0)
			kernel = COARSE_DISCS.get(level_size, kernel)
			level[&"kernel_variance"] = kernel.x
			level[&"shrinking_variance"] = kernel.y + (0.0 if finer_is_blurred else _TENT_VARIANCE)
			level[&"disc_slope"] = kernel.z
			level[&"is_gaussian"] = filter == Filter.GAUSSIAN and level_size not in COARSE_DISCS
			_add_level(level_size, RoundShader, level)
		else:
			level[&"binomial"] = filter == Filter.BINOMIAL
			_add_level(level_size, OnDemand.fetch(_REDUCE_SHADER, OnDemand.FILTERS), level)
		_fetches.append(_PLACE_FETCHES + _count_level_fetches(level_size))
		level_size >>= 1


func _count_level_fetches(level_size: int) -> float:
	if not is_round(filter) or level_size not in COARSE_DISCS:
		return _LEVEL_FETCHES[filter]
	# A disc with its rim; at most all texels.
	const RIM := 0.5
	return minf(PI * pow(2.0 * sqrt(COARSE_DISCS[level_size].x) + RIM, 2.0), 24.0 * level_size ** 2)


func _count_panorama_fetches(width: int, face_size: int) -> float:
	var samples := count_samples(width, face_size)
	if level_0_variance == 0.0:
		return samples * samples * (4.0 + _PLACE_FETCHES)
	# The square's side in texels of the panorama on the equator, and one texel to mix with on both
	# sides; around the sphere, pi / 2 times as many columns.
	var side := sqrt(12.0 * level_0_variance) * width / (PI * face_size)
	return (side + 2.0) * (0.5 * PI * side + 2.0)


func _add_level(
	level_size: int, shader: Shader, parameters: Dictionary[StringName, Variant]
) -> RID:
	var extent := level_size * Vector2i(COLUMNS, ROWS)
	var drawn := CanvasPass.new(extent, true)
	levels.append(drawn)
	return drawn.add_rect(Rect2i(Vector2i.ZERO, extent), shader, parameters)
