extends GdUnitTestSuite
## Scenes and lights change without a flash: each frame shows the old light or the new one, or what
## lies between them while they fade.

const Kit := preload("support/render_kit.gd")
const NeutralLight := preload("res://addons/lobelight/runtime/light/neutral_light.gd")
const SkyKit := preload("support/sky_kit.gd")
const SIDE := 8
const MIDDLE := 4
const FADE_TIME := 0.4
const NEW_SCENE := "user://light_changes_test.tscn"

var _view: LinearViewport
var _material: LobeMaterial3D
var _window_size: Vector2i
# What the window showed in each frame.
var _shown: Array[Color] = []


func before() -> void:
	# Frames take as long as the window takes to be shown.
	_window_size = get_window().size
	get_window().size = Vector2i(64, 64)


func after() -> void:
	get_window().size = _window_size


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_view.add_child(_make_mirror())


func after_test() -> void:
	_view.free()
	if FileAccess.file_exists(NEW_SCENE):
		DirAccess.remove_absolute(NEW_SCENE)


func test_a_new_node_takes_over_without_a_flash() -> void:
	var light := _add_light(0.25)
	await _until(0.25)
	for turn in 4:
		var before := 0.25 if turn % 2 == 0 else 1.0
		var after := 1.25 - before
		# At once, within the same frame, and some frames later.
		light.free()
		await _frames(maxi(turn - 1, 0))
		light = _add_light(after, 128 if turn == 2 else 8)
		var seen := await _watch(5 + Kit.count_update_frames())
		_assert_turns(seen, before, after)


func test_a_sky_takes_over_without_a_flash() -> void:
	var light := _add_light(0.25)
	await _until(0.25)
	light.free()
	_view.camera.environment.background_color = Color.WHITE
	light = LobeEnvironment3D.new()
	light.source = LobeEnvironment3D.Source.SKY
	light.size = 16
	_view.add_child(light)
	_assert_turns(await _watch(5 + Kit.count_update_frames()), 0.25, 1.0)
	light.free()
	_add_light(0.25)
	_assert_turns(await _watch(5 + Kit.count_update_frames()), 1.0, 0.25)


func test_the_scene_of_the_tree_changes_without_a_flash() -> void:
	var camera := Camera3D.new()
	camera.position.z = 4.0
	camera.set_orthogonal(2.0, 0.1, 10.0)
	camera.environment = _view.camera.environment
	get_tree().root.add_child(camera)
	var mirror := _make_mirror()
	get_tree().root.add_child(mirror)
	camera.make_current()
	var scene := Node3D.new()
	var light := _make_light(1.0)
	scene.add_child(light)
	light.owner = scene
	var packed := PackedScene.new()
	packed.pack(scene)
	light.panorama = Kit.constant(0.25)
	var first := PackedScene.new()
	first.pack(scene)
	scene.free()
	ResourceSaver.save(packed, NEW_SCENE)
	get_tree().change_scene_to_packed(first)
	await _frames(8)
	_shown.clear()
	RenderingServer.frame_post_draw.connect(_look_at_window)
	await _frames(2)
	get_tree().change_scene_to_file(NEW_SCENE)
	await _frames(7 + Kit.count_update_frames())
	RenderingServer.frame_post_draw.disconnect(_look_at_window)
	# Encoded or not, as the project has its window.
	var values: Array[float] = []
	for colour in _shown:
		values.append(colour.g)
	assert_float(values[0]).is_between(0.2, 0.6)
	_assert_turns(values, values[0], 1.0)
	get_tree().unload_current_scene()
	mirror.free()
	camera.free()
	await _frames(6)


func test_what_has_left_for_good_gives_way_to_the_neutral_light() -> void:
	var light := _add_light(2.0)
	await _until(2.0)
	light.hide()
	var neutral := NeutralLight.radiance(Vector3.BACK).g
	var seen := await _watch(8)
	_assert_turns(seen, 2.0, neutral, 0.1)
	# And back.
	light.show()
	_assert_turns(await _watch(4), neutral, 2.0, 0.1)


func test_an_environment_that_fails_keeps_no_old_light() -> void:
	var light := _add_light(2.0)
	await _until(2.0)
	light.free()
	light = _add_light(1.0)
	light.panorama = null
	var seen := await _watch(8)
	assert_float(seen.back()).is_equal_approx(NeutralLight.radiance(Vector3.BACK).g, 0.1)


