extends GdUnitTestSuite
## Suns and lamps of panoramas are taken out of live light, on the GPU: nothing of their light is
## lost, and maps without any stay as they are.

const Kit := preload("support/render_kit.gd")
const SkyKit := preload("support/sky_kit.gd")
const CanvasPass := preload("res://addons/lobelight/runtime/pyramid/canvas_pass.gd")
const HandedSources := preload("res://addons/lobelight/runtime/pyramid/handed_sources.gd")
const LiveLight := preload("res://addons/lobelight/runtime/live/live_light.gd")
const SourceSearch := preload("res://addons/lobelight/runtime/live/sources/source_search.gd")
const Pyramid := preload("res://addons/lobelight/runtime/pyramid/pyramid.gd")
const PyramidChain := preload("res://addons/lobelight/runtime/pyramid/pyramid_chain.gd")
const HEIGHT := 128
const SIZE := 64
const SUN := Vector3(0.5, 0.4, -0.7)
const LAMP := Vector3(-0.5, 0.1, 0.7)
## A sky that shows its sun.
const SHADER := """shader_type sky;
void sky() {
	COLOR = vec3(0.5) + 0.1 * EYEDIR;
	if (LIGHT0_ENABLED) {
		float edge = smoothstep(cos(0.03), cos(0.015), dot(normalize(EYEDIR), LIGHT0_DIRECTION));
#if CURRENT_RENDERER == RENDERER_COMPATIBILITY
		// Which takes it for sRGB: about a third of its cube.
		COLOR += 30.0 * LIGHT0_COLOR * LIGHT0_ENERGY * edge;
#else
		COLOR += 2000.0 * LIGHT0_COLOR * LIGHT0_ENERGY * edge;
#endif
	}
}
"""
const MODES := [
	[DirectionalLight3D.SKY_MODE_SKY_ONLY],
	[DirectionalLight3D.SKY_MODE_LIGHT_AND_SKY],
	[DirectionalLight3D.SKY_MODE_LIGHT_ONLY],
]
## Frames in which a light that has sources comes to have them drawn.
const FRAMES := 24

var _view: LinearViewport
var _environment: LobeEnvironment3D


func before_test() -> void:
	_view = LinearViewport.new(16)
	add_child(_view)
	_environment = LobeEnvironment3D.new()
	_environment.size = 16
	_view.add_child(_environment)


func after_test() -> void:
	_view.free()


# Lights of discs without sharp edges on a slope.
static func _sky(direction: Vector3, lights: Dictionary[Vector3, float]) -> Color:
	var value := Vector3(0.3, 0.5, 0.7) + 0.1 * direction
	for light in lights:
		var angle := light.normalized().angle_to(direction)
		value += lights[light] * Vector3(1.0, 0.9, 0.6) * smoothstep(0.03, 0.01, angle)
	return Color(value.x, value.y, value.z)


static func _make(lights: Dictionary[Vector3, float]) -> ImageTexture:
	return Kit.make_panorama(HEIGHT, _sky.bind(lights))


# [faces, texture of sources]
func _draw(panorama: Texture2D, most: int, takes := true) -> Array:
	var chain := PyramidChain.new()
	var search: SourceSearch
	if most > 0:
		search = SourceSearch.in_panorama(chain.pyramid, panorama, false, most)
		chain.search = search
	chain.pyramid.set_up_panorama(panorama, SIZE, Pyramid.Filter.DISC)
	if most > 0:
		search.take_out(takes)
	chain.make_cube()
	chain.draw(-1)
	await RenderingServer.frame_post_draw
	assert_bool(chain.receive(-1)).is_true()
	var sources: Image = await _read(search) if most > 0 else null
	return [chain.cube.get_faces(), sources]


func _read(search: SourceSearch) -> Image:
	return await _read_texture(search.handed.texture)


func _faces() -> Array[Image]:
	var live: LiveLight = _environment.get(&"_live")
	return live.chain.cube.get_faces()


static func _read_texture(texture: Texture2D) -> Image:
	if texture is ImageTexture:
		return texture.get_image()
	# A texture of the rendering device's has no image.
	await RenderingServer.frame_post_draw
	var rd := (texture as Texture2DRD).texture_rd_rid
	var data := RenderingServer.get_rendering_device().texture_get_data(rd, 0)
	return Image.create_from_data(4, 3, false, Image.FORMAT_RGBAH, data)


