@tool
extends "../../pyramid/light_search.gd"
## Looks for sources in a panorama or in six views, and takes them out of level 0, on the GPU.
##
## gdextension/src/image/compact_sources.h defines what a source is, and finds them in baked light.
## The search here looks at each seed in the unchanged map: the rest around a source is not found as
## another source, and of two sources within 5 degrees only the brighter one is found.

const CanvasPass := preload("../../pyramid/canvas_pass.gd")
const HandedSources := preload("../../pyramid/handed_sources.gd")
const OnDemand := preload("../../on_demand.gd")
const Pyramid := preload("../../pyramid/pyramid.gd")
const FoundShader := preload("source_found.gdshader")
const PanoramaRestShader := preload("pyramid_rest.gdshader")

const _CELLS := preload("source_cells.gdshaderinc")
const _PEAKS := preload("source_peaks.gdshaderinc")
const _SEEDS := preload("source_seeds.gdshaderinc")
const _ROWS := preload("source_rows.gdshaderinc")
const _SHAPES := preload("source_shapes.gdshaderinc")
const _VIEWS_REST_SHADER := "res://addons/lobelight/runtime/skies/views_rest.gdshader"
const _GPU_SOURCES := "res://addons/lobelight/runtime/rendering_device/gpu_sources.gd"
const _PACKED_SOURCES := "res://addons/lobelight/runtime/compatibility/packed_sources.gd"
const _HEAD := "shader_type canvas_item;\nrender_mode unshaded, blend_disabled;\n"
# Cells along a panorama's width and along the side of a view, at most; texels along the side of a
# cell, at most, whose numbers are half floats; cells along the side of a group.
const _PANORAMA_CELLS := 128
const _VIEW_CELLS := 32
const _MOST_TEXELS := 64
const _GROUP := 4
# As in seed_numbers.gdshaderinc, and the form of what is found.
const _SEED_COUNT := 8
const _SEED_ROWS := 3
const _SHAPE_ROWS := 4
const _LEVELS := 8
const _FOUND := Vector2i(4, 5)
# Of a panorama's height, and of the side of a view, what a source may reach over: 10 degrees, and
# in the corners of a view three times as many texels as in its middle.
const _PANORAMA_WINDOW := 1.0 / 18.0
const _VIEW_WINDOW := 0.27

static var _shaders: Dictionary[String, Shader] = {}

## What has been found, for materials.
var handed: HandedSources
## Whether level 0 is drawn without the sources.
var takes_out := false

var _pyramid: Pyramid
var _rest_shader: Shader
var _of_views: bool
var _cells: CanvasPass
# The others, in their order.
var _last: Array[CanvasPass] = []
var _grid: Vector2i
var _texels: int
var _last_fetches: float


## Of [param most] sources of a panorama. The pyramid is set up after this, from the same one.
static func in_panorama(
	pyramid: Pyramid, panorama: Texture2D, as_sky: bool, most: int, old: Texture2D = null
) -> RefCounted:
	var extent := Vector2i(panorama.get_width(), panorama.get_height())
	var search: RefCounted = new()
	search._pyramid = pyramid
	search._rest_shader = PanoramaRestShader
	var block := ceili(maxi(extent.x, 2 * extent.y) / float(_PANORAMA_CELLS))
	var rows := ceili(_PANORAMA_WINDOW * extent.y) + 4
	var parameters := Pyramid.describe_panorama(panorama, as_sky)
	search._set_up(extent, mini(block, _MOST_TEXELS), rows, parameters, most, old)
	return search


## The same of views, see [method Pyramid.set_up_views], of [param side] pixels.
static func in_views(
	pyramid: Pyramid, views: Array[RID], side: int, most: int, old: Texture2D = null
) -> RefCounted:
	var search: RefCounted = new()
	search._pyramid = pyramid
	search._of_views = true
	search._rest_shader = OnDemand.fetch(_VIEWS_REST_SHADER, OnDemand.SKIES)
	var block := ceili(side / float(_VIEW_CELLS))
	var rows := ceili(_VIEW_WINDOW * side) + 4
	var parameters := Pyramid.describe_views(views)
	var extent := side * Vector2i(Pyramid.COLUMNS, Pyramid.ROWS)
	search._set_up(extent, mini(block, _MOST_TEXELS), rows, parameters, most, old)
	return search


