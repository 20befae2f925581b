extends GdUnitTestSuite
## The light follows textures that change without a signal, and looks at no others in vain.

const Kit := preload("support/render_kit.gd")
const SkyKit := preload("support/sky_kit.gd")
const SIDE := 16
const MIDDLE := 8
const TEXTURED := """shader_type sky;
uniform sampler2D picture : source_color;
void sky() {
	COLOR = texture(picture, vec2(0.5)).rgb;
}
"""

var _view: LinearViewport
var _environment: LobeEnvironment3D


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_environment = LobeEnvironment3D.new()
	_environment.filter = LobeEnvironment3D.Filter.BOX
	_environment.size = 16
	_view.add_child(_environment)
	_view.add_child(SkyKit.make_mirror())


func after_test() -> void:
	_view.free()


func test_viewports() -> void:
	var drawn := SubViewport.new()
	drawn.size = Vector2i(4, 4)
	drawn.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	var rect := ColorRect.new()
	rect.size = Vector2(4.0, 4.0)
	rect.color = Color.RED
	drawn.add_child(rect)
	_view.add_child(drawn)
	var surroundings := _view.camera.environment
	SkyKit.set_sky(surroundings, "shader")
	var material: ShaderMaterial = surroundings.sky.sky_material
	material.shader.code = TEXTURED
	material.set_shader_parameter(&"picture", drawn.get_texture())
	await _assert_followed(rect)
	# As the panorama of a sky and as the node's own.
	SkyKit.set_sky(surroundings, "panorama")
	(surroundings.sky.sky_material as PanoramaSkyMaterial).panorama = drawn.get_texture()
	await _assert_followed(rect)
	_environment.panorama = drawn.get_texture()
	await _assert_followed(rect)


func test_others_cost_no_update_while_nothing_tells_of_a_change() -> void:
	_environment.panorama = Kit.constant(1.0)
	await _frames(2)
	var rebuilt := [0]
	_environment.rebuilt.connect(func() -> void: rebuilt[0] += 1)
	await _frames(3)
	assert_int(rebuilt[0]).is_equal(0)


func _assert_followed(rect: ColorRect) -> void:
	# Until the update under way has ended, and the next one.
	var frames := 1 + 2 * Kit.count_update_frames()
	await _frames(frames)
	for colour: Color in [Color.GREEN, Color.BLUE, Color.RED]:
		rect.color = colour
		await _frames(frames)
		var image: Image = await _view.capture()
		var got := image.get_pixel(MIDDLE, MIDDLE)
		var off := Vector3(got.r - colour.r, got.g - colour.g, got.b - colour.b).abs()
		assert_float(off[off.max_axis_index()]).append_failure_message("%s" % got).is_less(0.01)


func _frames(count: int) -> void:
	for i in count:
		await RenderingServer.frame_post_draw
