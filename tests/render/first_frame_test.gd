extends GdUnitTestSuite
## The first frame that shows a scene has its light, and nobody notices how.

const Kit := preload("support/render_kit.gd")
const SkyKit := preload("support/sky_kit.gd")
const COLOUR := Color(0.25, 0.5, 1.0)
const SHADER := """shader_type sky;
void sky() {
	COLOR = vec3(0.25, 0.5, 1.0);
}
"""
const SIDE := 16
const MIDDLE := 8
## What the light comes from.
const SOURCES := [["panorama"], ["sky panorama"], ["sky"], ["background"], ["scene"]]

var _view: LinearViewport
var _environment: LobeEnvironment3D
var _frames_told := 0


func before_test() -> void:
	# Until the lights of other tests have gone.
	for i in 6:
		await RenderingServer.frame_post_draw
	_view = LinearViewport.new(SIDE)
	_view.add_child(SkyKit.make_mirror())
	_environment = LobeEnvironment3D.new()
	_environment.size = 16
	_view.add_child(_environment)


func after_test() -> void:
	_view.free()


func test_the_first_frame_has_the_light(source: String, _test_parameters := SOURCES) -> void:
	var surroundings := _view.camera.environment
	match source:
		"panorama":
			_environment.panorama = _plain()
		"sky panorama":
			SkyKit.set_sky(surroundings, "panorama")
			(surroundings.sky.sky_material as PanoramaSkyMaterial).panorama = _plain()
		"sky":
			SkyKit.set_sky(surroundings, "shader")
			(surroundings.sky.sky_material as ShaderMaterial).shader.code = SHADER
		"background":
			surroundings.background_color = COLOUR.linear_to_srgb()
		"scene":
			surroundings.background_color = COLOUR.linear_to_srgb()
			_environment.source = LobeEnvironment3D.Source.CAPTURE
			_environment.capture_cull_mask = 0
	add_child(_view)
	_frames_told = 0
	RenderingServer.frame_post_draw.connect(_count)
	var image: Image = await _view.capture()
	RenderingServer.frame_post_draw.disconnect(_count)
	# Whoever waits for a frame waits for one that is seen.
	assert_int(_frames_told).is_less_equal(1)
	assert_object(_environment.get_light()).is_not_null()
	var shown := image.get_pixel(MIDDLE, MIDDLE)
	var second: Image = await _view.capture()
	var settled := second.get_pixel(MIDDLE, MIDDLE)
	assert_float(shown.r).is_equal_approx(settled.r, 0.005)
	assert_float(shown.g).is_equal_approx(settled.g, 0.005)
	assert_float(shown.b).is_equal_approx(settled.b, 0.005)
	assert_float(shown.b - shown.r).is_greater(0.5)


func test_viewports_keep_their_turns() -> void:
	var other := LinearViewport.new(SIDE)
	other.camera.environment.background_color = Color.RED
	other.transparent_bg = false
	add_child(other)
	_environment.panorama = _plain()
	add_child(_view)
	other.render_target_update_mode = SubViewport.UPDATE_ONCE
	await RenderingServer.frame_post_draw
	# It has been drawn in this frame, once.
	assert_float(other.get_texture().get_image().get_pixel(MIDDLE, MIDDLE).r).is_greater(0.9)
	var mode := RenderingServer.viewport_get_update_mode(other.get_viewport_rid())
	assert_int(mode).is_equal(RenderingServer.VIEWPORT_UPDATE_DISABLED)
	mode = RenderingServer.viewport_get_update_mode(get_tree().root.get_viewport_rid())
	assert_int(mode).is_not_equal(RenderingServer.VIEWPORT_UPDATE_DISABLED)
	other.free()


func _count() -> void:
	_frames_told += 1


func _plain() -> ImageTexture:
	var image := Image.create_empty(8, 4, false, Image.FORMAT_RGBAF)
	image.fill(COLOUR)
	return ImageTexture.create_from_image(image)
