extends GdUnitTestSuite
## LobeMaterial3D draws what its table says, on any mesh and with any camera.

const LightRegistry := preload("res://addons/lobelight/runtime/light/light_registry.gd")
const Kit := preload("support/render_kit.gd")
const SIDE := 48
const MIDDLE := 24
# Frames until a light that has left no longer stays.
const SETTLED := 6
const GRADIENT := Vector3(0.5, 0.3, -0.4)
const TABLES := [[Vector2i(9, 1), Vector2(0.2, 0.2)], [Vector2i(7, 4), Vector2(0.1, 0.4)]]

var _gradient: ImageTexture
# Keeps the shaders that most tests use from being compiled for each of them.
var _kept: Array[LobeMaterial3D] = []
var _view: LinearViewport
var _environment: LobeEnvironment3D


static func _linear(direction: Vector3) -> Color:
	var value := 1.0 + GRADIENT.dot(direction)
	return Color(value, 2.0 * value, 0.5 * value)


func before() -> void:
	_gradient = Kit.make_panorama(64, _linear)
	for views: Vector2i in [Vector2i(9, 1), Vector2i(7, 4)]:
		var material := LobeMaterial3D.new()
		material.metallic = 1.0
		material.table = Kit.make_odd_table(6, views, Vector2(0.2, 0.2))
		_kept.append(material)
	_kept.append(_smooth_material())


func after() -> void:
	_gradient = null
	_kept.clear()


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_environment = LobeEnvironment3D.new()
	_view.add_child(_environment)


func after_test() -> void:
	_view.free()


func test_lobes_are_where_the_table_says(
	views: Vector2i, alpha: Vector2, _test_parameters := TABLES
) -> void:
	# In a radiance 1 + g·d a lobe gives weight (1 + A g·mean), A = coth kappa - 1/kappa, exactly.
	var table := Kit.make_odd_table(6, views, alpha)
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = table
	_view.add_child(Kit.make_sphere(material, 128))
	_environment.panorama = _gradient
	await _environment.rebuild()
	var image: Image = await _view.capture()
	for normal: Vector3 in [
		Vector3(0.02, 0.02, 1),
		Vector3(0.6, 0.3, 1),
		Vector3(-0.5, 0.7, 1),
		Vector3(-0.8, -0.6, 1),
		Vector3(0.9, -1.5, 1),
		Vector3(-2.2, 0.7, 1)
	]:
		var pixel := _pixel_of(normal)
		var exact := Kit.sphere_normal(pixel.x, pixel.y, SIDE)
		var expected := _reflected(table, Kit.sphere_frame(exact), Vector3.BACK)
		_assert_close(image.get_pixelv(pixel).r, expected, 0.01, "normal %s" % exact)


func test_perspective_camera() -> void:
	var table := Kit.make_odd_table(6, Vector2i(7, 4), Vector2(0.1, 0.4))
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = table
	_view.add_child(Kit.make_sphere(material, 128))
	_environment.panorama = _gradient
	await _environment.rebuild()
	# Close and tilted, so that the views differ much from the camera's axis.
	var camera := _view.camera
	camera.look_at_from_position(Vector3(0.8, 0.9, 1.6), Vector3(0.3, 0.0, 0.1))
	camera.set_perspective(70.0, 0.05, 10.0)
	var image: Image = await _view.capture()
	for pixel: Vector2i in [Vector2i(24, 24), Vector2i(10, 20), Vector2i(30, 36), Vector2i(20, 12)]:
		var ray := camera.project_ray_normal(Vector2(pixel) + Vector2(0.5, 0.5))
		var origin := camera.global_position
		var along := -origin.dot(ray)
		var root := along * along - origin.length_squared() + 1.0
		assert_float(root).is_greater(0.0)
		var normal := (origin + ray * (along - sqrt(root))).normalized()
		var expected := _reflected(table, Kit.sphere_frame(normal), -ray)
		_assert_close(image.get_pixelv(pixel).r, expected, 0.015, "pixel %s" % pixel)


func test_one_eye_where_there_may_be_two() -> void:
	var is_compatibility := RenderingServer.get_current_rendering_method() == "gl_compatibility"
	var setting := "xr/shaders/enabled"
	var before: bool = ProjectSettings.get_setting(setting)
	_environment.panorama = _gradient
	await _environment.rebuild()
	_view.camera.set_perspective(70.0, 0.05, 10.0)
	var pictures: Array[PackedByteArray] = []
	for enabled: bool in [false, true]:
		ProjectSettings.set_setting(setting, enabled)
		var material := _smooth_material()
		var has_define := "#define LOBELIGHT_EYES" in material.get_shader_code()
		assert_bool(has_define).is_equal(enabled and is_compatibility)
		var sphere := Kit.make_sphere(material)
		_view.add_child(sphere)
		var image: Image = await _view.capture()
		pictures.append(image.get_data())
		sphere.free()
	ProjectSettings.set_setting(setting, before)
	assert_bool(pictures[0] == pictures[1]).is_true()


