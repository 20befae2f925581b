extends GdUnitTestSuite
## A light that a probe has captured, saved and loaded again, is shown from the first frame on,
## without a capture, and wherever its scene is placed.

const SkyKit := preload("support/sky_kit.gd")

const PATH := "user://baked_probe_test.res"
const SIDE := 48
# Layers: what is captured, and the ball that shows it.
const ROOM := 1
const BALL := 2
const SIZE := Vector3(6, 3, 8)
const ORIGIN := Vector3(0.3, -0.2, 0.5)
# Where the ball is in the room: off the capture point, so that it has a view of its own.
const PLACE := Vector3(1.2, -0.3, 1.0)
const ELSEWHERE := Transform3D(
	Basis(Vector3(0, 0, -1), Vector3(0, 1, 0), Vector3(1, 0, 0)), Vector3(30, -7, 12)
)

var _view: LinearViewport


func after_test() -> void:
	if is_instance_valid(_view):
		_view.free()
	if FileAccess.file_exists(PATH):
		DirAccess.remove_absolute(PATH)


# A world with a ball and a probe in a place of its own; the camera goes along.
func _make_world(place: Transform3D) -> LobeProbe3D:
	if is_instance_valid(_view):
		_view.free()
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_view.camera.transform = place * Transform3D(Basis.IDENTITY, PLACE + Vector3(0, 0, 4))
	_view.camera.cull_mask = BALL
	var parent := Node3D.new()
	parent.transform = place
	_view.add_child(parent)
	var ball := SkyKit.make_mirror()
	ball.layers = BALL
	ball.position = PLACE
	parent.add_child(ball)
	var probe := LobeProbe3D.new()
	probe.size = SIZE
	probe.origin_offset = ORIGIN
	probe.cull_mask = ROOM
	parent.add_child(probe)
	return probe


# Walls that glow in six colours, in stripes.
func _add_walls(parent: Node3D) -> void:
	for index in 6:
		var axis := SkyKit.AXES[index]
		for stripe in 4:
			var mesh := BoxMesh.new()
			var extent := SIZE * (Vector3.ONE - axis.abs()) + 0.01 * axis.abs()
			var along := (axis.abs().max_axis_index() + 1) % 3
			var length := 0.25 * extent[along]
			extent[along] = length
			mesh.size = extent
			var material := StandardMaterial3D.new()
			material.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
			material.albedo_color = _get_colour(index, stripe)
			mesh.material = material
			var wall := MeshInstance3D.new()
			wall.mesh = mesh
			wall.layers = ROOM
			wall.position = 0.5 * SIZE * axis
			wall.position[along] += (stripe - 1.5) * length
			parent.add_child(wall)


func _get_colour(wall: int, stripe: int) -> Color:
	return Color.from_hsv(wall / 6.0, 0.3 + 0.2 * stripe, 0.4 + 0.15 * stripe)


func _capture_live() -> Image:
	var probe := _make_world(Transform3D.IDENTITY)
	_add_walls(probe)
	assert_bool(await probe.rebuild()).is_true()
	var light := probe.get_light()
	assert_str(light.get_problem()).is_empty()
	assert_int(ResourceSaver.save(light, PATH, ResourceSaver.FLAG_COMPRESS)).is_equal(OK)
	return await _view.capture()


func _load_light() -> LobeLight:
	return ResourceLoader.load(PATH, "", ResourceLoader.CACHE_MODE_IGNORE)


func _largest_difference(a: Image, b: Image) -> float:
	var first := a.get_data().to_float32_array()
	var second := b.get_data().to_float32_array()
	var largest := 0.0
	for i in first.size():
		largest = maxf(largest, absf(first[i] - second[i]))
	return largest


# In its middle the ball mirrors the wall behind the camera: what of it is at the ball's own place,
# not what is before the capture point.
func test_the_room_is_mirrored_from_where_the_ball_is() -> void:
	var live := await _capture_live()
	@warning_ignore("integer_division")
	var seen := live.get_pixel(SIDE / 2, SIDE / 2)
	var wanted := _get_colour(4, floori((PLACE.x + 0.5 * SIZE.x) / SIZE.x * 4.0)).srgb_to_linear()
	for channel in 3:
		assert_float(seen[channel]).is_equal_approx(wanted[channel], 0.01)


func test_the_first_frame_is_that_of_the_capture() -> void:
	var live := await _capture_live()
	assert_float(_largest_difference(live, _black())).is_greater(0.5)
	var probe := _make_world(Transform3D.IDENTITY)
	probe.light = _load_light()
	var first: Image = await _view.capture()
	assert_float(_largest_difference(live, first)).is_less(1.0 / 255.0)
	# Nothing else comes later.
	for frame in 4:
		await RenderingServer.frame_post_draw
	assert_float(_largest_difference(live, await _view.capture())).is_less(1.0 / 255.0)


func test_a_scene_takes_its_light_along() -> void:
	var live := await _capture_live()
	var probe := _make_world(ELSEWHERE)
	probe.light = _load_light()
	var first: Image = await _view.capture()
	assert_float(_largest_difference(live, first)).is_less(1.0 / 255.0)


func test_a_light_shared_by_two_worlds_is_shown_by_both() -> void:
	var live := await _capture_live()
	var light := _load_light()
	var probe := _make_world(Transform3D.IDENTITY)
	probe.light = light
	var here := _view
	_view = null
	probe = _make_world(ELSEWHERE)
	probe.light = light
	assert_float(_largest_difference(live, await _view.capture())).is_less(1.0 / 255.0)
	assert_float(_largest_difference(live, await here.capture())).is_less(1.0 / 255.0)
	here.free()


func test_a_capture_leaves_the_lights_of_other_probes_alone() -> void:
	var probe := _make_world(Transform3D.IDENTITY)
	_add_walls(probe)
	var probes: Array[LobeProbe3D] = [probe]
	for index in 5:
		var other := LobeProbe3D.new()
		other.size = SIZE
		other.origin_offset = Vector3(0.4 * index - 1.0, 0.5, -2.0)
		other.cull_mask = ROOM
		probe.get_parent().add_child(other)
		probes.append(other)
	var before: Array[PackedByteArray] = []
	for each in probes:
		assert_bool(await each.rebuild()).is_true()
		before.append(each.get_light().faces[4].get_data())
	for index in probes.size():
		assert_bool(probes[index].get_light().faces[4].get_data() == before[index]).is_true()
		assert_bool(before[index] == before[index - 1]).is_false()


# As when a bake is cancelled: the room has other walls by now, but the light is the saved one.
func test_a_capture_that_is_given_up_leaves_the_baked_light() -> void:
	var live := await _capture_live()
	var probe := _make_world(Transform3D.IDENTITY)
	probe.light = _load_light()
	assert_bool(await probe.rebuild()).is_true()
	assert_float(_largest_difference(live, await _view.capture())).is_greater(0.2)
	probe.light = probe.light
	assert_float(_largest_difference(live, await _view.capture())).is_less(1.0 / 255.0)


# Without a material nobody needs the lights, but a bake does.
func test_a_room_without_lobe_materials_is_captured_too() -> void:
	var probe := _make_world(Transform3D.IDENTITY)
	_add_walls(probe)
	for ball: MeshInstance3D in probe.get_parent().find_children(
		"*", "MeshInstance3D", false, false
	):
		ball.free()
	assert_bool(await probe.rebuild()).is_true()
	assert_object(probe.get_light()).is_not_null()


func _black() -> Image:
	return Image.create_empty(SIDE, SIDE, false, Image.FORMAT_RGBAF)
