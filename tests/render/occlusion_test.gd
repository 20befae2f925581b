extends GdUnitTestSuite
## Reflections behind what is near and below the horizon: each lobe by its own direction and width.

const Kit := preload("support/render_kit.gd")
const Occluder := preload("support/occluder.gd")
const Oracle := preload("support/material_oracle.gd")
const TableChoice := preload("res://addons/lobelight/runtime/material/table_choice.gd")
const SIDE := 72
# Surfaces in a row, and rows.
const ACROSS := 9

var _view: LinearViewport
var _environment: LobeEnvironment3D
var _tables := Oracle.make_set()


# A quad that is seen from the side, in a cell of the picture.
class Tilted:
	extends RefCounted
	var quad := MeshInstance3D.new()
	var material := LobeMaterial3D.new()
	var view: Vector3
	var pixel: Vector2i

	func _init(number: int, elevation: float, azimuth: float) -> void:
		var mesh := QuadMesh.new()
		mesh.size = 0.2 * Vector2.ONE
		mesh.material = material
		quad.mesh = mesh
		# The viewer is at +z; in the frame of the quad, at (elevation, azimuth).
		quad.basis = Basis(Vector3.UP, -elevation) * Basis(Vector3.BACK, -azimuth)
		view = quad.basis.transposed() * Vector3.BACK
		@warning_ignore("integer_division")
		var cell := Vector2i(number % ACROSS, number / ACROSS)
		@warning_ignore("integer_division")
		pixel = (cell * SIDE + Vector2i.ONE * SIDE / 2) / ACROSS
		var place := (2.0 * Vector2(pixel) + Vector2.ONE) / SIDE - Vector2.ONE
		quad.position = Vector3(place.x, -place.y, 0.0)

	func look_into(image: Image) -> float:
		return image.get_pixelv(pixel).g


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_environment = LobeEnvironment3D.new()
	_view.add_child(_environment)


func after_test() -> void:
	_view.free()


func test_what_is_open_or_flat_stays_as_it_is() -> void:
	await _light(Kit.make_panorama(64, Oracle.light))
	for metallic: float in [1.0, 0.0]:
		var quad := _add_quads([[0.7, 0.3]], metallic)[0] as Tilted
		quad.material.clearcoat_enabled = true
		quad.material.normal_enabled = true
		quad.material.normal_texture = _direction(Vector3.BACK)
		quad.material.ao_texture = _grey(1.0)
		quad.material.disable_specular_occlusion = true
		var expected := quad.look_into(await _view.capture())
		quad.material.ao_enabled = true
		quad.material.bent_normal_enabled = true
		quad.material.bent_normal_texture = _direction(Vector3.BACK)
		quad.material.disable_specular_occlusion = false
		var code := quad.material.get_shader_code()
		assert_str(code).contains("LOBELIGHT_CONE").contains("LOBELIGHT_HORIZON")
		_assert_close(quad.look_into(await _view.capture()), expected, 1e-3, "open %s" % metallic)
		quad.quad.free()


func test_what_is_shut_is_black() -> void:
	await _light(Kit.constant(1.0))
	for metallic: float in [1.0, 0.0]:
		var quad := _add_quads([[0.7, 0.3]], metallic)[0] as Tilted
		quad.material.clearcoat_enabled = true
		quad.material.ao_enabled = true
		quad.material.ao_texture = _grey(0.0)
		assert_float(quad.look_into(await _view.capture())).is_less(1e-4)
		quad.material.disable_specular_occlusion = true
		assert_float(quad.look_into(await _view.capture())).is_greater(0.01)
		quad.quad.free()


