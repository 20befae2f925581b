@tool
extends RefCounted
## Makes the pyramid of an environment on the GPU, in any renderer.
##
## Each level is one canvas draw into a viewport of its own, an atlas of the six faces; a chain of
## viewports is drawn within one frame. The levels are then read back and become a [Cubemap].
## [br]Use: [method start], then [method finish] once [signal RenderingServer.frame_post_draw]
## has come. Everything on the rendering server is freed with the object.

## How a level is made from the finer one.
enum Filter { BOX, BINOMIAL, GAUSSIAN, DISC }

const PanoramaShader := preload("shaders/pyramid_panorama.gdshader")
const RoundShader := preload("shaders/pyramid_round.gdshader")
const ReduceShader := preload("shaders/pyramid_reduce.gdshader")

## By filter, a third of the variance that a level's kernel has per axis, in solid angles of the
## finer level's texels: c in shaders/environment.gdshaderinc.
const LEVEL_VARIANCES: Array[float] = [1.0 / 12.0, 1.0 / 4.0, 5.0 / 6.0, 5.0 / 6.0]
## Texels along the side of a face: the least and the most that can be asked for.
const MIN_SIZE := 4
const MAX_SIZE := 2048
## The most that is chosen automatically.
const MAX_AUTOMATIC_SIZE := 512
# The atlas of the faces.
const _COLUMNS := 3
const _ROWS := 2
const _MAX_SAMPLES := 8
# Formats that hold linear light; the others hold sRGB.
const _LINEAR_FORMATS: Array[Image.Format] = [
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

var size := 0

var _viewports: Array[RID] = []
# Freed in this order.
var _rids: Array[RID] = []
# Keeps it on the GPU until it has been drawn.
var _panorama: Texture2D


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE:
		for rid in _rids:
			RenderingServer.free_rid(rid)


## Whether there is anything to draw with; false with [code]--headless[/code].
static func has_renderer() -> bool:
	return DisplayServer.get_name() != "headless"


## Whether a filter blurs alike along all directions, and all over the sphere.
static func is_round(filter: Filter) -> bool:
	return filter == Filter.GAUSSIAN or filter == Filter.DISC


## The size chosen for a panorama where none is asked for: its columns over half the circle, up to
## a power of two.
static func automatic_size(panorama: Texture2D) -> int:
	var wanted := nearest_po2(maxi(ceili(panorama.get_width() / 2.0), 1))
	return clampi(wanted, MIN_SIZE, MAX_AUTOMATIC_SIZE)


## Puts the work in the rendering server's queue; faces will have [param face_size] texels a side,
## a power of two.
func start(panorama: Texture2D, face_size: int, filter: Filter) -> void:
	size = face_size
	_panorama = panorama
	var format := RenderingServer.texture_get_format(panorama.get_rid())
	_add_level(
		size,
		PanoramaShader,
		{
			&"panorama": panorama.get_rid(),
			&"panorama_is_srgb": format not in _LINEAR_FORMATS,
			&"face_size": size,
			&"samples": clampi(ceili(panorama.get_width() / (2.0 * size)), 1, _MAX_SAMPLES),
		}
	)
	var level_size := size >> 1
	while level_size > 0:
		var finer := RenderingServer.viewport_get_texture(_viewports.back())
		var parameters: Dictionary[StringName, Variant] = {
			&"finer": finer, &"face_size": level_size
		}
		if is_round(filter):
			parameters[&"kernel_variance"] = 3.0 * LEVEL_VARIANCES[filter]
			parameters[&"is_gaussian"] = filter == Filter.GAUSSIAN
			_add_level(level_size, RoundShader, parameters)
		else:
			parameters[&"binomial"] = filter == Filter.BINOMIAL
			_add_level(level_size, ReduceShader, parameters)
		level_size >>= 1


## The pyramid after it has been drawn: six half-float images with all their mip levels, in the
## order +X −X +Y −Y +Z −Z. Empty if nothing was drawn.
func finish() -> Array[Image]:
	var data: Array[PackedByteArray] = [
		PackedByteArray(),
		PackedByteArray(),
		PackedByteArray(),
		PackedByteArray(),
		PackedByteArray(),
		PackedByteArray(),
	]
	var faces: Array[Image] = []
	var level_size := size
	for viewport in _viewports:
		var atlas := RenderingServer.texture_2d_get(RenderingServer.viewport_get_texture(viewport))
		if atlas == null or atlas.get_size() != level_size * Vector2i(_COLUMNS, _ROWS):
			return faces
		atlas.convert(Image.FORMAT_RGBAH)
		for face in 6:
			@warning_ignore("integer_division")
			var corner := Vector2i(face % _COLUMNS, face / _COLUMNS) * level_size
			var region := atlas.get_region(Rect2i(corner, Vector2i(level_size, level_size)))
			data[face].append_array(region.get_data())
		level_size >>= 1
	for face in 6:
		faces.append(Image.create_from_data(size, size, true, Image.FORMAT_RGBAH, data[face]))
	return faces


func _add_level(
	level_size: int, shader: Shader, parameters: Dictionary[StringName, Variant]
) -> void:
	var server := RenderingServer
	var extent := level_size * Vector2i(_COLUMNS, _ROWS)
	var material := server.material_create()
	server.material_set_shader(material, shader.get_rid())
	for name: StringName in parameters:
		server.material_set_param(material, name, parameters[name])
	var item := server.canvas_item_create()
	server.canvas_item_add_rect(item, Rect2(Vector2.ZERO, extent), Color.WHITE)
	server.canvas_item_set_material(item, material)
	var canvas := server.canvas_create()
	server.canvas_item_set_parent(item, canvas)
	var viewport := server.viewport_create()
	server.viewport_set_disable_3d(viewport, true)
	server.viewport_set_use_hdr_2d(viewport, true)
	server.viewport_set_transparent_background(viewport, true)
	server.viewport_set_size(viewport, extent.x, extent.y)
	server.viewport_attach_canvas(viewport, canvas)
	server.viewport_set_update_mode(viewport, RenderingServer.VIEWPORT_UPDATE_ONCE)
	server.viewport_set_active(viewport, true)
	_viewports.append(viewport)
	_rids.append_array([viewport, canvas, item, material])