static func _direction(sources: Image, column: int) -> Vector3:
	var most := sources.get_pixel(column, 0)
	var lacking := sources.get_pixel(column, 2)
	return Vector3(most.r, most.g, most.b) + Vector3(lacking.r, lacking.g, lacking.b) / 1024.0


static func _energy(sources: Image, column: int) -> Vector3:
	var energy := sources.get_pixel(column, 1)
	return Vector3(energy.r, energy.g, energy.b)


static func _integral(faces: Array[Image]) -> Vector3:
	var sum := Vector3.ZERO
	for face in faces:
		for y in SIZE:
			for x in SIZE:
				var light := face.get_pixel(x, y)
				sum += Vector3(light.r, light.g, light.b) * Kit.texel_solid_angle(x, y, SIZE)
	return sum


static func _integral_of_panorama(image: Image) -> Vector3:
	var sum := Vector3.ZERO
	for y in HEIGHT:
		var weight := cos(PI * y / HEIGHT) - cos(PI * (y + 1) / HEIGHT)
		for x in 2 * HEIGHT:
			var light := image.get_pixel(x, y)
			sum += Vector3(light.r, light.g, light.b) * weight * PI / HEIGHT
	return sum


func test_no_light_is_lost() -> void:
	# The sun is brighter than half floats can be.
	var panorama := _make({SUN: 1e6, LAMP: 2e4})
	var drawn: Array = await _draw(panorama, 4)
	var faces: Array[Image] = drawn[0]
	var sources: Image = drawn[1]
	var rest := _integral(faces)
	var sum := rest
	for column in 4:
		sum += _energy(sources, column)
	var expected := _integral_of_panorama(panorama.get_image())
	for channel in 3:
		assert_float(sum[channel] / expected[channel]).is_equal_approx(1.0, 0.003)
	# What stays is about what there is without the lights.
	var without := _integral_of_panorama(_make({}).get_image())
	for channel in 3:
		assert_float(rest[channel] / without[channel]).is_equal_approx(1.0, 0.02)
	assert_float(_direction(sources, 0).angle_to(SUN.normalized())).is_less(0.1 * PI / HEIGHT)
	assert_float(_direction(sources, 1).angle_to(LAMP.normalized())).is_less(0.1 * PI / HEIGHT)
	assert_float(_energy(sources, 2).length()).is_equal(0.0)
	var deviation := sources.get_pixel(0, 0).a
	assert_float(deviation).is_between(0.005, 0.02)


func test_they_are_those_that_the_library_finds() -> void:
	var panorama := _make({SUN: 3e5, LAMP: 8e3, Vector3(0.1, 1.0, 0.05): 1e3})
	var image := panorama.get_image()
	image.convert(Image.FORMAT_RGBF)
	var request := {
		"pixels": image.get_data().to_float32_array(),
		"width": 2 * HEIGHT,
		"height": HEIGHT,
		"max_sources": 4,
	}
	var task: RefCounted = ClassDB.instantiate(&"LobeLightFilter")
	var result: Dictionary = task.call(&"find_sources", request)
	var bytes := (result["sources"] as PackedFloat32Array).to_byte_array()
	var expected := Image.create_from_data(4, 3, false, Image.FORMAT_RGBAF, bytes)
	var sources: Image = (await _draw(panorama, 4))[1]
	for column in 4:
		var energy := _energy(expected, column)
		var off := (_energy(sources, column) - energy).abs()
		assert_float(off[off.max_axis_index()]).is_less_equal(0.01 * energy.length())
		if energy.length() > 0.0:
			var angle := _direction(sources, column).angle_to(_direction(expected, column))
			assert_float(angle).is_less(0.1 * PI / HEIGHT)
			var deviation := expected.get_pixel(column, 0).a
			assert_float(sources.get_pixel(column, 0).a / deviation).is_equal_approx(1.0, 0.01)
	assert_int(result["source_count"]).is_greater_equal(2)


func test_a_map_without_any_stays_as_it_is() -> void:
	var panorama := _make({SUN: 3.0})
	var plain: Array[Image] = (await _draw(panorama, 0))[0]
	for takes: bool in [false, true]:
		var drawn: Array = await _draw(panorama, 4, takes)
		for face in 6:
			var faces: Array[Image] = drawn[0]
			assert_bool(faces[face].get_data() == plain[face].get_data()).is_true()
		for column in 4:
			assert_float(_energy(drawn[1] as Image, column).length()).is_equal(0.0)