## Walls, grooves and a corner, traced direction by direction, against what the material makes of
## their occlusion and bent normals; and against a formula for whole reflections.
func test_reflections_behind_walls_and_in_grooves() -> void:
	await _light(Kit.constant(1.0))
	var occluders := _make_occluders()
	var views: Array[Array] = []
	for n in 6 * occluders.size():
		views.append([[0.25, 0.7, 1.15][n % 3], 0.4 + 2.4 * n])
	var quads := _add_quads(views, 1.0)
	for n in quads.size():
		var quad: Tilted = quads[n]
		quad.material.roughness = [0.25, 0.6][n % 2]
		quad.material.disable_specular_occlusion = true
		@warning_ignore("integer_division")
		var near := occluders[n / 6]
		quad.material.ao_texture = _grey(near.ao)
		quad.material.bent_normal_texture = _direction(near.bent)
		quad.material.ao_enabled = true
	var whole: Image = await _view.capture()
	for quad: Tilted in quads:
		quad.material.disable_specular_occlusion = false
	var unbent: Image = await _view.capture()
	for quad: Tilted in quads:
		quad.material.bent_normal_enabled = true
	var bent: Image = await _view.capture()
	var squares := PackedFloat64Array([0.0, 0.0, 0.0, 0.0])
	for n in quads.size():
		var quad: Tilted = quads[n]
		@warning_ignore("integer_division")
		var near := occluders[n / 6]
		var traced := _traced(quad, near.share_of)
		var before := quad.look_into(whole)
		var found: Array[float] = [
			1.0,
			_lagarde(quad.view.z, near.ao, quad.material.roughness),
			quad.look_into(unbent) / before,
			quad.look_into(bent) / before,
		]
		for k in 4:
			squares[k] += (found[k] - traced) * (found[k] - traced) / quads.size()
	var said := "share of the reflections, mean error (RMS) against traced walls: "
	said += (
		"none %.3f, Lagarde %.3f, lobes %.3f, with bent normals %.3f"
		% [sqrt(squares[0]), sqrt(squares[1]), sqrt(squares[2]), sqrt(squares[3])]
	)
	print(said)
	assert_float(sqrt(squares[2])).is_less(sqrt(squares[1]))
	assert_float(sqrt(squares[3])).is_less(0.65 * sqrt(squares[1]))
	assert_float(sqrt(squares[3])).is_less(0.23)


## Lobes of a normal that is bent away from the viewer lie below the mesh's horizon. There they meet
## the surface, which is as bright as its colour.
func test_the_surface_hides_what_is_below_its_horizon() -> void:
	await _light(Kit.constant(1.0))
	var views: Array[Array] = []
	for n in 18:
		views.append([[0.2, 0.6, 1.0][n % 3], 1.1 * n])
	var own := 0.3
	var quads := _add_quads(views, 1.0)
	var bends := PackedVector3Array()
	for n in quads.size():
		var quad: Tilted = quads[n]
		var bend := Vector3(sin(0.15 * (n % 6)), 0.0, cos(0.15 * (n % 6)))
		bends.append(bend.rotated(Vector3.BACK, 0.7 * n))
		quad.material.roughness = [0.25, 0.6][n % 2]
		quad.material.albedo_color = Color(own, own, own).linear_to_srgb()
		quad.material.normal_enabled = true
		quad.material.normal_texture = _direction(bends[n])
		quad.material.disable_specular_occlusion = true
	var whole: Image = await _view.capture()
	for quad: Tilted in quads:
		quad.material.disable_specular_occlusion = false
	var image: Image = await _view.capture()
	var squares := 0.0
	var untouched := 0.0
	for n in quads.size():
		var quad: Tilted = quads[n]
		# Lobes lie about the bent normal; in its frame the mesh's is elsewhere.
		var frame := _frame_of(bends[n])
		var above := frame.transposed() * Vector3.BACK
		var is_above := func(d: Vector3) -> bool: return d.dot(above) > 0.0
		var share := func(mean: Vector3, kappa: float) -> float:
			return lerpf(own, 1.0, Occluder.share_within(mean, kappa, is_above))
		var traced := _traced(quad, share, frame.transposed() * quad.view, own)
		var found := quad.look_into(image) / quad.look_into(whole)
		squares += (found - traced) * (found - traced) / quads.size()
		untouched += (1.0 - traced) * (1.0 - traced) / quads.size()
		if n % 6 == 0:
			assert_float(found).is_equal_approx(1.0, 1e-3)
	print("horizon: mean error (RMS) %.3f, without %.3f" % [sqrt(squares), sqrt(untouched)])
	assert_float(sqrt(untouched)).is_greater(0.1)
	assert_float(sqrt(squares)).is_less(0.035)


