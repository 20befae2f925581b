extends GdUnitTestSuite
## What the engine and a LobeMaterial3D make of one another: lights, flow maps, fog, ambient light,
## decals, lightmaps, cameras, kinds of meshes.

const Kit := preload("support/render_kit.gd")
const Oracle := preload("support/material_oracle.gd")
const SIDE := 48
const MIDDLE := 24

var _view: LinearViewport
var _environment: LobeEnvironment3D
var _tables := Oracle.make_set()


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_environment = LobeEnvironment3D.new()
	_view.add_child(_environment)


func after_test() -> void:
	_view.free()


func test_converted_materials_look_the_same_in_the_engines_lights() -> void:
	# Godot's own shader is the reference: in the dark, only its lights are seen.
	await _light(Kit.constant(0.0))
	var lamp := DirectionalLight3D.new()
	lamp.basis = Basis.looking_at(Vector3(-0.3, -0.5, -1.0))
	_view.add_child(lamp)
	var sphere := Kit.make_sphere(null, 128)
	_view.add_child(sphere)
	for kind: String in ["metal", "plastic", "brushed", "brushed across", "flow", "coat", "bumps"]:
		var godots := _standard(kind)
		sphere.material_override = godots
		var expected: Image = await _view.capture()
		var made := LobeMaterial3D.from_standard(godots)
		made.table_set = _tables
		sphere.material_override = made
		var got: Image = await _view.capture()
		assert_float(_brightest(expected)).is_greater(0.1)
		(
			assert_float(Kit.psnr(got, expected))
			. append_failure_message(
				(
					"%s: %f dB, brightest %f and %f"
					% [kind, Kit.psnr(got, expected), _brightest(got), _brightest(expected)]
				)
			)
			. is_greater(50.0)
		)


func test_highlights_lie_as_godots() -> void:
	# A sun in the environment and a lamp in its place, in the engine's own material: the highlights
	# have the same axes. GGX with the set that materials come with.
	var sun := Vector3(0.25, 0.3, 0.9).normalized()
	var shine := func(d: Vector3) -> Color:
		return Color.WHITE * (200.0 if d.dot(sun) > 0.9995 else 0.0)
	await _light(Kit.make_panorama(256, shine))
	var lamp := DirectionalLight3D.new()
	lamp.basis = Basis.looking_at(-sun)
	var sphere := Kit.make_sphere(null, 128)
	_view.add_child(sphere)
	for kind: String in ["brushed", "brushed across", "flow"]:
		var godots := _standard(kind)
		godots.roughness = 0.45
		var made := LobeMaterial3D.from_standard(godots)
		made.disable_ambient_light = false
		sphere.material_override = made
		var ours := _axes(await _view.capture())
		_view.add_child(lamp)
		sphere.material_override = godots
		var expected := _axes(await _view.capture())
		_view.remove_child(lamp)
		var what := "%s: %s, Godot's %s" % [kind, ours, expected]
		# Angles of the long axes, and how long they are for their breadth.
		var off := absf(angle_difference(2.0 * ours.x, 2.0 * expected.x)) / 2.0
		assert_float(off).append_failure_message(what).is_less(0.12)
		assert_float(ours.y / expected.y).append_failure_message(what).is_between(0.75, 1.33)
	lamp.free()


func test_fog() -> void:
	await _light(Kit.constant(1.0))
	_view.add_child(SphereImpostor.make_quad(_material()))
	var plain := await _middle()
	var surroundings := _view.camera.environment
	surroundings.fog_enabled = true
	surroundings.fog_light_color = Color.WHITE
	surroundings.fog_sky_affect = 0.0
	surroundings.fog_density = 0.2
	# Exponential, over the four units to the camera.
	var share := 1.0 - exp(-4.0 * 0.2)
	_assert_close(await _middle(), plain + (1.0 - plain) * share, 0.02, "fog")


func test_ambient_light_is_not_added() -> void:
	await _light(Kit.constant(0.5))
	var material := _material()
	material.metallic = 0.0
	material.diffuse_light = LobeMaterial3D.DiffuseLight.ENVIRONMENT
	var quad := SphereImpostor.make_quad(material)
	_view.add_child(quad)
	var plain := await _middle()
	var godots := StandardMaterial3D.new()
	quad.material_override = godots
	var dark := await _middle()
	var surroundings := _view.camera.environment
	surroundings.ambient_light_source = Environment.AMBIENT_SOURCE_COLOR
	surroundings.ambient_light_color = Color.WHITE
	surroundings.ambient_light_energy = 4.0
	# There is such light, as Godot's material shows.
	assert_float(await _middle()).is_greater(dark + 0.5)
	quad.material_override = material
	var probe := ReflectionProbe.new()
	probe.size = Vector3(8.0, 8.0, 8.0)
	probe.ambient_mode = ReflectionProbe.AMBIENT_COLOR
	probe.ambient_color = Color.WHITE
	probe.ambient_color_energy = 4.0
	_view.add_child(probe)
	_assert_close(await _middle(), plain, 0.004, "ambient light")