func test_impostor_and_mesh_agree() -> void:
	var table := Kit.make_odd_table(6, Vector2i(7, 4), Vector2(0.05, 0.2), 9.0)
	_environment.panorama = Kit.make_panorama(
		64,
		func(direction: Vector3) -> Color:
			var stripes := 0.5 + 0.5 * sin(9.0 * direction.x) * sin(7.0 * direction.y + 1.0)
			return Color(stripes, stripes * stripes, direction.z * 0.3 + 0.4)
	)
	await _environment.rebuild()
	var impostor := SphereImpostor.make(table)
	_view.add_child(impostor)
	var exact: Image = await _view.capture()
	impostor.free()
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = table
	_view.add_child(Kit.make_sphere(material, 256))
	var drawn: Image = await _view.capture()
	# The polygon's rim has fewer pixels than the disc's.
	for y in SIDE:
		for x in SIDE:
			if Kit.sphere_normal(x, y, SIDE).z < 0.15:
				exact.set_pixel(x, y, Color.BLACK)
				drawn.set_pixel(x, y, Color.BLACK)
	assert_float(exact.get_pixel(MIDDLE, MIDDLE).r).is_greater(0.05)
	assert_float(Kit.psnr(exact, drawn)).is_greater(40.0)


func test_neutral_light_without_environment() -> void:
	_environment.free()
	_view.add_child(Kit.make_sphere(_smooth_material()))
	# What has left stays for some frames, in case another one comes.
	for frame in SETTLED:
		await get_tree().process_frame
	var image: Image = await _view.capture()
	var top := image.get_pixel(MIDDLE, 12)
	var bottom := image.get_pixel(MIDDLE, 36)
	assert_float(top.g).is_between(0.3, 4.0)
	assert_float(bottom.g).is_between(0.05, 0.8)
	assert_float(top.g).is_greater(1.5 * bottom.g)


func test_environments_take_turns() -> void:
	var material := _smooth_material()
	_view.add_child(Kit.make_sphere(material))
	_environment.panorama = Kit.constant(0.5)
	await _environment.rebuild()
	var second := LobeEnvironment3D.new()
	second.panorama = Kit.constant(2.0)
	_view.add_child(second)
	assert_bool(_environment.is_active()).is_true()
	assert_bool(second.is_active()).is_false()
	await second.rebuild()
	_assert_close(await _middle(), 0.5, 0.005, "the first one")
	_environment.visible = false
	_assert_close(await _middle(), 2.0, 0.005, "the first one is hidden")
	_environment.visible = true
	_assert_close(await _middle(), 0.5, 0.005, "the first one is back")
	_view.remove_child(_environment)
	await await_idle_frame()
	_assert_close(await _middle(), 2.0, 0.005, "the first one has left")
	second.energy = 0.25
	_assert_close(await _middle(), 0.5, 0.005, "energy")
	_view.add_child(_environment)
	assert_bool(_environment.is_active()).is_false()


func test_properties_change_while_running() -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = LobeTable.make_single_lobe()
	_view.add_child(Kit.make_sphere(material))
	_environment.panorama = Kit.constant(1.0)
	await _environment.rebuild()
	material.albedo_color = Color(0.5, 0.5, 0.5)
	# sRGB 0.5 is 0.2140411 linear; Fresnel adds nothing towards the viewer.
	_assert_close(await _middle(), 0.2140411, 0.005, "albedo")
	var picture := Image.create_empty(4, 4, false, Image.FORMAT_RGB8)
	picture.fill(Color8(188, 188, 188))
	material.albedo_texture = ImageTexture.create_from_image(picture)
	# sRGB 188/255 is 0.5028865 linear.
	_assert_close(await _middle(), 0.2140411 * 0.5028865, 0.01, "albedo texture")
	material.albedo_color = Color.WHITE
	material.albedo_texture = null
	material.emission = Color(0.5, 0.5, 0.5)
	material.emission_enabled = true
	material.emission_energy_multiplier = 10.0
	_assert_close(await _middle(), 1.0 + 2.140411, 0.005, "emission")
	material.emission = Color.BLACK
	var half := LobeTable.make_single_lobe()
	var texels := half.image.duplicate() as Image
	texels.fill(Color(0.0, 0.0, 5.0, 0.25))
	material.table = half
	half.image = texels
	_assert_close(await _middle(), 0.25, 0.005, "the table's image")