func test_a_white_furnace_stays_white_under_a_normal_map() -> void:
	await _light(Kit.constant(1.0))
	var quad := _add_quads([[1.0, 0.0]], 1.0)[0] as Tilted
	quad.material.normal_enabled = true
	quad.material.normal_texture = _direction(Vector3(-0.6, 0.0, 0.8))
	_assert_close(quad.look_into(await _view.capture()), 1.0, 0.005, "furnace")


func test_plastic_reflects_and_scatters_what_it_sees() -> void:
	await _light(Kit.constant(1.0))
	var quad := _add_quads([[0.5, 0.0]], 0.0)[0] as Tilted
	quad.material.ao_enabled = true
	quad.material.ao_texture = _grey(0.6)
	quad.material.ao_texture_channel = BaseMaterial3D.TEXTURE_CHANNEL_GREEN
	var image: Image = await _view.capture()
	var table := _tables.table_at(LobeMaterial3D.widths_of(quad.material.roughness, 0.0))
	var share := Oracle.share(table, quad.view, 0.04, 1.0)
	# The formula of occlusion.gdshaderinc, lobe by lobe.
	var visible := func(mean: Vector3, kappa: float) -> float:
		var slope := sqrt(1.0 / kappa + 0.08)
		return 0.6 / (0.6 + 0.4 * exp((2.0 / 3.0 - mean.z) / slope))
	var kept := Oracle.share(table, quad.view, 0.04, 1.0, visible)
	assert_float(kept).is_not_equal(0.6 * share)
	_assert_close(quad.look_into(image), kept + (1.0 - share) * 0.6, 0.01, "plastic")


func test_a_coat_is_occluded_about_the_mesh_normal() -> void:
	await _light(Kit.constant(1.0))
	var quad := _add_quads([[0.5, 0.0]], 0.0)[0] as Tilted
	quad.material.albedo_color = Color.BLACK
	quad.material.metallic_specular = 0.0
	quad.material.clearcoat_enabled = true
	quad.material.clearcoat_roughness = 1.0
	var bare := quad.look_into(await _view.capture())
	quad.material.ao_enabled = true
	quad.material.ao_texture = _grey(0.3)
	# It does not bend the coat.
	quad.material.normal_enabled = true
	quad.material.normal_texture = _direction(Vector3(0.5, 0.3, 0.7).normalized())
	var table := (load(TableChoice.COAT_SET) as LobeTableSet).table_at(Vector2(0.1, 0.1))
	var visible := func(mean: Vector3, kappa: float) -> float:
		var slope := sqrt(1.0 / kappa + 0.08)
		return 0.3 / (0.3 + 0.7 * exp((2.0 / 3.0 - mean.z) / slope))
	var sums := Oracle._sums(table, Basis.IDENTITY, quad.view)
	var seen := Oracle._sums(table, Basis.IDENTITY, quad.view, visible)
	var expected := (0.04 * seen[4] + 0.96 * seen[5]) / (0.04 * sums[2] + 0.96 * sums[3])
	_assert_close(quad.look_into(await _view.capture()), bare * expected, 0.01, "coat")


func test_diffuse_light_comes_from_the_bent_normal() -> void:
	await _light(Kit.make_panorama(128, Oracle.light))
	var quad := _add_quads([[0.5, 0.8]], 0.0)[0] as Tilted
	quad.material.metallic_specular = 0.0
	var bent := Vector3(0.5, -0.3, 0.8).normalized()
	quad.material.bent_normal_texture = _direction(bent)
	for enabled: bool in [false, true]:
		quad.material.bent_normal_enabled = enabled
		var from := quad.quad.basis * (bent if enabled else Vector3.BACK)
		var expected := 1.0 + 2.0 / 3.0 * Oracle.GRADIENT.dot(from)
		_assert_close(quad.look_into(await _view.capture()), expected, 0.015, "bent %s" % enabled)


func test_lights_of_places_are_hidden_as_the_worlds_is() -> void:
	await _light(Kit.make_panorama(64, Oracle.light))
	var quad := _add_quads([[0.8, 0.6]], 0.0)[0] as Tilted
	quad.material.ao_enabled = true
	quad.material.ao_texture = _grey(0.4)
	quad.material.bent_normal_enabled = true
	quad.material.bent_normal_texture = _direction(Vector3(0.5, -0.3, 0.8).normalized())
	quad.material.normal_enabled = true
	quad.material.normal_texture = _direction(Vector3(-0.5, 0.1, 0.8).normalized())
	quad.material.clearcoat_enabled = true
	var expected := quad.look_into(await _view.capture())
	var probe := LobeProbe3D.new()
	probe.light = _environment.get_light()
	probe.size = 4000.0 * Vector3.ONE
	_view.add_child(probe)
	var found := quad.look_into(await _view.capture())
	assert_str(quad.material.get_shader_code()).contains("LOBELIGHT_PLACED")
	_assert_close(found, expected, 0.01, "placed")


