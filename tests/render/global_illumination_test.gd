extends GdUnitTestSuite
## VoxelGI, which Forward+ has: it does not light a LobeMaterial3D whose environment lights it
## already, and what a LobeMaterial3D reflects does not light the scene again.

const Kit := preload("support/render_kit.gd")
const SIDE := 48
const BRIGHT := 4.0
# Pixels of the ball, and of the floor before it.
const BALL := Rect2i(19, 19, 10, 10)
const BESIDE := Rect2i(14, 35, 20, 6)

var _view: LinearViewport
var _floor_material := StandardMaterial3D.new()
var _ball: MeshInstance3D


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	_view.camera.set_perspective(50.0, 0.1, 20.0)
	_view.camera.look_at_from_position(Vector3(0.0, 1.2, 3.6), Vector3(0.0, 0.1, 0.0))
	add_child(_view)
	_add_box(Vector3(4.0, 0.4, 4.0), Vector3(0.0, -0.8, 0.0), _floor_material)
	_ball = Kit.make_sphere(null, 48)
	_ball.scale = 0.6 * Vector3.ONE
	_ball.gi_mode = GeometryInstance3D.GI_MODE_STATIC
	_view.add_child(_ball)


func after_test() -> void:
	_view.free()


func test_no_light_twice() -> void:
	# In the other renderers neither material may change, as there is nothing that could light them.
	var has_voxels := RenderingServer.get_current_rendering_method() == "forward_plus"
	var environment := LobeEnvironment3D.new()
	environment.panorama = Kit.constant(BRIGHT)
	_view.add_child(environment)
	await environment.rebuild()
	var lobes := LobeMaterial3D.new()
	lobes.roughness = 0.4
	lobes.metallic = 0.5
	lobes.diffuse_light = LobeMaterial3D.DiffuseLight.ENVIRONMENT
	var lamp := StandardMaterial3D.new()
	lamp.emission_enabled = true
	lamp.emission = Color.WHITE
	lamp.emission_energy_multiplier = BRIGHT
	var black := StandardMaterial3D.new()
	black.albedo_color = Color.BLACK
	black.metallic_specular = 0.0

	# What the ball sends to the floor.
	_ball.material_override = lobes
	var plain := await _mean_of(BALL, false)
	var beside := await _mean_of(BESIDE, has_voxels)
	_ball.material_override = black
	var beside_black := await _mean_of(BESIDE, has_voxels)
	_ball.material_override = lamp
	var beside_lamp := await _mean_of(BESIDE, has_voxels)
	var figures := "%f, black %f, lamp %f" % [beside, beside_black, beside_lamp]
	if has_voxels:
		assert_float(beside_lamp).append_failure_message(figures).is_greater(beside_black + 0.02)
	assert_float(beside).append_failure_message(figures).is_equal_approx(beside_black, 0.002)

	# What a lamp sends to the ball.
	var wall := _add_box(Vector3(0.4, 3.0, 3.0), Vector3(-1.4, 0.4, 0.0), lamp)
	_ball.material_override = black
	black.albedo_color = Color.WHITE
	var white := await _mean_of(BALL, has_voxels)
	_ball.material_override = lobes
	var lit := await _mean_of(BALL, has_voxels)
	wall.free()
	assert_float(plain).is_greater(0.5)
	figures = "%f, without %f, Godot's %f" % [lit, plain, white]
	if has_voxels:
		assert_float(white).append_failure_message(figures).is_greater(0.02)
	assert_float(lit).append_failure_message(figures).is_equal_approx(plain, 0.01 * plain)


func _add_box(size: Vector3, at: Vector3, material: Material) -> MeshInstance3D:
	var box := MeshInstance3D.new()
	var mesh := BoxMesh.new()
	mesh.size = size
	box.mesh = mesh
	box.position = at
	box.material_override = material
	box.gi_mode = GeometryInstance3D.GI_MODE_STATIC
	_view.add_child(box)
	return box


# Of the green channel over a part of the picture. To be awaited.
func _mean_of(part: Rect2i, with_voxels: bool) -> float:
	var voxels := VoxelGI.new()
	if with_voxels:
		voxels.size = Vector3(5.0, 4.0, 5.0)
		voxels.subdiv = VoxelGI.SUBDIV_64
		_view.add_child(voxels)
		voxels.bake(_view)
	for frame in 3:
		await _view.capture()
	var image: Image = await _view.capture()
	voxels.free()
	var sum := 0.0
	for y in part.size.y:
		for x in part.size.x:
			sum += image.get_pixel(part.position.x + x, part.position.y + y).g
	return sum / part.get_area()
