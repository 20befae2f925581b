extends GdUnitTestSuite
## LobeMaterial3D's surface: metals and all else, energy, diffuse light, clear coat,
## textures, transparency.

const Kit := preload("support/render_kit.gd")
const Oracle := preload("support/material_oracle.gd")
const TableChoice := preload("res://addons/lobelight/runtime/material/table_choice.gd")
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


func test_white_surfaces_send_all_light_back() -> void:
	var material := _material()
	material.albedo_color = Color.WHITE
	_view.add_child(Kit.make_sphere(material, 128))
	await _light(Kit.constant(1.0))
	for metallic: float in [1.0, 0.0, 0.5]:
		for roughness: float in [0.2, 0.9]:
			material.metallic = metallic
			material.roughness = roughness
			var image: Image = await _view.capture()
			var what := "metallic %s, roughness %s" % [metallic, roughness]
			# Between metal and not, the compensation is the mean material's.
			var least := 0.95 if metallic == 0.5 else 0.995
			_assert_range(image, least, 1.005, what)


func test_a_coat_takes_what_it_reflects() -> void:
	var material := _material()
	material.albedo_color = Color.WHITE
	material.clearcoat = 1.0
	material.clearcoat_enabled = true
	material.clearcoat_roughness = 1.0
	_view.add_child(Kit.make_sphere(material, 128))
	await _light(Kit.constant(1.0))
	# What the coat reflects, 0.04 + 0.96 x, the metal below loses; the test's tables have an albedo
	# below 1.
	_assert_range(await _view.capture(), 0.995, 1.005, "white metal")
	material.albedo_color = Color.BLACK
	material.metallic = 0.0
	material.metallic_specular = 0.0
	var image: Image = await _view.capture()
	var table := (load(TableChoice.COAT_SET) as LobeTableSet).table_at(Vector2(0.1, 0.1))
	for x: int in [24, 34, 42]:
		var view := Vector3(0.0, 0.0, 1.0)
		var local := Kit.sphere_frame(Kit.sphere_normal(x, 20, SIDE)).transposed() * view
		var sums := Oracle._sums(table, Basis.IDENTITY, local)
		_assert_close(
			image.get_pixel(x, 20).g, 0.04 * sums[2] + 0.96 * sums[3], 0.01, "coat %d" % x
		)


func test_dielectrics_reflect_as_specular_says() -> void:
	var material := _material()
	material.albedo_color = Color.BLACK
	material.metallic = 0.0
	_view.add_child(Kit.make_sphere(material, 128))
	await _light(Kit.make_panorama(64, Oracle.light))
	# Godot: 0.16 specular², and nothing at all, at any angle, for 0.
	for specular: float in [0.5, 1.0, 0.0]:
		material.metallic_specular = specular
		var image: Image = await _view.capture()
		var f0 := 0.16 * specular * specular
		var f90 := clampf(50.0 * f0, 0.0, 1.0)
		var table := _tables.table_at(LobeMaterial3D.widths_of(material.roughness, 0.0))
		for x: int in [24, 34, 43]:
			var frame := Kit.sphere_frame(Kit.sphere_normal(x, 18, SIDE))
			var expected := Oracle.reflected(table, frame, Vector3.BACK, f0, f90, true)
			assert_float(image.get_pixel(x, 18).r).is_equal_approx(expected, 0.01 * expected + 1e-4)


func test_diffuse_light_is_the_cosines() -> void:
	# Exactly: in 1 + g·d, 1 + 2/3 g·n; in (d.z)², 1/3 + 1/4 · (n.z² − 1/3) (Ramamoorthi and Hanrahan
	# 2001, eq. 8).
	var material := _material()
	material.metallic = 0.0
	material.metallic_specular = 0.0
	_view.add_child(Kit.make_sphere(material, 128))
	await _light(Kit.make_panorama(128, Oracle.light))
	var linear: Image = await _view.capture()
	await _light(
		Kit.make_panorama(128, func(d: Vector3) -> Color: return Color.WHITE * (d.x * d.x))
	)
	var square: Image = await _view.capture()
	for y in range(3, SIDE, 6):
		for x in range(3, SIDE, 6):
			var normal := Kit.sphere_normal(x, y, SIDE)
			if normal.z < 0.2:
				continue
			var expected := 1.0 + 2.0 / 3.0 * Oracle.GRADIENT.dot(normal)
			_assert_close(linear.get_pixel(x, y).g, expected, 0.015, "linear at %s" % normal)
			var bent := 1.0 / 3.0 + 0.25 * (normal.x * normal.x - 1.0 / 3.0)
			assert_float(square.get_pixel(x, y).g).is_equal_approx(bent, 0.012)