func _make_occluders() -> Array[Occluder]:
	var made: Array[Occluder] = []
	# Floors beside a wall, grooves, walls of a groove that opens by 60°, corners, pits.
	for walls: Array in [
		[[0, 0.4, 1.0, 0.0]],
		[[0, 1.0, 1.0, 0.0]],
		[[1, -0.3, 2.0, 0.0]],
		[[0, 0.5, 1.5, 0.0], [0, -0.5, 1.5, 0.0]],
		[[1, 1.0, 1.0, 0.0], [1, -0.5, 1.0, 0.0]],
		[[0, 0.5, 1.0, 0.52]],
		[[0, -0.2, 1.0, 0.52]],
		[[0, 0.5, 1.0, 0.0], [1, 0.5, 1.0, 0.0]],
		[[0, -0.3, 1.0, 0.0], [1, 0.7, 1.0, 0.0], [0, 1.2, 1.0, 0.0]],
		[[0, 1.0, 0.6, 0.0], [0, -1.0, 0.6, 0.0], [1, 1.0, 0.6, 0.0], [1, -1.0, 0.6, 0.0]],
		[[0, 0.4, 0.8, 0.0], [0, -0.8, 0.8, 0.0], [1, 0.6, 0.8, 0.0], [1, -0.6, 0.8, 0.0]],
	]:
		var one := Occluder.new()
		for wall: Array in walls:
			one.add_wall(wall[0], wall[1], wall[2], wall[3])
		one.bake()
		made.append(one)
	return made


# The share of the light of a lobe's Gaussian that a function of its mean and sharpness gives, over
# all lobes.
func _traced(quad: Tilted, share: Callable, view := Vector3.ZERO, f0 := 1.0) -> float:
	var local := view if view != Vector3.ZERO else quad.view
	var table := _tables.table_at(LobeMaterial3D.widths_of(quad.material.roughness, 0.0))
	var sums := Oracle._sums(table, Basis.IDENTITY, local, share)
	return (f0 * sums[4] + (1.0 - f0) * sums[5]) / (f0 * sums[2] + (1.0 - f0) * sums[3])


# Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", listing 26.
static func _lagarde(cosine: float, ao: float, roughness: float) -> float:
	var power := pow(cosine + ao, pow(2.0, -16.0 * roughness - 1.0))
	return clampf(power - 1.0 + ao, 0.0, 1.0)


static func _frame_of(normal: Vector3) -> Basis:
	var tangent := (Vector3.RIGHT - normal * normal.x).normalized()
	return Basis(tangent, normal.cross(tangent), normal)


func _add_quads(views: Array[Array], metallic: float) -> Array[Tilted]:
	var made: Array[Tilted] = []
	for n in views.size():
		var one := Tilted.new(n, views[n][0], views[n][1])
		one.material.metallic = metallic
		one.material.roughness = 0.4
		one.material.table_set = _tables
		_view.add_child(one.quad)
		made.append(one)
	return made


func _light(panorama: Texture2D) -> void:
	_environment.panorama = panorama
	await _environment.rebuild()


static func _direction(direction: Vector3) -> ImageTexture:
	return _plain(Color(0.5 * direction.x + 0.5, 0.5 * direction.y + 0.5, 1.0))


static func _grey(value: float) -> ImageTexture:
	return _plain(Color(value, value, value))


static func _plain(colour: Color) -> ImageTexture:
	var image := Image.create_empty(4, 4, false, Image.FORMAT_RGBAF)
	image.fill(colour)
	return ImageTexture.create_from_image(image)


func _assert_close(got: float, expected: float, tolerance: float, what: String) -> void:
	(
		assert_float(got / expected)
		. append_failure_message("%s: %f, expected %f" % [what, got, expected])
		. is_equal_approx(1.0, tolerance)
	)
