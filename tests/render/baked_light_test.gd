extends GdUnitTestSuite
## A light that was baked for an environment is shown from the first drawn frame on, as the live one
## would look, and nothing is drawn for it.

const Kit := preload("support/render_kit.gd")
const PyramidChain := preload("res://addons/lobelight/runtime/pyramid/pyramid_chain.gd")
const Pyramid := preload("res://addons/lobelight/runtime/pyramid/pyramid.gd")
const SkyKit := preload("support/sky_kit.gd")

const PATH := "user://baked_light_test.res"
const SCENE := "user://baked_light_test.tscn"
const SIDE := 32
const MIDDLE := 16
const TEXELS := 32
const TURN := Basis(Vector3(0.6, 0.0, 0.8), Vector3(0.0, 1.0, 0.0), Vector3(-0.8, 0.0, 0.6))
const ENERGY := 0.75
# Half floats, and a frame buffer of them.
const NEAR := 1.0 / 255.0
# A frame shows the light that came before it, and lights that leave stay for some frames.
const SETTLED := 6

var _view: LinearViewport


func before_test() -> void:
	_view = _make_view()


func after_test() -> void:
	_view.free()
	for path: String in [PATH, SCENE]:
		if FileAccess.file_exists(path):
			DirAccess.remove_absolute(path)
	await _frames(SETTLED)


# Which faces a material shows goes by its narrowest lobes, also when these change.
func test_wide_lobes_show_the_coarse_part() -> void:
	var light := LobeLight.make_constant(Color.WHITE, true)
	light.coarse = LobeLight.make_constant(Color.WHITE, true)
	var material := LobeMaterial3D.new()
	material.light = light
	material.roughness = 0.05
	material.update_now()
	_assert_shows(material, light)
	material.roughness = 0.6
	material.update_now()
	_assert_shows(material, light.coarse)
	material.clearcoat_enabled = true
	material.clearcoat_roughness = 0.1
	material.update_now()
	_assert_shows(material, light)
	material.clearcoat_enabled = false
	material.update_now()
	_assert_shows(material, light.coarse)
	# Widths that move may become any.
	for roughness: float in [0.5, 0.55]:
		material.roughness = roughness
		material.update_now()
	_assert_shows(material, light)


func test_the_first_drawn_frame_is_that_of_the_live_light() -> void:
	var panorama := Kit.make_panorama(32, SkyKit.radiance)
	var live := _make_live(panorama)
	_view.add_child(live)
	assert_bool(await live.rebuild()).is_true()
	var expected := await _view.capture()
	assert_int(ResourceSaver.save(await _bake(panorama), PATH)).is_equal(OK)
	live.free()
	_view.free()
	await _frames(SETTLED)

	# A scene as the game loads it.
	var environment := LobeEnvironment3D.new()
	environment.basis = TURN
	environment.energy = ENERGY
	environment.light = load(PATH)
	var packed := PackedScene.new()
	packed.pack(environment)
	environment.free()
	assert_int(ResourceSaver.save(packed, SCENE)).is_equal(OK)
	packed = ResourceLoader.load(SCENE, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP)
	var place := _get_free_place()
	_view = _make_view()
	var after_view := _get_free_place()
	environment = packed.instantiate()
	_view.add_child(environment)
	var first := await _view.capture()
	assert_float(_largest_difference(first, expected)).is_less(NEAR)
	assert_float(_largest_difference(first, _black())).is_greater(0.3)
	await _frames(10)
	assert_array(Array((await _view.capture()).get_data())).is_equal(Array(first.get_data()))
	# No viewport draws for it, unlike for the live one.
	assert_object(environment._live).is_null()
	assert_int(_get_free_place()).is_equal(after_view)
	assert_int(environment.get_sliced_frames()).is_equal(0)
	assert_int(environment.update_frames).is_equal(0)
	live = _make_live(panorama)
	_view.add_child(live)
	await live.rebuild()
	assert_int(_get_free_place()).is_not_equal(after_view)
	assert_int(place).is_not_equal(after_view)