func test_decals_change_the_engines_lights_only() -> void:
	await _light(Kit.constant(0.5))
	var material := _material()
	_view.add_child(SphereImpostor.make_quad(material))
	var plain := await _middle()
	var picture := Image.create_empty(8, 8, false, Image.FORMAT_RGBA8)
	picture.fill(Color.BLACK)
	var decal := Decal.new()
	decal.texture_albedo = ImageTexture.create_from_image(picture)
	decal.size = Vector3(4.0, 4.0, 4.0)
	decal.basis = Basis(Vector3.RIGHT, 0.5 * PI)
	_view.add_child(decal)
	_assert_close(await _middle(), plain, 0.004, "environment")
	var lamp := DirectionalLight3D.new()
	_view.add_child(lamp)
	var covered := await _middle()
	decal.visible = false
	var lit := await _middle()
	if LinearViewport.is_compatibility():
		# It has no decals.
		_assert_close(covered, lit, 0.004, "lamp")
	else:
		assert_float(lit - plain).is_greater(2.0 * (covered - plain))


func test_lightmaps_take_no_reflections_for_lamps() -> void:
	await _light(Kit.constant(3.0))
	var material := _material()
	var emission := await _baked_emission(material)
	assert_float(emission).is_equal(0.0)
	material.emission = Color(0.5, 0.5, 0.5)
	material.emission_enabled = true
	emission = await _baked_emission(material)
	assert_float(emission).is_equal_approx(0.2140411, 0.002)


func test_two_viewports_with_cameras_of_their_own() -> void:
	await _light(Kit.make_panorama(64, Oracle.light))
	var material := _material()
	material.roughness = 0.3
	material.anisotropy = 0.7
	material.anisotropy_enabled = true
	_view.add_child(Kit.make_sphere(material))
	var expected: Image = await _view.capture()
	var other := LinearViewport.new(32)
	add_child(other)
	other.add_child(Kit.make_sphere(material))
	other.camera.set_perspective(50.0, 0.1, 10.0)
	other.camera.look_at_from_position(Vector3(2.0, 1.0, 1.5), Vector3.ZERO)
	var there: Image = await other.capture()
	assert_float(there.get_pixel(16, 16).g).is_greater(0.0)
	assert_float(Kit.psnr(await _view.capture(), expected)).is_greater(60.0)
	other.free()


func test_kinds_of_meshes() -> void:
	await _light(Kit.make_panorama(64, Oracle.light))
	var material := _material()
	material.roughness = 0.4
	material.anisotropy = 0.9
	material.anisotropy_enabled = true
	var turn := Basis(Vector3(0.2, 0.9, 0.1).normalized(), 0.7)
	var sphere := Kit.make_sphere(material)
	sphere.basis = turn
	_view.add_child(sphere)
	var expected: Image = await _view.capture()
	sphere.free()

	var many := MultiMeshInstance3D.new()
	many.multimesh = MultiMesh.new()
	many.multimesh.transform_format = MultiMesh.TRANSFORM_3D
	many.multimesh.mesh = _sphere_mesh(material)
	many.multimesh.instance_count = 1
	many.multimesh.set_instance_transform(0, Transform3D(turn, Vector3.ZERO))
	_view.add_child(many)
	assert_float(Kit.psnr(await _view.capture(), expected)).is_greater(50.0)
	many.free()

	if LinearViewport.is_compatibility():
		# There TANGENT is the same all over a skinned mesh, in any material: no brushing.
		material.anisotropy = 0.0
		sphere = Kit.make_sphere(material)
		sphere.basis = turn
		_view.add_child(sphere)
		expected = await _view.capture()
		sphere.free()
	var skeleton := _skinned(material)
	_view.add_child(skeleton)
	skeleton.set_bone_pose_rotation(0, turn.get_rotation_quaternion())
	await await_idle_frame()
	assert_float(Kit.psnr(await _view.capture(), expected)).is_greater(45.0)


func test_uneven_scale() -> void:
	await _light(Kit.make_panorama(64, Oracle.light))
	var material := _material()
	material.albedo_color = Color.WHITE
	var sphere := Kit.make_sphere(material, 128)
	sphere.scale = Vector3(1.0, 0.6, 2.0)
	_view.add_child(sphere)
	var image: Image = await _view.capture()
	var table := _tables.table_at(LobeMaterial3D.widths_of(material.roughness, 0.0))
	for pixel: Vector2i in [Vector2i(24, 24), Vector2i(34, 20), Vector2i(14, 30)]:
		# On the ellipsoid x² + (y / 0.6)² + (z / 2)² = 1.
		var x := (2.0 * pixel.x + 1.0) / SIDE - 1.0
		var y := 1.0 - (2.0 * pixel.y + 1.0) / SIDE
		var z := 2.0 * sqrt(1.0 - x * x - y * y / 0.36)
		var frame := Kit.sphere_frame(Vector3(x, y / 0.36, z / 4.0).normalized())
		var expected := Oracle.reflected(table, frame, Vector3.BACK, 1.0, 1.0, true)
		_assert_close(image.get_pixelv(pixel).r, expected, 0.015, "at %s" % pixel)


