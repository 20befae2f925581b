extends GdUnitTestSuite
## A live capture is the scene as a camera at the node sees it.

const Kit := preload("support/render_kit.gd")
const SkyKit := preload("support/sky_kit.gd")
const MODES := LobeEnvironment3D.UpdateMode
const SIDE := 48
const MIDDLE := 24
# Layers of the scene: what is captured, and the mirror that shows it.
const SCENE := 1
const MIRROR := 2
const ELSEWHERE := 4

var _view: LinearViewport
var _sphere: MeshInstance3D
var _environment: LobeEnvironment3D
# Frames in which a capture and the three that follow it are drawn, and some more.
var _captures := 6 * Kit.count_update_frames()


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_view.camera.environment.background_color = Color(0.1, 0.2, 0.4)
	_environment = LobeEnvironment3D.new()
	_environment.source = LobeEnvironment3D.Source.CAPTURE
	_environment.filter = LobeEnvironment3D.Filter.BOX
	_environment.size = 64
	_environment.capture_cull_mask = SCENE
	_view.add_child(_environment)
	_sphere = SkyKit.make_mirror()
	_sphere.layers = MIRROR
	_view.add_child(_sphere)


func after_test() -> void:
	_view.free()


func test_mirror_shows_the_scene() -> void:
	_add_room()
	await _assert_captured(Vector3.ZERO)


func test_from_where_the_node_is() -> void:
	_add_room()
	_environment.position = Vector3(0.7, -0.4, 0.5)
	# The node's turn does not matter.
	_environment.rotation = Vector3(0.3, 1.2, -0.5)
	await _assert_captured(_environment.position)


func test_moving_the_node_is_a_change() -> void:
	var wall := _add_wall(Vector3(0.0, 0.0, 4.0), Color.GREEN)
	wall.scale = Vector3(0.2, 0.2, 0.2)
	await _environment.rebuild()
	var before: Color = await _mirrored()
	assert_float(before.g).is_greater(0.9)
	_environment.position.x = 3.0
	# The capture under way ends before.
	await _frames(2 * Kit.count_update_frames() - 1)
	var after: Color = await _mirrored()
	assert_float(after.g).is_less(0.5)


func test_layers_and_distances() -> void:
	# The camera looks at the sphere's middle from +z, so that is what it mirrors.
	var near := _add_wall(Vector3(0.0, 0.0, 1.5), Color.RED)
	var far := _add_wall(Vector3(0.0, 0.0, 3.0), Color.GREEN)
	_assert_colour(await _captured(), Color.RED)
	_environment.capture_near = 2.0
	_assert_colour(await _captured(), Color.GREEN)
	_environment.capture_near = 0.05
	near.layers = ELSEWHERE
	_assert_colour(await _captured(), Color.GREEN)
	near.layers = SCENE
	near.hide()
	_environment.capture_far = 2.5
	far.show()
	# Nothing but the background.
	var background: Color = await _captured()
	assert_float(background.b).is_greater(background.g)


func test_tone_mapping_and_effects_do_not_count() -> void:
	_add_room()
	await _settle()
	var plain: Color = await _captured()
	var surroundings := _view.camera.environment
	surroundings.tonemap_mode = Environment.TONE_MAPPER_ACES
	surroundings.tonemap_exposure = 4.0
	surroundings.adjustment_enabled = true
	surroundings.adjustment_brightness = 3.0
	await _environment.rebuild()
	surroundings.tonemap_mode = Environment.TONE_MAPPER_LINEAR
	surroundings.tonemap_exposure = 1.0
	surroundings.adjustment_enabled = false
	_assert_colour(await _mirrored(), plain)


func test_mirrors_in_the_scene_show_the_update_before() -> void:
	# A mirror behind the camera mirrors the wall that stands behind the sphere.
	var mirror := _add_wall(Vector3(0.0, 0.0, 3.0), Color.WHITE)
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = LobeTable.make_single_lobe(0.001)
	mirror.material_override = material
	_add_wall(Vector3(0.0, 0.0, -3.0), Color.GREEN)
	_environment.update_mode = MODES.ONCE
	await _environment.rebuild()
	# The first capture saw no light in the mirror, the second what the first one saw.
	var first: Color = await _mirrored()
	await _environment.rebuild()
	var second: Color = await _mirrored()
	_assert_colour(first, Color.BLACK)
	_assert_colour(second, Color.GREEN)


func test_a_closed_room_without_a_lamp_is_dark() -> void:
	_add_lobe_room()
	# Hidden, it captures the room in the neutral light.
	_environment.hide()
	await _settle_lobes()
	assert_float(_mean()).is_greater(0.05)
	_environment.show()
	await _frames(2)
	assert_float(_mean()).is_equal(0.0)
	await _frames(_captures)
	# Nor does the light of another source stay in it.
	_environment.panorama = Kit.constant(1.0)
	for mode: LobeEnvironment3D.UpdateMode in [MODES.WHEN_CHANGED, MODES.TIME_SLICED]:
		_environment.update_mode = mode
		_environment.source = LobeEnvironment3D.Source.PANORAMA
		await _environment.rebuilt
		assert_float(_mean()).is_greater(0.5)
		_environment.source = LobeEnvironment3D.Source.CAPTURE
		await _environment.rebuilt
		assert_float(_mean()).is_equal(0.0)
		await _frames(_captures)


func test_the_first_capture_is_dark_already() -> void:
	_add_lobe_room()
	_environment.hide()
	await _settle_lobes()
	var other := LobeEnvironment3D.new()
	other.source = LobeEnvironment3D.Source.CAPTURE
	other.size = 16
	other.capture_cull_mask = SCENE
	_view.add_child(other)
	_environment.free()
	_environment = other
	await _environment.rebuild()
	assert_float(_mean()).is_equal(0.0)