## Has level 0 drawn without the sources, or with them.
func take_out(takes: bool) -> void:
	# Called before each update. Setting the same shader again would rebuild the material.
	if takes == takes_out:
		return
	takes_out = takes
	var parameters: Dictionary[StringName, Variant] = {}
	if takes:
		parameters[&"found_sources"] = (_last.back() as CanvasPass).get_texture()
	_pyramid.draw_level_0_by(_rest_shader if takes else null, parameters)


func count_rows() -> int:
	return _grid.y


func count_fetches() -> float:
	return _texels


func count_last_fetches() -> float:
	return _last_fetches


func draw_rows(first: int, count: int) -> void:
	if count == _grid.y:
		_cells.draw()
	else:
		_cells.draw_rows(first, count)


func draw_last() -> void:
	for drawn in _last:
		drawn.draw()
	handed.draw()


func receive() -> void:
	handed.receive()


func get_viewports() -> Array[RID]:
	var viewports: Array[RID] = [_cells.viewport]
	for drawn in _last:
		viewports.append(drawn.viewport)
	viewports.append_array(handed.get_viewports())
	return viewports


func _set_up(
	extent: Vector2i,
	block: int,
	rows: int,
	parameters: Dictionary[StringName, Variant],
	most: int,
	old: Texture2D
) -> void:
	_grid = _divide(extent, block)
	_texels = extent.x * extent.y
	var groups := _divide(_grid, _GROUP)
	parameters[&"grid_block"] = block
	parameters[&"grid_extent"] = _grid
	parameters[&"grid_groups"] = groups
	_cells = _make_pass(_grid, _find_shader(_CELLS), parameters)
	parameters[&"grid_cells"] = _cells.get_texture()
	_add_pass(groups, _find_shader(_PEAKS), parameters)
	parameters[&"grid_peaks"] = _last[0].get_texture()
	_add_pass(Vector2i(_SEED_COUNT, _SEED_ROWS), _find_shader(_SEEDS), parameters)
	parameters[&"source_seeds"] = _last[1].get_texture()
	parameters[&"window_rows"] = rows
	_add_pass(Vector2i(2 * _LEVELS * _SEED_COUNT, rows), _find_shader(_ROWS), parameters)
	parameters[&"source_rows"] = _last[2].get_texture()
	_add_pass(Vector2i(_SEED_COUNT, _SHAPE_ROWS), _find_shader(_SHAPES), parameters)
	parameters[&"source_shapes"] = _last[3].get_texture()
	parameters[&"most_sources"] = clampi(most, 1, _FOUND.x)
	_add_pass(_FOUND, FoundShader, parameters)
	var script: GDScript
	if RenderingServer.get_rendering_device() != null:
		script = OnDemand.fetch(_GPU_SOURCES, OnDemand.RENDERING_DEVICE)
	else:
		script = OnDemand.fetch(_PACKED_SOURCES, OnDemand.COMPATIBILITY)
	handed = script.new(_last.back(), old)
	# Texels about each seed, at each level; what else is looked up are cells.
	_last_fetches = 2.0 * _LEVELS * _SEED_COUNT * rows * rows + 40.0 * _grid.x * _grid.y


func _add_pass(
	extent: Vector2i, shader: Shader, parameters: Dictionary[StringName, Variant]
) -> void:
	_last.append(_make_pass(extent, shader, parameters))


# The pass for panoramas or for views.
func _find_shader(body: ShaderInclude) -> Shader:
	var define := "#define LOBELIGHT_VIEWS\n" if _of_views else ""
	var code := '%s%s#include "%s"\n' % [_HEAD, define, body.resource_path]
	if not _shaders.has(code):
		var shader := Shader.new()
		shader.code = code
		_shaders[code] = shader
	return _shaders[code]


static func _divide(extent: Vector2i, side: int) -> Vector2i:
	return (extent + (side - 1) * Vector2i.ONE) / side


static func _make_pass(
	extent: Vector2i, shader: Shader, parameters: Dictionary[StringName, Variant]
) -> CanvasPass:
	var drawn := CanvasPass.new(extent, true)
	drawn.add_rect(Rect2i(Vector2i.ZERO, extent), shader, parameters)
	return drawn