func _mesh_of(arrays: Array, material: Material) -> ArrayMesh:
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	mesh.surface_set_material(0, material)
	return mesh


func _material() -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.4
	material.table_set = _tables
	return material


func _standard(kind: String) -> StandardMaterial3D:
	var material := StandardMaterial3D.new()
	material.disable_ambient_light = true
	material.roughness = 0.6
	material.metallic = 1.0
	material.albedo_color = Color(0.9, 0.6, 0.3)
	match kind:
		"plastic":
			material.metallic = 0.0
			material.metallic_specular = 0.8
		"brushed":
			material.anisotropy_enabled = true
			material.anisotropy = 0.8
		"brushed across":
			material.anisotropy_enabled = true
			material.anisotropy = -1.0
		"flow":
			material.anisotropy_enabled = true
			material.anisotropy = 0.8
			var flow := 0.5 * Vector2.from_angle(0.6) + Vector2(0.5, 0.5)
			material.anisotropy_flowmap = _plain(Color(flow.x, flow.y, 0.0, 1.0))
		"coat":
			material.clearcoat_enabled = true
			material.clearcoat_roughness = 0.8
		"bumps":
			material.normal_enabled = true
			material.normal_texture = _plain(Color(0.65, 0.4, 1.0))
			material.normal_scale = 0.7
	return material


func _light(panorama: Texture2D) -> void:
	_environment.panorama = panorama
	await _environment.rebuild()


func _middle() -> float:
	var image: Image = await _view.capture()
	return image.get_pixel(MIDDLE, MIDDLE).r


func _plain(colour: Color) -> ImageTexture:
	var image := Image.create_empty(4, 4, false, Image.FORMAT_RGBA8)
	image.fill(colour)
	return ImageTexture.create_from_image(image)


func _brightest(image: Image) -> float:
	var most := 0.0
	for y in SIDE:
		for x in SIDE:
			most = maxf(most, image.get_pixel(x, y).r)
	return most


# The angle of the highlight's long axis and the ratio of the axes, from its second moments.
# Weighted by the square of the light, which leaves the tails out.
func _axes(image: Image) -> Vector2:
	var sum := 0.0
	var mean := Vector2.ZERO
	for y in SIDE:
		for x in SIDE:
			var weight := pow(image.get_pixel(x, y).g, 2.0)
			sum += weight
			mean += weight * Vector2(x, -y)
	mean /= sum
	var xx := 0.0
	var yy := 0.0
	var xy := 0.0
	for y in SIDE:
		for x in SIDE:
			var weight := pow(image.get_pixel(x, y).g, 2.0) / sum
			var off := Vector2(x, -y) - mean
			xx += weight * off.x * off.x
			yy += weight * off.y * off.y
			xy += weight * off.x * off.y
	var spread := sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy)
	var half := 0.5 * (xx + yy)
	return Vector2(0.5 * atan2(2.0 * xy, xx - yy), sqrt((half + spread) / (half - spread)))


# What a lightmap is told that a quad emits, in red.
func _baked_emission(material: LobeMaterial3D) -> float:
	await await_idle_frame()
	var mesh := QuadMesh.new()
	mesh.size = Vector2(2.0, 2.0)
	mesh.add_uv2 = true
	mesh.material = material
	await await_idle_frame()
	var none: Array[RID] = []
	var images := RenderingServer.bake_render_uv2(mesh.get_rid(), none, Vector2i(16, 16))
	return images[RenderingServer.BAKE_CHANNEL_EMISSION].get_pixel(8, 8).r


func _sphere_mesh(material: Material) -> SphereMesh:
	var sphere := Kit.make_sphere(material)
	var mesh: SphereMesh = sphere.mesh
	sphere.free()
	return mesh


# A sphere whose vertices all hang on one bone.
func _skinned(material: Material) -> Skeleton3D:
	var arrays := _sphere_mesh(material).get_mesh_arrays()
	var count := (arrays[Mesh.ARRAY_VERTEX] as PackedVector3Array).size()
	var bones := PackedInt32Array()
	bones.resize(4 * count)
	var weights := PackedFloat32Array()
	weights.resize(4 * count)
	for i in count:
		weights[4 * i] = 1.0
	arrays[Mesh.ARRAY_BONES] = bones
	arrays[Mesh.ARRAY_WEIGHTS] = weights
	var skeleton := Skeleton3D.new()
	skeleton.add_bone("root")
	var instance := MeshInstance3D.new()
	instance.mesh = _mesh_of(arrays, material)
	skeleton.add_child(instance)
	instance.skeleton = NodePath("..")
	instance.skin = skeleton.create_skin_from_rest_transforms()
	return skeleton


func _assert_close(got: float, expected: float, tolerance: float, what: String) -> void:
	(
		assert_float(got / expected)
		. append_failure_message("%s: %f, expected %f" % [what, got, expected])
		. is_equal_approx(1.0, tolerance)
	)
