extends GdUnitTestSuite
## A ball that moves through two rooms and out: its picture changes as smoothly as that of a
## reference that traces rays, and a mesh in several rooms is right in each of its pixels.

const Kit := preload("support/render_kit.gd")
const SurfaceMesh := preload("res://demo/meshes/surface_mesh.gd")
const TwoRooms := preload("support/two_rooms.gd")
# Pixels along the picture's sides.
const SIDE := 32
const ALPHA := 0.12
const STEP := 0.01
# Where steps are looked at: from the first room's far end until all is as outside, in metres.
const FROM := -2.1
const TO := 4.7
const EVERY := 0.13
# Of 255, as pixels are shown.
const MOST := 3.0
# Frames until materials do without a light that has left.
const SETTLED := 6

var _view: SubViewport
var _reference_view: SubViewport
var _world: Node3D
var _probes: Array[LobeProbe3D] = []


func before_test() -> void:
	_view = _make_view()
	_view.own_world_3d = true
	add_child(_view)
	_reference_view = _make_view()
	_reference_view.world_3d = _view.find_world_3d()
	add_child(_reference_view)
	_world = Node3D.new()
	_view.add_child(_world)
	TwoRooms.add_scene(_world)


func _make_view() -> SubViewport:
	var view: SubViewport = auto_free(SubViewport.new())
	view.size = SIDE * Vector2i.ONE
	view.use_hdr_2d = true
	view.render_target_update_mode = SubViewport.UPDATE_DISABLED
	return view


func _light() -> void:
	_probes = TwoRooms.add_lights(_world)
	for probe in _probes:
		assert_bool(await probe.rebuild()).is_true()
	# Materials have the light from the next frame on.
	await get_tree().process_frame


# Both pictures as they are shown, from 0 to 1.
func _draw() -> Array[PackedFloat32Array]:
	var shown: Array[PackedFloat32Array] = []
	for view: SubViewport in [_view, _reference_view]:
		view.render_target_update_mode = SubViewport.UPDATE_ONCE
	await RenderingServer.frame_post_draw
	for view: SubViewport in [_view, _reference_view]:
		shown.append(_values(view))
	return shown


static func _values(view: SubViewport) -> PackedFloat32Array:
	var picture := view.get_texture().get_image()
	picture.convert(Image.FORMAT_RGBF)
	var values := picture.get_data().to_float32_array()
	if RenderingServer.get_current_rendering_method() != "gl_compatibility":
		for i in values.size():
			var value := maxf(values[i], 0.0)
			values[i] = (
				12.92 * value if value <= 0.0031308 else 1.055 * pow(value, 1.0 / 2.4) - 0.055
			)
	return values


func test_no_step_shows_more_than_the_reference() -> void:
	var ball := TwoRooms.add_ball(_world, ALPHA)
	var reference := TwoRooms.add_reference(_world, ALPHA)
	var camera := TwoRooms.make_camera(TwoRooms.BALL_LAYER)
	var reference_camera := TwoRooms.make_camera(TwoRooms.REFERENCE_LAYER)
	_view.add_child(camera)
	_reference_view.add_child(reference_camera)
	await _light()
	var worst := 0.0
	var worst_at := 0.0
	var error := 0.0
	var pictures := 0
	var last: Array[PackedFloat32Array] = []
	for index in roundi((TO - FROM) / EVERY) + 1:
		for step in 2:
			var place := TwoRooms.WAY
			place.x = FROM + EVERY * index + STEP * step
			for node: Node3D in [ball, reference]:
				node.position = place
			for node: Node3D in [camera, reference_camera]:
				node.position = place + Vector3(0.0, 0.0, 2.0 * TwoRooms.RADIUS)
			var now := await _draw()
			error += _mean_difference(now[0], now[1])
			pictures += 1
			if step == 1:
				var excess := _most_excess(last, now)
				if excess > worst:
					worst = excess
					worst_at = place.x
			last = now
	error *= 255.0 / pictures
	print(
		(
			(
				"  steps change at most %.2f / 255 more than the reference, at %.2f m; "
				% [255.0 * worst, worst_at]
			)
			+ "mean error %.2f / 255" % error
		)
	)
	assert_float(255.0 * worst).is_less_equal(MOST)
	assert_float(error).is_less(6.0)


static func _mean_difference(a: PackedFloat32Array, b: PackedFloat32Array) -> float:
	var sum := 0.0
	for i in a.size():
		sum += absf(a[i] - b[i])
	return sum / a.size()