func test_a_moving_sun_does_not_jump() -> void:
	# By half a texel a step.
	var without := _integral_of_panorama(_make({}).get_image()).x
	for step in 10:
		var sun := SUN.normalized().rotated(Vector3.UP, 0.5 * step * PI / HEIGHT)
		var panorama := _make({sun: 1e4})
		var drawn: Array = await _draw(panorama, 4)
		var sources: Image = drawn[1]
		assert_float(_direction(sources, 0).angle_to(sun)).is_less(0.1 * PI / HEIGHT)
		var energy := _energy(sources, 0).x
		# The same light is not as much in each place of the texels.
		var expected := _integral_of_panorama(panorama.get_image()).x
		assert_float(energy / (expected - without)).is_equal_approx(1.0, 0.01)
		var sum := _integral(drawn[0] as Array[Image]).x + energy
		assert_float(sum / expected).is_equal_approx(1.0, 0.004)


func test_a_sun_that_rises_fades_in() -> void:
	# Between shares of nothing and all that is above its surroundings.
	var before := 0.0
	var shares: Array[float] = []
	for step in 12:
		var brightness := 52.0 * pow(1.15, step)
		var panorama := _make({SUN: brightness})
		var sources: Image = (await _draw(panorama, 4))[1]
		var share := _energy(sources, 0).x / (brightness * TAU * (1.0 - cos(0.02)))
		assert_float(share).is_greater_equal(before - 0.01)
		shares.append(share)
		before = share
	assert_float(shares[0]).append_failure_message(str(shares)).is_equal(0.0)
	assert_float(shares[-1]).append_failure_message(str(shares)).is_greater(0.8)
	for step in range(1, 12):
		var jump := shares[step] - shares[step - 1]
		assert_float(jump).append_failure_message(str(shares)).is_less(0.33)


func test_an_environment_has_them_some_frames_later() -> void:
	_environment.panorama = _make({SUN: 1e5})
	await _environment.rebuild()
	var light := _environment.get_light()
	assert_object(light.sources).is_null()
	await _frames(FRAMES)
	assert_object(_environment.get_light()).is_same(light)
	assert_object(light.sources).is_not_null()
	var shown := light.sources
	# A change goes on with them at once.
	_environment.panorama.emit_changed()
	await _frames(FRAMES)
	assert_object(_environment.get_light().sources).is_same(shown)
	# Another map without any: they go after some time.
	_environment.panorama = _make({})
	await _frames(FRAMES + 40)
	assert_object(_environment.get_light().sources).is_null()


func test_light_that_is_not_searched_has_none() -> void:
	_environment.panorama = _make({SUN: 1e5})
	await _frames(FRAMES)
	var live: LiveLight = _environment.get(&"_live")
	assert_bool(live.source.takes_sources()).is_true()
	# Bytes are not linear, and hold no sun.
	var bytes := Image.create_empty(8, 4, false, Image.FORMAT_RGB8)
	_environment.panorama = ImageTexture.create_from_image(bytes)
	await _frames(FRAMES)
	assert_object(live.chain.search).is_null()
	assert_bool(live.source.takes_sources()).is_false()
	assert_object(_environment.get_light().sources).is_null()


func test_an_answer_that_cannot_be_read_is_none() -> void:
	_environment.panorama = _make({SUN: 1e5})
	await _frames(FRAMES)
	assert_object(_environment.get_light().sources).is_not_null()
	if RenderingServer.get_rendering_device() != null:
		# Only Compatibility reads them back.
		return
	var live: LiveLight = _environment.get(&"_live")
	var handed := live.chain.search.get(&"handed") as HandedSources
	handed.set(&"_drawn", CanvasPass.new(Vector2i(4, 4), true))
	handed.take_answer()
	handed.receive()
	assert_int(handed.take_answer()).is_equal(HandedSources.Answer.UNKNOWN)