func test_fresnel_at_each_half_vector() -> void:
	var table := LobeTable.make_single_lobe(0.05)
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = table
	material.albedo_color = Color.BLACK
	_view.add_child(Kit.make_sphere(material, 128))
	_environment.panorama = Kit.constant(1.0)
	await _environment.rebuild()
	var image: Image = await _view.capture()
	var pixel := _pixel_of(Vector3(2.0, 0.5, 1.0))
	var cosine := Kit.sphere_normal(pixel.x, pixel.y, SIDE).z
	_assert_close(image.get_pixelv(pixel).r, pow(1.0 - cosine, 5.0), 0.03, "Schlick")


func test_anisotropy_rotation() -> void:
	# Turning the table's axes by 90° is the same as exchanging them.
	var table := Kit.make_odd_table(6, Vector2i(2, 2), Vector2(0.1, 0.4))
	table.image.fill(Color(0.9, 0.4, 5.0, 0.09))
	table.image = table.image
	var exchanged := table.duplicate(true) as LobeTable
	exchanged.image.fill(Color(0.4, 0.9, 5.0, 0.09))
	exchanged.alpha = Vector2(0.4, 0.1)
	_environment.panorama = _gradient
	await _environment.rebuild()
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = table
	_view.add_child(Kit.make_sphere(material))
	var plain: Image = await _view.capture()
	material.anisotropy_rotation = 0.5 * PI
	var turned: Image = await _view.capture()
	material.anisotropy_rotation = 0.0
	material.table = exchanged
	var expected: Image = await _view.capture()
	assert_float(Kit.psnr(turned, expected)).is_greater(55.0)
	assert_float(Kit.psnr(plain, expected)).is_less(40.0)


func test_normal_map_turns_the_normal() -> void:
	_environment.panorama = _gradient
	await _environment.rebuild()
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = LobeTable.make_single_lobe(0.05)
	var quad := QuadMesh.new()
	quad.size = Vector2(2.0, 2.0)
	quad.material = material
	var instance := MeshInstance3D.new()
	instance.mesh = quad
	_view.add_child(instance)
	var picture := Image.create_empty(4, 4, false, Image.FORMAT_RGB8)
	# The tangent of a quad is +x and its bitangent +y.
	picture.fill(Color8(191, 128, 255))
	material.normal_texture = ImageTexture.create_from_image(picture)
	material.normal_enabled = true
	var tilt := 191.0 / 255.0 * 2.0 - 1.0
	var rise := 128.0 / 255.0 * 2.0 - 1.0
	var normal := Vector3(tilt, rise, sqrt(1.0 - tilt * tilt - rise * rise))
	var light := Vector3.BACK.bounce(normal) * -1.0
	_assert_close(await _middle(), 1.0 + GRADIENT.dot(light), 0.015, "tilted")
	material.normal_scale = 0.0
	_assert_close(await _middle(), 1.0 + GRADIENT.z, 0.015, "no scale")


# No tangents, no normals, normals that face away, tangents along the normals, a skewed scale.
func test_poor_meshes_stay_finite() -> void:
	_environment.panorama = _gradient
	await _environment.rebuild()
	for isotropic: bool in [true, false]:
		var views := Vector2i(7, 1) if isotropic else Vector2i(7, 4)
		var material := LobeMaterial3D.new()
		material.metallic = 1.0
		material.table = Kit.make_odd_table(6, views, Vector2(0.3, 0.3))
		material.normal_texture = _flat_normals()
		material.normal_enabled = true
		for kind in 5:
			var instance := _poor_mesh(kind, material)
			_view.add_child(instance)
			var image: Image = await _view.capture()
			var what := "isotropic %s, kind %d" % [isotropic, kind]
			assert_bool(Kit.is_finite_image(image)).append_failure_message(what).is_true()
			var centre := image.get_pixel(MIDDLE, MIDDLE)
			assert_float(centre.g).append_failure_message(what).is_greater(0.0)
			instance.free()


func test_mirrored_mesh() -> void:
	# A sphere mirrored in x looks like the sphere in an environment mirrored in x, mirrored.
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = Kit.make_odd_table(6, Vector2i(7, 4), Vector2(0.1, 0.4))
	var instance := Kit.make_sphere(material)
	_view.add_child(instance)
	_environment.panorama = _gradient
	await _environment.rebuild()
	instance.scale.x = -1.0
	var mirrored: Image = await _view.capture()
	instance.scale.x = 1.0
	_environment.panorama = Kit.make_panorama(
		64, func(d: Vector3) -> Color: return _linear(Vector3(-d.x, d.y, d.z))
	)
	await _environment.rebuild()
	var expected: Image = await _view.capture()
	expected.flip_x()
	assert_float(Kit.psnr(mirrored, expected)).is_greater(45.0)


