extends GdUnitTestSuite
## The light follows its source when it should, as soon as it should, and leaves nothing behind
## after 300 updates, or as many as LOBELIGHT_UPDATES says.

const Kit := preload("support/render_kit.gd")
const LiveLight := preload("res://addons/lobelight/runtime/live/live_light.gd")
const SkyKit := preload("support/sky_kit.gd")
const MODES := LobeEnvironment3D.UpdateMode
const SIDE := 16
const MIDDLE := 8
const SHADER := """shader_type sky;
uniform vec3 colour = vec3(1.0, 0.0, 0.0);
void sky() {
	COLOR = LIGHT0_ENABLED ? LIGHT0_COLOR : colour;
}
"""

var _view: LinearViewport
var _environment: LobeEnvironment3D
var _surroundings: Environment
var _rebuilt := 0
var _window_size: Vector2i
# Frames in which a change is drawn: Compatibility reads a face back in each.
var _update := Kit.count_update_frames()


func before() -> void:
	# Frames take as long as the window takes to be shown.
	_window_size = get_window().size
	get_window().size = Vector2i(64, 64)


func after() -> void:
	get_window().size = _window_size


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_surroundings = _view.camera.environment
	_surroundings.background_color = Color.RED
	_environment = LobeEnvironment3D.new()
	_environment.filter = LobeEnvironment3D.Filter.BOX
	_environment.size = 16
	_environment.rebuilt.connect(func() -> void: _rebuilt += 1)
	_view.add_child(_environment)
	_view.add_child(SkyKit.make_mirror())
	await _frames(2)
	_rebuilt = 0


func after_test() -> void:
	_view.free()


func test_the_sky_shows_by_itself() -> void:
	assert_object(_environment.get_cubemap()).is_not_null()
	_assert_colour(await _mirrored(), Color.RED)


func test_a_change_shows_in_the_next_frame() -> void:
	_surroundings.background_color = Color.GREEN
	# The frame that shows the new background, and then its reflection.
	await _mirrored()
	_assert_colour(await _mirrored(), Color.GREEN)
	assert_int(_rebuilt).is_equal(1)
	# Nothing happens while nothing changes.
	await _frames(5)
	assert_int(_rebuilt).is_equal(1)


func test_everything_about_the_sky_counts() -> void:
	SkyKit.set_sky(_surroundings, "shader")
	var material: ShaderMaterial = _surroundings.sky.sky_material
	material.shader.code = SHADER
	await _frames(1 + _update)
	_assert_colour(await _mirrored(), Color.RED)
	material.set_shader_parameter(&"colour", Vector3(0.0, 1.0, 0.0))
	await _frames(_update)
	_assert_colour(await _mirrored(), Color.GREEN)
	var sun := SkyKit.make_sun()
	sun.light_color = Color.BLUE
	_view.add_child(sun)
	await _frames(_update)
	_assert_colour(await _mirrored(), Color.BLUE)
	sun.light_color = Color.RED
	await _frames(_update)
	_assert_colour(await _mirrored(), Color.RED)
	sun.hide()
	await _frames(_update)
	_assert_colour(await _mirrored(), Color.GREEN)
	sun.show()
	sun.free()
	await _frames(_update)
	_assert_colour(await _mirrored(), Color.GREEN)
	var other := Environment.new()
	other.background_mode = Environment.BG_COLOR
	other.background_color = Color.MAGENTA
	_view.camera.environment = other
	await _frames(_update)
	_assert_colour(await _mirrored(), Color.MAGENTA)


func test_another_panorama_of_the_sky() -> void:
	SkyKit.set_sky(_surroundings, "panorama")
	var material: PanoramaSkyMaterial = _surroundings.sky.sky_material
	material.panorama = Kit.constant(0.0)
	await _frames(1 + _update)
	_assert_colour(await _mirrored(), Color.BLACK)
	material.panorama = Kit.constant(1.0)
	await _frames(_update)
	_assert_colour(await _mirrored(), Color.WHITE)
	(material.panorama as ImageTexture).update(Kit.constant(0.0).get_image())
	material.panorama.emit_changed()
	await _frames(_update)
	_assert_colour(await _mirrored(), Color.BLACK)


func test_turning_a_panorama_costs_no_update() -> void:
	SkyKit.set_sky(_surroundings, "panorama")
	await _frames(1 + _update)
	_rebuilt = 0
	_surroundings.sky_rotation.y = 0.5 * PI
	_surroundings.background_energy_multiplier = 0.5
	await _frames(_update)
	var image: Image = await _view.capture()
	# Compatibility has no other way than to draw the sky again.
	assert_int(_rebuilt).is_equal(1 if LinearViewport.is_compatibility() else 0)
	# What is at +z now was at -x before.
	if not LinearViewport.is_compatibility():
		var pixel := Vector2(MIDDLE + 0.5, MIDDLE + 0.5)
		var mirrored := SkyKit.reflected(_view.camera, pixel)
		var expected := 0.5 * SkyKit.radiance(mirrored.rotated(Vector3.UP, -0.5 * PI))
		_assert_colour(image.get_pixel(MIDDLE, MIDDLE), expected)


func test_once() -> void:
	_environment.update_mode = MODES.ONCE
	await _frames(2)
	_rebuilt = 0
	_surroundings.background_color = Color.GREEN
	await _frames(3)
	_assert_colour(await _mirrored(), Color.RED)
	assert_int(_rebuilt).is_equal(0)
	await _environment.rebuild()
	_assert_colour(await _mirrored(), Color.GREEN)