func test_a_fade_goes_from_one_to_the_other() -> void:
	var light := _add_light(0.25)
	await _until(0.25)
	var plain := _material.get_shader_code()
	light.free()
	light = _make_light(1.0)
	light.fade_time = FADE_TIME
	_view.add_child(light)
	_assert_fades(await _watch_fade(plain), 0.25, 1.0)
	assert_str(_material.get_shader_code()).is_equal(plain)
	# Another light of the same node.
	light.panorama = Kit.constant(0.5)
	_assert_fades(await _watch_fade(plain), 1.0, 0.5)
	assert_str(_material.get_shader_code()).is_equal(plain)
	# Back to one that was there before, which is the active one again.
	var second := _make_light(2.0)
	second.fade_time = FADE_TIME
	_view.add_child(second)
	light.hide()
	_assert_fades(await _watch_fade(plain), 0.5, 2.0)
	light.show()
	_assert_fades(await _watch_fade(plain), 2.0, 0.5)


func test_a_fade_into_the_next_goes_on() -> void:
	var light := _add_light(0.25)
	light.fade_time = FADE_TIME
	await _until(0.25)
	var plain := _material.get_shader_code()
	light.panorama = Kit.constant(1.0)
	var seen: Array[float] = []
	while seen.is_empty() or seen.back() < 0.4:
		seen.append_array(await _watch(1))
	light.panorama = Kit.constant(4.0)
	seen.append_array(await _watch_fade(plain))
	# All the way up, and never by a jump to what the first fade would have come to.
	for i in range(1, seen.size()):
		assert_float(seen[i]).is_greater_equal(seen[i - 1] - 0.005)
	assert_float(seen.back()).is_equal_approx(4.0, 0.01)


func _make_mirror() -> MeshInstance3D:
	var mirror := SkyKit.make_mirror()
	_material = (mirror.mesh as SphereMesh).material
	return mirror


func _make_light(value: float, size := 8) -> LobeEnvironment3D:
	var light := LobeEnvironment3D.new()
	light.source = LobeEnvironment3D.Source.PANORAMA
	light.panorama = Kit.constant(value)
	light.size = size
	return light


func _add_light(value: float, size := 8) -> LobeEnvironment3D:
	var light := _make_light(value, size)
	_view.add_child(light)
	return light


func _look_at_window() -> void:
	var image := get_tree().root.get_texture().get_image()
	_shown.append(image.get_pixelv(image.get_size() / 2))


# What the mirror shows in the next frames.
func _watch(count: int) -> Array[float]:
	var seen: Array[float] = []
	for i in count:
		var image: Image = await _view.capture()
		seen.append(image.get_pixel(MIDDLE, MIDDLE).g)
	return seen


# The same until the shader is what it was, and some frames more.
func _watch_fade(plain: String, most := 2000) -> Array[float]:
	var seen: Array[float] = await _watch(2 + Kit.count_update_frames())
	for i in most:
		if _material.get_shader_code() == plain:
			break
		seen.append_array(await _watch(1))
	seen.append_array(await _watch(2))
	return seen


func _until(value: float) -> void:
	for i in 100:
		var seen := await _watch(1)
		if absf(seen[0] - value) < 0.01:
			return
	fail("The light does not come.")


# That the old light is followed by the new one, and there is nothing else.
func _assert_turns(seen: Array[float], before: float, after: float, allowed := 0.01) -> void:
	var has_changed := false
	for value in seen:
		has_changed = has_changed or absf(value - before) > allowed
		assert_float(value).append_failure_message("%s" % [seen]).is_equal_approx(
			after if has_changed else before, allowed
		)
	assert_bool(has_changed).append_failure_message("%s" % [seen]).is_true()


func _assert_fades(seen: Array[float], before: float, after: float) -> void:
	var told := "%s" % [seen]
	var between := 0
	for i in seen.size():
		assert_float(seen[i]).append_failure_message(told).is_between(
			minf(before, after) - 0.005, maxf(before, after) + 0.005
		)
		if i > 0:
			var step := (seen[i] - seen[i - 1]) * signf(after - before)
			assert_float(step).append_failure_message(told).is_greater_equal(-0.005)
		between += int(absf(seen[i] - before) > 0.02 and absf(seen[i] - after) > 0.02)
	assert_int(between).append_failure_message(told).is_greater(2)
	assert_float(seen.back()).append_failure_message(told).is_equal_approx(after, 0.005)


func _frames(count: int) -> void:
	for i in count:
		await RenderingServer.frame_post_draw
