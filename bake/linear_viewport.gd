class_name LinearViewport
extends SubViewport
## Renders a 3D scene of its own and reads it back as linear radiance, in every renderer.
##
## Put the viewport into the tree, nodes to be drawn below it, then [method capture] pictures or
## [method measure_gpu_time]. What is not covered is 0, with alpha 0.

const _MOST_FRAMES_LATE := 12

## The camera: orthographic from +z, two units high, which shows the unit sphere.
var camera := Camera3D.new()


func _init(side := 256) -> void:
	size = Vector2i(side, side)
	own_world_3d = true
	use_hdr_2d = true
	transparent_bg = true
	msaa_3d = Viewport.MSAA_DISABLED
	screen_space_aa = Viewport.SCREEN_SPACE_AA_DISABLED
	use_debanding = false
	use_taa = false
	scaling_3d_mode = Viewport.SCALING_3D_MODE_BILINEAR
	scaling_3d_scale = 1.0
	render_target_update_mode = SubViewport.UPDATE_DISABLED

	# The default world may have a sky and a tone mapper from the project's settings.
	var surroundings := Environment.new()
	surroundings.background_mode = Environment.BG_COLOR
	surroundings.background_color = Color.BLACK
	surroundings.ambient_light_source = Environment.AMBIENT_SOURCE_DISABLED
	surroundings.reflected_light_source = Environment.REFLECTION_SOURCE_DISABLED
	surroundings.tonemap_mode = Environment.TONE_MAPPER_LINEAR
	camera.environment = surroundings
	camera.position = Vector3(0.0, 0.0, 4.0)
	camera.near = 0.1
	camera.far = 10.0
	camera.set_orthogonal(2.0, 0.1, 10.0)
	add_child(camera)


## Whether the running renderer is Compatibility, whose frame buffers hold sRGB-encoded values.
static func is_compatibility() -> bool:
	return RenderingServer.get_current_rendering_method() == "gl_compatibility"


## Draws a frame and gives it as linear radiance, RGBAF; [code]null[/code] without a renderer.
## To be awaited.
func capture() -> Image:
	if DisplayServer.get_name() == "headless":
		return null
	render_target_update_mode = SubViewport.UPDATE_ONCE
	await RenderingServer.frame_post_draw
	var image := get_texture().get_image()
	image.convert(Image.FORMAT_RGBAF)
	return decode(image) if is_compatibility() else image


## Milliseconds that the GPU took for each of [param frames] frames, after [param warm_up] others in
## which shaders are compiled. Fewer, or none, if the driver gives no times. To be awaited.
func measure_gpu_time(frames: int, warm_up := 6) -> PackedFloat32Array:
	var times := PackedFloat32Array()
	if DisplayServer.get_name() == "headless":
		return times
	var viewport := get_viewport_rid()
	RenderingServer.viewport_set_measure_render_time(viewport, true)
	render_target_update_mode = SubViewport.UPDATE_ALWAYS
	# The times come some frames late, and are 0 until then.
	for frame in _MOST_FRAMES_LATE + warm_up + frames:
		await RenderingServer.frame_post_draw
		var time := RenderingServer.viewport_get_measured_render_time_gpu(viewport)
		if time > 0.0:
			times.append(time)
		if times.size() == warm_up + frames:
			break
	render_target_update_mode = SubViewport.UPDATE_DISABLED
	RenderingServer.viewport_set_measure_render_time(viewport, false)
	return times.slice(warm_up)


## The median of a sample; 0 if there is none.
static func median(values: PackedFloat32Array) -> float:
	if values.is_empty():
		return 0.0
	var sorted := values.duplicate()
	sorted.sort()
	@warning_ignore("integer_division")
	var middle := sorted.size() / 2
	if sorted.size() % 2 == 1:
		return sorted[middle]
	return 0.5 * (sorted[middle - 1] + sorted[middle])


## The linear radiance of an RGBAF image from a frame buffer of Compatibility; alpha is left alone.
## The engine encodes by max(1.055 · L^(1/2.4) − 0.055, 0), without sRGB's straight part near
## black, so that what is darker than 0.00084 is lost and comes out as 0.
static func decode(image: Image) -> Image:
	var values := image.get_data().to_float32_array()
	for i in values.size():
		if i % 4 == 3:
			continue
		var value := values[i]
		values[i] = pow((value + 0.055) / 1.055, 2.4) if value > 0.0 else 0.0
	return Image.create_from_data(
		image.get_width(), image.get_height(), false, Image.FORMAT_RGBAF, values.to_byte_array()
	)