func test_the_memory_for_the_search_is_given_back() -> void:
	var panorama := _make({SUN: 1e5})
	_environment.update_mode = LobeEnvironment3D.UpdateMode.ONCE
	_environment.panorama = panorama
	await _frames(FRAMES)
	var live: LiveLight = _environment.get(&"_live")
	assert_object(live.chain).is_null()
	assert_object(_environment.get_light().sources).is_not_null()


func test_none_are_looked_for_where_none_are_wanted() -> void:
	_environment.max_sources = 0
	_environment.panorama = _make({SUN: 1e5})
	await _frames(2)
	var live: LiveLight = _environment.get(&"_live")
	assert_object(live.chain.search).is_null()
	await _frames(FRAMES)
	assert_object(_environment.get_light().sources).is_null()


func test_no_light_is_missing_in_any_frame() -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = LobeTable.make_single_lobe(0.4)
	_view.add_child(Kit.make_sphere(material, 16))
	_environment.panorama = _make({SUN: 2e4, Vector3(0.2, 0.3, 1.0): 1e4})
	await _environment.rebuild()
	var first: Image = await _view.capture()
	var before := first.get_pixel(8, 8)
	assert_float(before.r).is_greater(1.0)
	for frame in FRAMES:
		var now := (await _view.capture() as Image).get_pixel(8, 8)
		assert_float(now.r / before.r).append_failure_message("%d" % frame).is_equal_approx(
			1.0, 0.1
		)
	assert_object(_environment.get_light().sources).is_not_null()


func test_the_sun_of_a_sky_is_lit_once(
	mode: DirectionalLight3D.SkyMode, _test_parameters := MODES
) -> void:
	# As the engine's own materials have it: what the sky shows is reflected once, whether the lamp
	# shines as well or not.
	var environment := _view.camera.environment
	SkyKit.set_sky(environment, "shader")
	(environment.sky.sky_material as ShaderMaterial).shader.code = SHADER
	var sun := SkyKit.make_sun()
	sun.sky_mode = mode
	_view.add_child(sun)
	_environment.size = SIZE
	_environment.max_sources = 0
	await _environment.rebuild()
	var whole := _integral(_faces())
	_environment.max_sources = 4
	await _frames(FRAMES)
	var light := _environment.get_light()
	if mode == DirectionalLight3D.SKY_MODE_LIGHT_ONLY:
		assert_object(light.sources).is_null()
		assert_float(_integral(_faces()).x / whole.x).is_equal_approx(1.0, 0.001)
		return
	assert_object(light.sources).is_not_null()
	var sources: Image = await _read_texture(light.sources)
	var rest := _integral(_faces())
	var energy := _energy(sources, 0)
	assert_float(energy.x).is_greater(0.05 * whole.x)
	assert_float(_energy(sources, 1).length()).is_equal(0.0)
	for channel in 3:
		assert_float((rest + energy)[channel] / whole[channel]).is_equal_approx(1.0, 0.004)
	var angle := _direction(sources, 0).angle_to(sun.global_basis.z)
	assert_float(angle).is_less(0.1 * 0.5 * PI / (2 * SIZE))


func test_a_sun_at_the_corner_of_views_is_one() -> void:
	var environment := _view.camera.environment
	SkyKit.set_sky(environment, "shader")
	(environment.sky.sky_material as ShaderMaterial).shader.code = SHADER
	var sun := SkyKit.make_sun()
	_view.add_child(sun)
	sun.look_at_from_position(Vector3(1.01, 1.0, 0.98), Vector3.ZERO)
	_environment.size = SIZE
	_environment.max_sources = 0
	await _environment.rebuild()
	var whole := _integral(_faces())
	_environment.max_sources = 4
	await _frames(FRAMES)
	var sources: Image = await _read_texture(_environment.get_light().sources)
	var energy := _energy(sources, 0)
	assert_float(_energy(sources, 1).length()).is_equal(0.0)
	assert_float((_integral(_faces()).x + energy.x) / whole.x).is_equal_approx(1.0, 0.004)
	assert_float(_direction(sources, 0).angle_to(sun.global_basis.z)).is_less(0.002)


func test_slices() -> void:
	_environment.update_mode = LobeEnvironment3D.UpdateMode.TIME_SLICED
	_environment.panorama = _make({SUN: 1e5})
	await _frames(4 * FRAMES)
	assert_object(_environment.get_light().sources).is_not_null()


func _frames(count: int) -> void:
	for i in count:
		await RenderingServer.frame_post_draw
