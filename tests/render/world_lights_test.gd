extends GdUnitTestSuite
## Worlds that share one material show their own lights, as they and their cameras come and go.

const Kit := preload("support/render_kit.gd")
const LightRegistry := preload("res://addons/lobelight/runtime/light/light_registry.gd")
const SkyKit := preload("support/sky_kit.gd")
const SIDE := 8
const MIDDLE := 4
# Where each world is in VALUES.
const VALUES: PackedFloat32Array = [0.25, 1.0, 2.0, 3.0, 4.0]
# A frame shows the light that came before it, and lights that leave stay for some frames.
const SETTLED := 6

var _mesh: Mesh
var _views: Array[LinearViewport] = []
var _lights: Array[LobeEnvironment3D] = []
var _window_size: Vector2i


func before() -> void:
	# Frames take as long as the window takes to be shown.
	_window_size = get_window().size
	get_window().size = Vector2i(64, 64)


func after() -> void:
	get_window().size = _window_size


func before_test() -> void:
	var mirror := SkyKit.make_mirror()
	_mesh = mirror.mesh
	mirror.free()


func after_test() -> void:
	while not _views.is_empty():
		_remove_world(0)
	_mesh = null
	await _frames(SETTLED)


func test_worlds_show_their_own_lights() -> void:
	for count: int in [1, 2, 3, 4]:
		_add_world(count - 1)
		await _frames(SETTLED)
		for i in count:
			await _assert_shows(i, VALUES[i])
	# One in the middle leaves, and the others stay what they are.
	_remove_world(1)
	var left: PackedFloat32Array = [VALUES[0], VALUES[2], VALUES[3]]
	for i in 3:
		await _assert_shows(i, left[i])
	# The first one too, whose light all materials had as theirs.
	_remove_world(0)
	await _frames(SETTLED)
	await _assert_shows(0, VALUES[2])
	await _assert_shows(1, VALUES[3])
	assert_str(_code()).contains("PLACED")
	# Nobody pays for worlds when there is one.
	_remove_world(0)
	await _frames(SETTLED)
	await _assert_shows(0, VALUES[3])
	assert_str(_code()).not_contains("PLACED")
	assert_object(LightRegistry.get_placed()).is_null()


func test_a_second_light_flashes_in_neither_world() -> void:
	_add_world(0)
	await _frames(SETTLED)
	_add_world(1)
	for i in SETTLED:
		await _assert_shows(0, VALUES[0])
	await _assert_shows(1, VALUES[1])
	# Nor does it when it has gone.
	_lights[1].hide()
	for i in SETTLED:
		await _assert_shows(0, VALUES[0])
	await _assert_shows(1, VALUES[0])


func test_lights_are_turned_and_dimmed_in_their_worlds_only() -> void:
	_add_world(0)
	_add_world(1)
	await _frames(SETTLED)
	_lights[1].energy = 0.5
	await _assert_shows(1, 0.5 * VALUES[1])
	await _assert_shows(0, VALUES[0])
	_lights[0].energy = 3.0
	await _assert_shows(0, 3.0 * VALUES[0])
	await _assert_shows(1, 0.5 * VALUES[1])


func test_a_sky_s_energy_shows_at_once() -> void:
	_add_world(0)
	_add_world(1)
	var surroundings := _views[1].camera.environment
	SkyKit.set_sky(surroundings, "panorama")
	(surroundings.sky.sky_material as PanoramaSkyMaterial).panorama = Kit.constant(0.8)
	_lights[1].source = LobeEnvironment3D.Source.SKY
	await _frames(SETTLED)
	# Compatibility draws the sky anew, which takes a frame.
	for energy: float in [0.5, 1.0, 0.25]:
		surroundings.background_energy_multiplier = energy
		if LinearViewport.is_compatibility():
			await _frames(1)
		else:
			await _assert_shows(1, 0.8 * energy)
		await _assert_shows(0, VALUES[0])


func test_cameras_change_their_masks() -> void:
	_add_world(0)
	_add_world(1)
	await _frames(SETTLED)
	for mask: int in [1, 0xFFFFF, 0xFFFFFFFF, 0xF00001]:
		for view in _views:
			view.camera.cull_mask = mask
		for i in 2:
			await _assert_shows(i, VALUES[i])
			# The node does not know.
			assert_int(_views[i].camera.cull_mask).is_equal(mask)


func test_cameras_that_come_later() -> void:
	_add_world(0)
	_add_world(1)
	await _frames(SETTLED)
	var later := Camera3D.new()
	later.set_orthogonal(2.0, 0.1, 10.0)
	later.environment = _views[1].camera.environment
	later.position.z = 4.0
	_views[1].add_child(later)
	later.make_current()
	await _assert_shows(1, VALUES[1])
	# It goes to the other world and back to the first camera there.
	_views[1].remove_child(later)
	_views[0].add_child(later)
	later.make_current()
	await _assert_shows(0, VALUES[0])
	await _assert_shows(1, VALUES[1])
	later.free()
	await _assert_shows(0, VALUES[0])


