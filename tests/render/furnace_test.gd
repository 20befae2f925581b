extends GdUnitTestSuite
## White furnace: in an environment of constant radiance the picture is that radiance times the
## table's albedo, whatever the renderer, with no clamp on either side.

const Kit := preload("support/render_kit.gd")
const SIDE := 48
const MIDDLE := 24
const RADIANCES := [[0.01], [1.0], [64.0]]
const TOLERANCE := 0.005

var _view: LinearViewport
var _environment: LobeEnvironment3D


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_environment = LobeEnvironment3D.new()
	_view.add_child(_environment)


func after_test() -> void:
	_view.free()


func test_isotropic_sphere(radiance: float, _test_parameters := RADIANCES) -> void:
	var table := Kit.make_odd_table(6, Vector2i(9, 1), Vector2(0.2, 0.2))
	await _check(SphereImpostor.make(table), table, radiance)


func test_anisotropic_sphere(radiance: float, _test_parameters := RADIANCES) -> void:
	var table := Kit.make_odd_table(6, Vector2i(7, 4), Vector2(0.05, 0.3))
	await _check(SphereImpostor.make(table), table, radiance)


func test_mesh_with_the_material(radiance: float, _test_parameters := RADIANCES) -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = Kit.make_odd_table(6, Vector2i(7, 4), Vector2(0.05, 0.3))
	await _check(Kit.make_sphere(material, 128), material.table, radiance)


func test_coloured_lobes() -> void:
	var table := Kit.coloured(Kit.make_odd_table(6, Vector2i(7, 4), Vector2(0.1, 0.3)))
	_view.add_child(SphereImpostor.make(table))
	_environment.panorama = Kit.constant(1.0)
	await _environment.rebuild()
	var image: Image = await _view.capture()
	for x in range(4, SIDE - 4, 2):
		var normal := Kit.sphere_normal(x, MIDDLE + 7, SIDE)
		var view := Kit.sphere_frame(normal).transposed() * Vector3.BACK
		var expected := Color(0, 0, 0)
		for lobe in table.lobes_at(view):
			var tint: Color = lobe["tint"]
			expected += tint * (lobe["weight"] as float)
		var got := image.get_pixel(x, MIDDLE + 7)
		assert_float(got.r).is_equal_approx(expected.r, TOLERANCE)
		assert_float(got.g).is_equal_approx(expected.g, TOLERANCE)
		assert_float(got.b).is_equal_approx(expected.b, TOLERANCE)


func test_small_and_large_radiance() -> void:
	_view.add_child(SphereImpostor.make(LobeTable.make_single_lobe()))
	# What is darker, Compatibility's frame buffer drops.
	for radiance: float in [0.0, 0.001, 0.002, 1000.0, 60000.0]:
		_environment.panorama = Kit.constant(radiance)
		await _environment.rebuild()
		var image: Image = await _view.capture()
		var got := image.get_pixel(MIDDLE, MIDDLE).r
		assert_float(got).is_equal_approx(radiance, 0.004 * radiance)


func test_light_beyond_half_floats_stays_finite() -> void:
	var image := Image.create_empty(8, 4, false, Image.FORMAT_RGBAF)
	image.fill(Color(1e9, 70000.0, 3.0))
	_environment.panorama = ImageTexture.create_from_image(image)
	_environment.energy = 100.0
	_view.add_child(SphereImpostor.make(LobeTable.make_single_lobe()))
	await _environment.rebuild()
	var picture: Image = await _view.capture()
	var centre := picture.get_pixel(MIDDLE, MIDDLE)
	assert_bool(Kit.is_finite_image(picture)).is_true()
	assert_float(centre.r).is_equal_approx(65504.0, 300.0)
	assert_float(centre.b).is_equal_approx(300.0, 1.0)


# Compares pixels all over the sphere with the table's albedo for their views.
func _check(sphere: MeshInstance3D, table: LobeTable, radiance: float) -> void:
	_view.add_child(sphere)
	_environment.panorama = Kit.constant(radiance)
	assert_bool(await _environment.rebuild()).is_true()
	var image: Image = await _view.capture()
	var worst := 0.0
	var where := ""
	for y in range(1, SIDE, 3):
		for x in range(1, SIDE, 3):
			var normal := Kit.sphere_normal(x, y, SIDE)
			# A polygon has no pixels at the very rim.
			if normal.z < 0.15:
				continue
			var view := Kit.sphere_frame(normal).transposed() * Vector3.BACK
			var expected := radiance * table.directional_albedo(view)
			var error := absf(image.get_pixel(x, y).g / expected - 1.0)
			if error > worst:
				worst = error
				where = "(%d, %d): %s, expected %f" % [x, y, image.get_pixel(x, y), expected]
	assert_float(worst).append_failure_message(where).is_less(TOLERANCE)