func test_engine_lights_add() -> void:
	_environment.panorama = Kit.constant(0.25)
	await _environment.rebuild()
	var material := _smooth_material()
	material.albedo_color = Color(0.8, 0.8, 0.8)
	_view.add_child(Kit.make_sphere(material))
	var without := await _middle()
	var light := DirectionalLight3D.new()
	_view.add_child(light)
	var with := await _middle()
	assert_float(with).is_greater(1.2 * without)


func test_materials_may_be_made_on_threads() -> void:
	# Not in tests/runtime: the storage of the engine's headless renderer is not made for threads.
	var before: int = LightRegistry._materials.size()
	var materials := _make_on_threads()
	assert_int(LightRegistry._materials.size()).is_equal(before + 200)
	# Some have been updated when they go, some not.
	materials.resize(100)
	await await_idle_frame()
	materials.clear()
	assert_int(LightRegistry._materials.size()).is_equal(before)


# A table of one lobe, whose shader is quickly compiled.
func _smooth_material() -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = LobeTable.make_single_lobe()
	return material


func _middle() -> float:
	var image: Image = await _view.capture()
	return image.get_pixel(MIDDLE, MIDDLE).r


func _pixel_of(normal: Vector3) -> Vector2i:
	var unit := normal.normalized()
	return Vector2i((Vector2(unit.x + 1.0, 1.0 - unit.y) * 0.5 * SIDE).floor())


# What the surface reflects in _linear's environment, its first channel.
func _reflected(table: LobeTable, frame: Basis, view: Vector3) -> float:
	var sum := 0.0
	for lobe in table.lobes_at(frame.transposed() * view):
		var mean: Vector3 = frame * (lobe["mean"] as Vector3)
		var left := Kit.mean_cosine(lobe["kappa"])
		sum += (lobe["weight"] as float) * (1.0 + left * GRADIENT.dot(mean))
	return sum


func _assert_close(got: float, expected: float, tolerance: float, what: String) -> void:
	(
		assert_float(got / expected)
		. append_failure_message("%s: %f, expected %f" % [what, got, expected])
		. is_equal_approx(1.0, tolerance)
	)


func _flat_normals() -> ImageTexture:
	var image := Image.create_empty(2, 2, false, Image.FORMAT_RGB8)
	image.fill(Color8(128, 128, 255))
	return ImageTexture.create_from_image(image)


func _poor_mesh(kind: int, material: Material) -> MeshInstance3D:
	var source := Kit.make_sphere(material, 32)
	var arrays := (source.mesh as SphereMesh).get_mesh_arrays()
	match kind:
		0:
			arrays[Mesh.ARRAY_TANGENT] = null
		1:
			arrays[Mesh.ARRAY_TANGENT] = null
			arrays[Mesh.ARRAY_NORMAL] = null
		2:
			# All normals away from the camera.
			var normals: PackedVector3Array = arrays[Mesh.ARRAY_NORMAL]
			for i in normals.size():
				normals[i] = Vector3(0.3, 0.0, -1.0).normalized()
			arrays[Mesh.ARRAY_NORMAL] = normals
		3:
			# Tangents along the normals.
			var normals: PackedVector3Array = arrays[Mesh.ARRAY_NORMAL]
			var tangents: PackedFloat32Array = arrays[Mesh.ARRAY_TANGENT]
			for i in normals.size():
				for axis in 3:
					tangents[4 * i + axis] = normals[i][axis]
			arrays[Mesh.ARRAY_TANGENT] = tangents
		4:
			source.scale = Vector3(1.0, 0.1, 2.0)
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	mesh.surface_set_material(0, material)
	source.mesh = mesh
	return source


func _make_on_threads() -> Array:
	var make := func() -> Array:
		var materials := []
		for i in 50:
			var material := LobeMaterial3D.new()
			material.metallic = 1.0
			material.roughness = 0.4
			material.emission = Color(0.01 * i, 0.0, 0.0)
			material.emission_enabled = true
			materials.append(material)
		return materials
	var threads: Array[Thread] = []
	for i in 4:
		threads.append(Thread.new())
		threads[i].start(make)
	var all := []
	for thread in threads:
		all.append_array(thread.wait_to_finish())
	return all