func test_a_scene_moves_to_another_world() -> void:
	_add_world(0)
	_add_world(1)
	await _frames(SETTLED)
	var mirror := _views[1].get_node("Mirror")
	_views[1].remove_child(mirror)
	_views[0].get_node("Mirror").free()
	_views[0].add_child(mirror)
	await _assert_shows(0, VALUES[0])


func test_captures_see_their_own_world() -> void:
	_add_world(0)
	_add_world(1)
	# A camera of a capture in the second world, with a mirror before it.
	_views[1].get_node("Mirror").position.x = 20.0
	var panel := MeshInstance3D.new()
	panel.mesh = BoxMesh.new()
	panel.mesh.size = Vector3(8.0, 8.0, 0.1)
	panel.mesh.material = (_mesh as SphereMesh).material
	panel.position.z = -3.0
	panel.layers = 2
	_views[1].add_child(panel)
	await _frames(SETTLED)
	var capture := LobeEnvironment3D.new()
	capture.source = LobeEnvironment3D.Source.CAPTURE
	capture.size = 16
	capture.filter = LobeEnvironment3D.Filter.BOX
	capture.capture_cull_mask = 2
	_views[1].add_child(capture)
	assert_bool(await capture.rebuild()).is_true()
	var back: Color = capture._live.chain.cube.get_faces()[5].get_pixel(8, 8)
	assert_float(back.g).is_equal_approx(VALUES[1], 0.05)


func test_a_world_with_no_light_of_its_own_shows_the_first() -> void:
	_add_world(0)
	_add_world(1)
	_add_world(2)
	_lights[2].hide()
	await _frames(SETTLED)
	await _assert_shows(2, VALUES[0])


func test_rooms_are_in_their_own_world() -> void:
	_add_world(0)
	_add_world(1)
	_lights[1].hide()
	await _frames(SETTLED)
	var light := LobeLight.new()
	var faces: Array[Image] = []
	for i in 6:
		faces.append(Image.create_empty(1, 1, false, Image.FORMAT_RGBAH))
		faces[i].fill(Color(VALUES[3], VALUES[3], VALUES[3]))
	light.faces = faces
	var probe := LobeProbe3D.new()
	probe.light = light
	_views[0].add_child(probe)
	await _assert_shows(0, VALUES[3])
	await _assert_shows(1, VALUES[0])
	# As in a world that comes later, and with any camera mask.
	_add_world(2)
	_lights[2].hide()
	await _frames(1)
	await _assert_shows(2, VALUES[0])
	_views[0].camera.cull_mask = 0xFFFFFFFF
	await _assert_shows(0, VALUES[3])
	# A light of its own changes nothing for the other.
	_lights[1].show()
	await _frames(SETTLED)
	await _assert_shows(0, VALUES[3])
	await _assert_shows(1, VALUES[1])


func test_a_fifth_world_shows_the_first_one_s_light() -> void:
	for i in 5:
		_add_world(i)
	await _frames(SETTLED)
	for i in 4:
		await _assert_shows(i, VALUES[i])
	await _assert_shows(4, VALUES[0])


func _add_world(index: int) -> void:
	var view := LinearViewport.new(SIDE)
	add_child(view)
	_views.append(view)
	var mirror := MeshInstance3D.new()
	mirror.name = "Mirror"
	mirror.mesh = _mesh
	view.add_child(mirror)
	var light := LobeEnvironment3D.new()
	light.source = LobeEnvironment3D.Source.PANORAMA
	light.panorama = Kit.constant(VALUES[index])
	light.size = 8
	# Levels of two kinds.
	light.filter = (
		LobeEnvironment3D.Filter.DISC if index % 2 == 0 else LobeEnvironment3D.Filter.BINOMIAL
	)
	_lights.append(light)
	view.add_child(light)


func _remove_world(index: int) -> void:
	_views[index].free()
	_views.remove_at(index)
	_lights.remove_at(index)


func _code() -> String:
	return ((_mesh as SphereMesh).material as LobeMaterial3D).get_shader_code()


func _assert_shows(index: int, expected: float) -> void:
	var image: Image = await _views[index].capture()
	var got := image.get_pixel(MIDDLE, MIDDLE).g
	assert_float(got).append_failure_message("world %d" % index).is_equal_approx(expected, 0.01)


func _frames(count: int) -> void:
	for i in count:
		await RenderingServer.frame_post_draw