func test_every_frame() -> void:
	_environment.update_mode = MODES.EVERY_FRAME
	await _frames(1)
	_rebuilt = 0
	var cube := _environment.get_cubemap()
	await _frames(6)
	assert_int(_rebuilt).is_equal(6)
	assert_int(_environment.update_frames).is_equal(1)
	assert_object(_environment.get_cubemap()).is_same(cube)
	# While it is hidden, nothing is drawn.
	_environment.hide()
	_rebuilt = 0
	await _frames(3)
	assert_int(_rebuilt).is_equal(0)


func test_cost_is_measured_in_every_mode() -> void:
	_show_by_views()
	for mode: LobeEnvironment3D.UpdateMode in MODES.values():
		_environment.update_mode = mode
		_environment.measure_cost = false
		await _frames(2)
		assert_float(_environment.update_gpu_time).is_equal(0.0)
		_environment.measure_cost = true
		await _frames(24)
		var told := "in mode %d" % mode
		assert_float(_environment.update_gpu_time).append_failure_message(told).is_greater(0.0)
		assert_float(_environment.update_cpu_time).append_failure_message(told).is_greater(0.0)
		var time := _environment.update_gpu_time
		if mode == MODES.ONCE or mode == MODES.WHEN_CHANGED:
			# It stays when the memory for drawing has been given back.
			_rebuilt = 0
			await _frames(LiveLight._IDLE_FRAMES + 8)
			assert_float(_environment.update_gpu_time).is_equal(time)
			assert_int(_rebuilt).is_equal(0)


func test_hundreds_of_updates_leave_nothing_behind() -> void:
	_show_by_views()
	_environment.update_mode = MODES.EVERY_FRAME
	await _frames(20)
	var before: Dictionary = await _in_use()
	_rebuilt = 0
	var count := 300
	if OS.has_environment("LOBELIGHT_UPDATES"):
		count = OS.get_environment("LOBELIGHT_UPDATES").to_int()
	await _frames(count)
	var updates := _rebuilt
	assert_dict(await _in_use()).is_equal(before)
	assert_int(updates).is_equal(count)


func test_other_sizes_leave_nothing_behind() -> void:
	_show_by_views()
	await _frames(1 + _update)
	var before: Dictionary = await _in_use()
	for size: int in [32, 8, 64, 16]:
		_environment.size = size
		await _frames(2 + _update)
	assert_dict(await _in_use()).is_equal(before)


func test_memory_for_drawing_is_given_back() -> void:
	var material := _show_by_views()
	await _frames(1 + _update)
	assert_object(_environment._live.chain).is_not_null()
	var cube := _environment.get_cubemap()
	await _frames(LiveLight._IDLE_FRAMES + 3)
	assert_object(_environment._live.chain).is_null()
	assert_object(_environment.get_cubemap()).is_same(cube)
	_assert_colour(await _mirrored(), Color.RED)
	# And taken again, but for the cube map. Skies that have been still are looked at less often.
	material.set_shader_parameter(&"colour", Vector3(0.0, 1.0, 0.0))
	await _frames(LiveLight._STILL_STEP - 1 + _update)
	_assert_colour(await _mirrored(), Color.GREEN)
	assert_object(_environment.get_cubemap()).is_same(cube)


func test_freed_at_any_moment() -> void:
	for mode: LobeEnvironment3D.UpdateMode in [MODES.EVERY_FRAME, MODES.TIME_SLICED]:
		for frames in 4:
			var environment := LobeEnvironment3D.new()
			environment.size = 8
			environment.update_mode = mode
			environment.source = LobeEnvironment3D.Source.CAPTURE
			var view := LinearViewport.new(4)
			add_child(view)
			view.add_child(environment)
			await _frames(frames)
			view.free()
	assert_int(_rebuilt).is_equal(0)


func test_in_another_world() -> void:
	_view.remove_child(_environment)
	assert_object(_environment.get_cubemap()).is_not_null()
	var other := LinearViewport.new(SIDE)
	other.camera.environment.background_color = Color.BLUE
	add_child(other)
	other.add_child(SkyKit.make_mirror())
	other.add_child(_environment)
	# The light of the world it has left stays there for some frames, then all show the only one.
	await _frames(2)
	_assert_colour(await _mirrored(), Color.RED)
	await _frames(4)
	_assert_colour(await _mirrored(), Color.BLUE)
	_assert_colour((await other.capture()).get_pixel(MIDDLE, MIDDLE), Color.BLUE)
	other.free()


# What there is of textures, buffers and objects. To be awaited.
# A colour from all sides is not drawn; a sky of one colour is.
func _show_by_views() -> ShaderMaterial:
	SkyKit.set_sky(_surroundings, "shader")
	var material: ShaderMaterial = _surroundings.sky.sky_material
	material.shader.code = SHADER
	return material


func _in_use() -> Dictionary:
	await _frames(4)
	return {
		"textures":
		RenderingServer.get_rendering_info(RenderingServer.RENDERING_INFO_TEXTURE_MEM_USED),
		"buffers":
		RenderingServer.get_rendering_info(RenderingServer.RENDERING_INFO_BUFFER_MEM_USED),
		"objects": Performance.get_monitor(Performance.OBJECT_COUNT),
		"resources": Performance.get_monitor(Performance.OBJECT_RESOURCE_COUNT),
	}


func _mirrored() -> Color:
	var image: Image = await _view.capture()
	return image.get_pixel(MIDDLE, MIDDLE)


func _frames(count: int) -> void:
	for i in count:
		await RenderingServer.frame_post_draw


func _assert_colour(got: Color, expected: Color) -> void:
	var off := Vector3(got.r - expected.r, got.g - expected.g, got.b - expected.b).abs()
	assert_float(off[off.max_axis_index()]).append_failure_message("%s" % got).is_less(0.01)