func test_diffuse_light_shows_no_star() -> void:
	# Bright and dark sectors around the view: band 4 has them, the cosine hardly, least of all about
	# the axis. What turns with the frame about the normal shows there.
	var material := _material()
	material.metallic = 0.0
	material.metallic_specular = 0.0
	_view.add_child(Kit.make_sphere(material, 128))
	var sectors := func(d: Vector3) -> Color:
		var sine := Vector2(d.x, d.y).length()
		return Color.WHITE * (1.0 + 0.9 * pow(sine, 4.0) * cos(4.0 * atan2(d.y, d.x)))
	await _light(Kit.make_panorama(128, sectors))
	var image: Image = await _view.capture()
	@warning_ignore("integer_division")
	var middle := SIDE / 2
	for y in range(middle - 3, middle + 3):
		for x in range(middle - 3, middle + 3):
			_assert_close(image.get_pixel(x, y).g, 1.0, 0.005, "(%d, %d)" % [x, y])


func test_orm_and_its_parts_agree() -> void:
	var material := _material()
	material.roughness = 0.8
	material.metallic = 0.9
	var quad := SphereImpostor.make_quad(material)
	_view.add_child(quad)
	await _light(Kit.make_panorama(64, Oracle.light))
	material.ao_enabled = true
	material.orm_texture = _plain(Color(0.7, 0.5, 0.3))
	var together := await _middle()
	material.orm_texture = null
	material.ao_texture = _plain(Color(0.7, 0.0, 0.0))
	material.roughness_texture = _plain(Color(0.5, 0.5, 0.5))
	material.roughness_texture_channel = BaseMaterial3D.TEXTURE_CHANNEL_GRAYSCALE
	material.metallic_texture = _plain(Color(0.0, 0.0, 0.0, 0.3))
	material.metallic_texture_channel = BaseMaterial3D.TEXTURE_CHANNEL_ALPHA
	_assert_close(await _middle(), together, 0.004, "parts")
	# And they do something.
	material.ao_texture = null
	assert_float(await _middle()).is_greater(1.02 * together)


func test_emission_texture() -> void:
	var material := _material()
	material.albedo_color = Color.BLACK
	material.emission = Color(0.5, 0.5, 0.5)
	material.emission_enabled = true
	material.emission_energy_multiplier = 2.0
	# sRGB 188/255 is 0.5028865 linear, 0.5 is 0.2140411.
	var bytes := Image.create_empty(4, 4, false, Image.FORMAT_RGB8)
	bytes.fill(Color8(188, 188, 188))
	material.emission_texture = ImageTexture.create_from_image(bytes)
	_view.add_child(SphereImpostor.make_quad(material))
	await _light(Kit.constant(0.0))
	_assert_close(await _middle(), 2.0 * (0.2140411 + 0.5028865), 0.01, "added")
	material.emission_operator = BaseMaterial3D.EMISSION_OP_MULTIPLY
	_assert_close(await _middle(), 2.0 * 0.2140411 * 0.5028865, 0.01, "multiplied")


func test_texture_coordinates_are_scaled_and_moved() -> void:
	var material := _material()
	var picture := Image.create_empty(2, 2, false, Image.FORMAT_RGBF)
	picture.set_pixel(1, 1, Color.WHITE)
	material.albedo_texture = ImageTexture.create_from_image(picture)
	material.texture_filter = BaseMaterial3D.TEXTURE_FILTER_NEAREST
	_view.add_child(SphereImpostor.make_quad(material))
	await _light(Kit.constant(1.0))
	var plain: Image = await _view.capture()
	assert_float(plain.get_pixel(36, 36).g).is_greater(0.3)
	assert_float(plain.get_pixel(12, 12).g).is_less(0.01)
	material.uv1_offset = Vector3(0.5, 0.5, 0.0)
	assert_float((await _view.capture() as Image).get_pixel(12, 12).g).is_greater(0.3)
	material.uv1_offset = Vector3.ZERO
	material.uv1_scale = Vector3(2.0, 2.0, 1.0)
	assert_float((await _view.capture() as Image).get_pixel(18, 18).g).is_greater(0.3)