func test_captures_come_to_what_endless_ones_show() -> void:
	var walls := _add_lobe_room()
	walls[0].emission_enabled = true
	walls[0].emission = Color.WHITE
	await _settle_lobes()
	await _environment.rebuild()
	await _frames(_captures)
	var few := _mean()
	_environment.update_mode = MODES.EVERY_FRAME
	await _frames(24)
	var endless := _mean()
	assert_float(endless).is_greater(0.1)
	assert_float(few / endless).is_between(0.9, 1.0)
	# A lamp that goes out leaves next to nothing.
	_environment.update_mode = MODES.WHEN_CHANGED
	await _frames(_captures)
	walls[0].emission = Color.BLACK
	await _frames(2)
	await _environment.rebuild()
	await _frames(_captures)
	assert_float(_mean() / endless).is_less(0.05)


func test_the_scene_moves_in_every_frame() -> void:
	var wall := _add_wall(Vector3(0.0, 0.0, 3.0), Color.RED)
	_environment.update_mode = MODES.EVERY_FRAME
	await _environment.rebuild()
	_assert_colour(await _mirrored(), Color.RED)
	(wall.material_override as StandardMaterial3D).albedo_color = Color.GREEN
	await RenderingServer.frame_post_draw
	_assert_colour(await _mirrored(), Color.GREEN)


# A room of lit, coloured walls.
func _add_room() -> void:
	var colours := [Color.RED, Color.GREEN, Color.BLUE, Color.YELLOW, Color.CYAN, Color.MAGENTA]
	for i in 6:
		var wall := _add_wall(4.0 * SkyKit.AXES[i], (colours[i] as Color).lerp(Color.WHITE, 0.3))
		var material: StandardMaterial3D = wall.material_override
		material.shading_mode = BaseMaterial3D.SHADING_MODE_PER_PIXEL
		material.roughness = 1.0
		material.metallic_specular = 0.0
	var lamp := OmniLight3D.new()
	lamp.position = Vector3(1.0, 1.5, -1.0)
	lamp.omni_range = 12.0
	lamp.light_energy = 3.0
	_view.add_child(lamp)


# Of grey walls that show the environment's light; their materials.
func _add_lobe_room() -> Array[LobeMaterial3D]:
	_view.camera.environment.background_color = Color.BLACK
	var materials: Array[LobeMaterial3D] = []
	for axis in SkyKit.AXES:
		var wall := _add_wall(4.0 * axis, Color.WHITE)
		var material := LobeMaterial3D.new()
		material.roughness = 0.4
		material.albedo_color = Color(0.6, 0.6, 0.6)
		material.metallic = 0.0
		material.cull_mode = BaseMaterial3D.CULL_DISABLED
		wall.material_override = material
		materials.append(material)
	_environment.size = 16
	return materials


# Until the shaders are there, see _settle.
func _settle_lobes() -> void:
	for i in 500:
		await _environment.rebuild()
		if _mean() > 0.05:
			return


# Of the cube map's texels.
func _mean() -> float:
	var sum := 0.0
	var count := 0
	for face: Image in _environment._live.chain.cube.get_faces():
		for y in face.get_height():
			for x in face.get_width():
				sum += face.get_pixel(x, y).g
				count += 1
	return sum / count


func _frames(count: int) -> void:
	for i in count:
		await RenderingServer.frame_post_draw


# A square wall facing the middle.
func _add_wall(position: Vector3, colour: Color) -> MeshInstance3D:
	var material := StandardMaterial3D.new()
	material.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	material.albedo_color = colour
	material.cull_mode = BaseMaterial3D.CULL_DISABLED
	var mesh := QuadMesh.new()
	mesh.size = Vector2(8.0, 8.0)
	var wall := MeshInstance3D.new()
	wall.mesh = mesh
	wall.material_override = material
	wall.layers = SCENE
	# The camera sees past it.
	_view.camera.cull_mask = MIRROR
	_view.add_child(wall)
	var up := Vector3.UP if absf(position.normalized().y) < 0.9 else Vector3.BACK
	wall.look_at_from_position(position, 2.0 * position, up)
	return wall


func _assert_captured(from: Vector3) -> void:
	await _settle()
	var mirrored: Image = await _view.capture()
	var directions := SkyKit.all_reflected(_view.camera, SIDE)
	_view.size = Vector2i(128, 128)
	_view.camera.cull_mask = SCENE
	var around: Array[Image] = await SkyKit.look_around(_view, from)
	var found := SkyKit.compare(mirrored, directions, around)
	# The room's edges are as sharp as the texels of the map.
	assert_float(found.x).is_greater(0.93)
	assert_float(found.y).is_less(0.03)


# Waits until the engine has compiled its shaders: in Mobile, Mesa's software driver draws lit
# surfaces black with the general ones that stand in until then.
func _settle() -> void:
	for i in 500:
		var colour: Color = await _captured()
		if colour.v > 0.1:
			return


# What the sphere's middle mirrors after another update.
func _captured() -> Color:
	await _environment.rebuild()
	return await _mirrored()


func _mirrored() -> Color:
	var image: Image = await _view.capture()
	return image.get_pixel(MIDDLE, MIDDLE)


func _assert_colour(got: Color, expected: Color) -> void:
	var off := Vector3(got.r - expected.r, got.g - expected.g, got.b - expected.b).abs()
	assert_float(off[off.max_axis_index()]).append_failure_message("%s" % got).is_less(0.01)