func test_a_node_turns_the_light_of_a_panorama_but_not_that_of_a_sky() -> void:
	var light := await _bake(Kit.make_panorama(32, SkyKit.radiance))
	var environment := LobeEnvironment3D.new()
	environment.light = light
	_view.add_child(environment)
	var straight := await _view.capture()
	environment.basis = TURN
	var turned := await _view.capture()
	assert_float(_largest_difference(straight, turned)).is_greater(0.05)
	light = light.at_another_place()
	light.axes = TURN
	light.is_of_world = true
	light.base_energy = 2.0
	environment.light = light
	environment.basis = Basis.IDENTITY
	environment.energy = 0.5
	assert_float(_largest_difference(await _view.capture(), turned)).is_less(NEAR)
	environment.basis = Basis(Vector3.RIGHT, 1.0)
	assert_float(_largest_difference(await _view.capture(), turned)).is_less(NEAR)
	# In a material of its own, as well.
	environment.hide()
	light.base_energy = 1.0
	var material: LobeMaterial3D = _find_material()
	material.light = light
	assert_float(_largest_difference(await _view.capture(), turned)).is_less(NEAR)


func test_live_and_baked_light_take_turns_without_a_flash() -> void:
	var environment := LobeEnvironment3D.new()
	environment.light = LobeLight.make_constant(Color(0.25, 0.25, 0.25), true)
	environment.panorama = Kit.constant(1.0)
	environment.size = 8
	_view.add_child(environment)
	assert_float(await _see()).is_equal_approx(0.25, 0.01)
	environment.light = null
	var seen: Array[float] = []
	for frame in SETTLED:
		seen.append(await _see())
	for value in seen:
		assert_bool(absf(value - 0.25) < 0.01 or absf(value - 1.0) < 0.01).is_true()
	assert_float(seen.back()).is_equal_approx(1.0, 0.01)
	# The other way round, and from one to another, there is nothing to wait for.
	for value: float in [0.25, 0.5, 2.0]:
		environment.light = LobeLight.make_constant(Color(value, value, value), true)
		assert_float(await _see()).is_equal_approx(value, 0.01)
	assert_object(environment._live).is_null()


func test_baked_lights_fade() -> void:
	var environment := LobeEnvironment3D.new()
	environment.light = LobeLight.make_constant(Color(0.25, 0.25, 0.25), true)
	environment.fade_time = 0.3
	_view.add_child(environment)
	assert_float(await _see()).is_equal_approx(0.25, 0.01)
	environment.light = LobeLight.make_constant(Color.WHITE, true)
	var seen: Array[float] = [await _see()]
	while seen.back() < 0.99 and seen.size() < 200:
		seen.append(await _see())
		assert_float(seen[-1]).is_greater_equal(seen[-2] - 0.005)
	assert_float(seen[0]).is_less(0.9)
	assert_bool(seen.any(func(value: float) -> bool: return value > 0.3 and value < 0.9)).is_true()


func test_two_worlds_show_their_own_in_the_first_frame() -> void:
	var other := _make_view()
	var values: Array[float] = [0.25, 1.0]
	var views: Array[LinearViewport] = [_view, other]
	for i in 2:
		var environment := LobeEnvironment3D.new()
		var colour := Color(values[i], values[i], values[i])
		environment.light = LobeLight.make_constant(colour, true)
		views[i].add_child(environment)
	for view in views:
		view.render_target_update_mode = SubViewport.UPDATE_ONCE
	await RenderingServer.frame_post_draw
	for i in 2:
		var image := await views[i].capture()
		assert_float(image.get_pixel(MIDDLE, MIDDLE).r).is_equal_approx(values[i], 0.01)
	other.free()