func test_transparency() -> void:
	var material := _material()
	material.albedo_color = Color(1.0, 1.0, 1.0, 0.25)
	_view.add_child(SphereImpostor.make_quad(material))
	await _light(Kit.constant(1.0))
	var opaque := await _middle()
	material.transparency = BaseMaterial3D.TRANSPARENCY_ALPHA
	var image: Image = await _view.capture()
	# Compatibility blends sRGB values.
	var expected := 0.25 * opaque
	if LinearViewport.is_compatibility():
		expected = Color(0.25, 0.25, 0.25).srgb_to_linear().r * opaque
	_assert_close(image.get_pixel(MIDDLE, MIDDLE).r, expected, 0.03, "alpha")
	material.transparency = BaseMaterial3D.TRANSPARENCY_ALPHA_SCISSOR
	assert_float(await _middle()).is_equal(0.0)
	material.alpha_scissor_threshold = 0.2
	_assert_close(await _middle(), opaque, 0.01, "scissor")
	material.transparency = BaseMaterial3D.TRANSPARENCY_ALPHA_HASH
	image = await _view.capture()
	if LinearViewport.is_compatibility():
		# It has no alpha hash, and blends.
		_assert_close(image.get_pixel(MIDDLE, MIDDLE).r, expected, 0.03, "hash")
		return
	var covered := 0
	for y in SIDE:
		for x in SIDE:
			covered += 1 if image.get_pixel(x, y).r > 0.5 * opaque else 0
	assert_float(float(covered) / (SIDE * SIDE)).is_equal_approx(0.25, 0.06)


func test_back_faces() -> void:
	var material := _material()
	var quad := SphereImpostor.make_quad(material)
	_view.add_child(quad)
	await _light(Kit.make_panorama(64, Oracle.light))
	quad.basis = Basis(Vector3(0.6, 0.8, 0.0), 0.5)
	var front := await _middle()
	quad.basis *= Basis(Vector3.UP, PI)
	assert_float(await _middle()).is_equal(0.0)
	# Lit as a front face of the other side.
	material.cull_mode = BaseMaterial3D.CULL_DISABLED
	_assert_close(await _middle(), front, 0.005, "back")
	material.cull_mode = BaseMaterial3D.CULL_FRONT
	assert_float(await _middle()).is_greater(0.0)
	quad.basis *= Basis(Vector3.UP, PI)
	assert_float(await _middle()).is_equal(0.0)


func _material() -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.4
	material.table_set = _tables
	return material


func _light(panorama: Texture2D) -> void:
	_environment.panorama = panorama
	await _environment.rebuild()


func _middle() -> float:
	var image: Image = await _view.capture()
	return image.get_pixel(MIDDLE, MIDDLE).r


func _plain(colour: Color) -> ImageTexture:
	var image := Image.create_empty(4, 4, false, Image.FORMAT_RGBAF)
	image.fill(colour)
	return ImageTexture.create_from_image(image)


# All over the sphere but the rim, where a polygon has no pixels.
func _assert_range(image: Image, least: float, most: float, what: String) -> void:
	for y in SIDE:
		for x in SIDE:
			if Kit.sphere_normal(x, y, SIDE).z > 0.15:
				var got := image.get_pixel(x, y).g
				if got < least or got > most:
					fail("%s: %f at (%d, %d)" % [what, got, x, y])
					return
	assert_bool(true).is_true()


func _assert_close(got: float, expected: float, tolerance: float, what: String) -> void:
	(
		assert_float(got / expected)
		. append_failure_message("%s: %f, expected %f" % [what, got, expected])
		. is_equal_approx(1.0, tolerance)
	)