# How much more a value has changed in the first picture than in the second.
static func _most_excess(
	before: Array[PackedFloat32Array], now: Array[PackedFloat32Array]
) -> float:
	var most := 0.0
	for i in now[0].size():
		var change := absf(now[0][i] - before[0][i])
		most = maxf(most, change - absf(now[1][i] - before[1][i]))
	return most


# The room that a pixel is in counts, not the one that the mesh's middle is in.
func test_a_mesh_in_two_rooms_is_right_in_each_of_its_pixels() -> void:
	const LONG := 2.4
	var camera := TwoRooms.make_camera(TwoRooms.BALL_LAYER)
	var reference_camera := TwoRooms.make_camera(TwoRooms.REFERENCE_LAYER)
	for view: Node3D in [camera, reference_camera]:
		(view as Camera3D).size = LONG
		view.position = TwoRooms.WAY + Vector3(0.0, 0.0, 0.6)
	_view.add_child(camera)
	_reference_view.add_child(reference_camera)
	var whole := TwoRooms.add_ball(_world, ALPHA)
	var reference := TwoRooms.add_reference(_world, ALPHA)
	for one: MeshInstance3D in [whole, reference]:
		one.mesh = _make_rod(LONG)
	var halves: Array[MeshInstance3D] = []
	for side: float in [-1.0, 1.0]:
		var half := TwoRooms.add_ball(_world, ALPHA)
		half.material_override = whole.material_override
		half.mesh = _make_rod(0.5 * LONG)
		half.position.x = 0.25 * LONG * side
		half.hide()
		halves.append(half)
	await _light()
	var together := await _draw()
	var apart: Array[PackedFloat32Array] = []
	whole.hide()
	for half in halves:
		half.show()
		apart.append((await _draw())[0])
		half.hide()
	# Red minus blue, and how many pixels a half has.
	var warmth: Array[float] = [0.0, 0.0]
	var pixels: Array[int] = [0, 0]
	var most := 0.0
	for i in together[0].size():
		most = maxf(most, absf(together[0][i] - apart[0][i] - apart[1][i]))
		if i % 3 > 0:
			continue
		for side in 2:
			if apart[side][i] > 0.0:
				warmth[side] += apart[side][i] - apart[side][i + 2]
				pixels[side] += 1
	assert_float(255.0 * most).is_less(1.0)
	# Each half shows the room that it is in.
	assert_float(warmth[0] / pixels[0]).is_greater(0.02)
	assert_float(warmth[1] / pixels[1]).is_less(-0.02)
	assert_float(255.0 * _mean_difference(together[0], together[1])).is_less(5.0)


# A rod along x.
static func _make_rod(length: float) -> ArrayMesh:
	return SurfaceMesh.build(
		func(u: float, v: float) -> Transform3D:
			var normal := Vector3(0.0, cos(TAU * v), sin(TAU * v))
			var place := Vector3((u - 0.5) * length, 0.0, 0.0) + 0.25 * normal
			return Transform3D(Basis(Vector3.RIGHT, normal.cross(Vector3.RIGHT), normal), place),
		4,
		48
	)


func test_without_probes_materials_have_no_more_than_their_own_light() -> void:
	var ball := TwoRooms.add_ball(_world, ALPHA)
	var material: LobeMaterial3D = ball.material_override
	var environment := LobeEnvironment3D.new()
	environment.panorama = Kit.constant(1.0)
	_world.add_child(environment)
	await environment.rebuild()
	await _frames(2)
	var code := material.get_shader_code()
	assert_str(code).not_contains("PLACED")
	assert_array(_samplers_of(material)).is_equal(["lobelight_environment", "lobelight_table"])
	var probe := LobeProbe3D.new()
	_world.add_child(probe)
	await probe.rebuild()
	await _frames(2)
	assert_str(material.get_shader_code()).contains("PLACED")
	assert_int(_samplers_of(material).size()).is_greater(2)
	probe.free()
	await _frames(SETTLED)
	assert_str(material.get_shader_code()).is_equal(code)


func _frames(count: int) -> void:
	for frame in count:
		await get_tree().process_frame


# Names of the textures that a material's shader reads, in order.
static func _samplers_of(material: LobeMaterial3D) -> Array[String]:
	var names: Array[String] = []
	var shader := Shader.new()
	shader.code = material.get_shader_code()
	for parameter in RenderingServer.get_shader_parameter_list(shader.get_rid()):
		if parameter["type"] == TYPE_OBJECT:
			names.append(parameter["name"])
	names.sort()
	return names
