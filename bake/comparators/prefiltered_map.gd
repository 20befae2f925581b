extends RefCounted
## A cube map whose levels are blurred as surfaces of growing width reflect, see prefilter.gdshader;
## made on the GPU in any renderer. It is another one for each BRDF.

const PrefilterShader := preload("prefilter.gdshader")
const Microfacet := preload("microfacet.gd")
const _COLUMNS := 3
# Samples for all texels of a face together, and the most for one.
const _SAMPLES := 1 << 26
const _MOST_SAMPLES := 512
const _LEAST_SAMPLES := 128
const _FRAMES_LATE := 6

var cubemap: Cubemap
var size := 0

# What the GPU took to filter it, in milliseconds; 0 if the driver gives no times.
var _gpu_time := 0.0
# In Compatibility: what drawing it and reading it back takes.
var _wall_time := 0.0


## The map of [param face_size] texels a side whose level l reflects as a surface of the width
## [code]widths[l][/code]; null if nothing was drawn. [param source] has 2 × 2 means. To be awaited.
static func make(
	source: LobeLight, brdf: String, widths: PackedFloat64Array, face_size: int, tree: SceneTree
) -> RefCounted:
	var viewports: Array[SubViewport] = []
	for level in widths.size():
		viewports.append(_draw(source, brdf, widths[level], face_size >> level, tree))
	await RenderingServer.frame_post_draw
	var made := new()
	made.size = face_size
	if LinearViewport.is_compatibility():
		await made._take_in_time(viewports)
	else:
		# First, because reading back throws the times away.
		await made._measure(viewports)
		made._take(viewports)
	for viewport in viewports:
		viewport.free()
	return made if made.cubemap != null else null


## What a changed environment costs, for [method ComparisonMethod.settings]; see
## [method ComparisonStage.update_cost].
func get_update_cost() -> Dictionary:
	if LinearViewport.is_compatibility():
		return {"prefilter_wall_ms": _wall_time}
	return {"prefilter_ms": _gpu_time}


static func _draw(
	source: LobeLight, brdf: String, width: float, side: int, tree: SceneTree
) -> SubViewport:
	var material := ShaderMaterial.new()
	material.shader = PrefilterShader
	material.set_shader_parameter(&"source", source.cubemap)
	material.set_shader_parameter(&"source_size", float(source.size))
	material.set_shader_parameter(&"face_size", side)
	material.set_shader_parameter(&"width", width)
	material.set_shader_parameter(&"model", Microfacet.BRDFS.find(brdf))
	@warning_ignore("integer_division")
	var samples := clampi(_SAMPLES / (side * side), _LEAST_SAMPLES, _MOST_SAMPLES)
	material.set_shader_parameter(&"sample_count", samples)
	var viewport := SubViewport.new()
	viewport.disable_3d = true
	viewport.use_hdr_2d = true
	viewport.transparent_bg = true
	viewport.size = Vector2i(_COLUMNS * side, 2 * side)
	viewport.render_target_update_mode = SubViewport.UPDATE_ONCE
	var rectangle := ColorRect.new()
	rectangle.size = viewport.size
	rectangle.material = material
	viewport.add_child(rectangle)
	tree.root.add_child(viewport)
	RenderingServer.viewport_set_measure_render_time(viewport.get_viewport_rid(), true)
	return viewport


# The cube map of what was drawn.
func _take(viewports: Array[SubViewport]) -> void:
	var faces: Array[PackedByteArray] = []
	faces.resize(6)
	var has_levels := viewports.size() > 1
	for level in viewports.size():
		var atlas := viewports[level].get_texture().get_image()
		if atlas == null or atlas.is_empty():
			return
		atlas.convert(Image.FORMAT_RGBAH)
		var side := size >> level
		for face in 6:
			@warning_ignore("integer_division")
			var corner := Vector2i(face % _COLUMNS, face / _COLUMNS) * side
			var part := atlas.get_region(Rect2i(corner, Vector2i(side, side)))
			faces[face].append_array(part.get_data())
	var images: Array[Image] = []
	for face in 6:
		images.append(
			Image.create_from_data(size, size, has_levels, Image.FORMAT_RGBAH, faces[face])
		)
	cubemap = Cubemap.new()
	cubemap.create_from_images(images)


# Draws once more, with shaders that are compiled by now; reading back waits until all is drawn.
func _take_in_time(viewports: Array[SubViewport]) -> void:
	for viewport in viewports:
		viewport.render_target_update_mode = SubViewport.UPDATE_ONCE
	_take(viewports)
	var started := Time.get_ticks_usec()
	await RenderingServer.frame_post_draw
	_take(viewports)
	_wall_time = 0.001 * (Time.get_ticks_usec() - started)


# The times come some frames late, and only to viewports that are drawn: these are, of nothing, and
# keep what they show. The first time that comes is the largest.
func _measure(viewports: Array[SubViewport]) -> void:
	for viewport in viewports:
		(viewport.get_child(0) as ColorRect).visible = false
		viewport.render_target_clear_mode = SubViewport.CLEAR_MODE_NEVER
		viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	var longest := PackedFloat32Array()
	longest.resize(viewports.size())
	for frame in _FRAMES_LATE:
		await RenderingServer.frame_post_draw
		for level in viewports.size():
			var time := RenderingServer.viewport_get_measured_render_time_gpu(
				viewports[level].get_viewport_rid()
			)
			longest[level] = maxf(longest[level], time)
	for time in longest:
		_gpu_time += time