func test_shown_and_hidden_and_freed() -> void:
	var first := LobeEnvironment3D.new()
	first.light = LobeLight.make_constant(Color.WHITE, true)
	_view.add_child(first)
	var second := LobeEnvironment3D.new()
	second.light = LobeLight.make_constant(Color(0.25, 0.25, 0.25), true)
	second.visible = false
	_view.add_child(second)
	assert_float(await _see()).is_equal_approx(1.0, 0.01)
	second.show()
	assert_float(await _see()).is_equal_approx(1.0, 0.01)
	first.hide()
	assert_float(await _see()).is_equal_approx(0.25, 0.01)
	first.show()
	assert_float(await _see()).is_equal_approx(1.0, 0.01)
	first.free()
	# The other one's turn comes with the next message.
	await _frames(1)
	assert_float(await _see()).is_equal_approx(0.25, 0.01)


func test_a_damaged_light_leaves_the_live_one() -> void:
	var light := await _bake(Kit.make_panorama(32, SkyKit.radiance))
	light.base_energy = NAN
	var environment := LobeEnvironment3D.new()
	environment.panorama = Kit.constant(0.5)
	environment.size = 8
	_view.add_child(environment)
	var give := func() -> void: environment.light = light
	await assert_error(give).is_push_error("LobeEnvironment3D: Light: " + light.get_problem())
	assert_bool(await environment.rebuild()).is_true()
	assert_float(await _see()).is_equal_approx(0.5, 0.01)
	# One that is mended in place is shown.
	light.base_energy = 1.0
	light.emit_changed()
	assert_float(absf(await _see() - 0.5)).is_greater(0.05)


func _assert_shows(material: LobeMaterial3D, light: LobeLight) -> void:
	var shown: RID = RenderingServer.material_get_param(
		material.get_rid(), &"lobelight_environment"
	)
	assert_bool(shown == light.cubemap.get_rid()).is_true()


func _make_view() -> LinearViewport:
	var view := LinearViewport.new(SIDE)
	add_child(view)
	view.add_child(SkyKit.make_mirror())
	return view


func _find_material() -> LobeMaterial3D:
	var ball: MeshInstance3D = _view.find_children("*", "MeshInstance3D", false, false)[0]
	return (ball.mesh as SphereMesh).material


func _make_live(panorama: Texture2D) -> LobeEnvironment3D:
	var live := LobeEnvironment3D.new()
	live.basis = TURN
	live.energy = ENERGY
	live.panorama = panorama
	live.size = TEXELS
	return live


# A light with the faces that the GPU draws.
func _bake(panorama: Texture2D) -> LobeLight:
	var chain := PyramidChain.new()
	chain.pyramid.set_up_panorama(panorama, TEXELS, Pyramid.Filter.DISC)
	chain.make_cube()
	chain.draw(-1)
	await RenderingServer.frame_post_draw
	assert_bool(chain.receive(-1)).is_true()
	var light := LobeLight.new()
	light.faces = chain.cube.get_faces()
	light.size = TEXELS
	light.level_variance = Pyramid.LEVEL_VARIANCES[Pyramid.Filter.DISC]
	light.base_variance = chain.pyramid.level_0_variance
	light.is_even = true
	return light


# The place that the server's next viewport gets in its table: another one for each that there is.
func _get_free_place() -> int:
	var viewport := RenderingServer.viewport_create()
	var place := viewport.get_id() & 0xFFFFFFFF
	RenderingServer.free_rid(viewport)
	return place


# What the mirror shows in its middle, in the next frame.
func _see() -> float:
	return (await _view.capture()).get_pixel(MIDDLE, MIDDLE).r


func _frames(count: int) -> void:
	for frame in count:
		await RenderingServer.frame_post_draw


func _largest_difference(a: Image, b: Image) -> float:
	var first := a.get_data().to_float32_array()
	var second := b.get_data().to_float32_array()
	var largest := 0.0
	for i in first.size():
		largest = maxf(largest, absf(first[i] - second[i]))
	return largest


func _black() -> Image:
	return Image.create_empty(SIDE, SIDE, false, Image.FORMAT_RGBAF)
