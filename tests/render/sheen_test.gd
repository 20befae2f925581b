extends GdUnitTestSuite
## The sheen of LobeMaterial3D: what it takes the base loses, and it is what its lobes say.

const Kit := preload("support/render_kit.gd")
const Oracle := preload("support/material_oracle.gd")
const SIDE := 48
const SHEENS := "res://addons/lobelight/tables/charlie_4.res"

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
	_view.add_child(Kit.make_sphere(material, 128))
	await _light(Kit.constant(1.0))
	for metallic: float in [1.0, 0.0]:
		for sheen: float in [0.0, 0.5, 1.0]:
			material.metallic = metallic
			material.sheen_roughness = sheen
			material.clearcoat_enabled = sheen == 0.5
			await _expect_white("metallic %s, sheen %s" % [metallic, sheen])


func test_anisotropic_metal_keeps_its_light() -> void:
	var material := _material()
	material.metallic = 1.0
	material.anisotropy_enabled = true
	material.anisotropy = 0.8
	_view.add_child(Kit.make_sphere(material, 128))
	await _light(Kit.constant(1.0))
	await _expect_white("anisotropic metal")


func test_sheen_of_probes_is_that_of_an_environment() -> void:
	var material := _material()
	material.albedo_color = Color.BLACK
	material.metallic = 1.0
	_view.add_child(Kit.make_sphere(material, 64))
	await _light(Kit.make_panorama(32, Oracle.light))
	var expected: Image = await _view.capture()
	var probe := LobeProbe3D.new()
	probe.light = _environment.get_light()
	probe.size = 4000.0 * Vector3.ONE
	_view.add_child(probe)
	var image: Image = await _view.capture()
	for x: int in [24, 34, 42]:
		var difference := image.get_pixel(x, 20).g - expected.get_pixel(x, 20).g
		assert_float(absf(difference)).is_less(1.0 / 255.0)


func test_sheen_is_what_its_lobes_reflect() -> void:
	var material := _material()
	material.albedo_color = Color.BLACK
	material.metallic_specular = 0.0
	material.sheen_color = Color(1.0, 0.5, 0.0)
	material.sheen_roughness = 0.7
	_view.add_child(Kit.make_sphere(material, 128))
	await _light(Kit.make_panorama(64, Oracle.light))
	var image: Image = await _view.capture()
	var tables: LobeTableSet = load(SHEENS)
	var table := tables.table_at(Vector2(0.49, 0.49))
	for x: int in [24, 34, 43]:
		var frame := Kit.sphere_frame(Kit.sphere_normal(x, 18, SIDE))
		var expected := Oracle.reflected(table, frame, Vector3.BACK, 1.0, 1.0, false)
		var got := image.get_pixel(x, 18)
		assert_float(got.r).is_equal_approx(expected, 0.015 * expected)
		var half := Color(0.0, 0.5, 0.0).srgb_to_linear().g
		assert_float(got.g).is_equal_approx(half * expected, 0.015 * expected)
		assert_float(got.b).is_less(1e-3)


func test_a_texture_says_where_the_sheen_is() -> void:
	var material := _material()
	material.albedo_color = Color.BLACK
	material.metallic = 1.0
	var image := Image.create_empty(4, 4, false, Image.FORMAT_RGB8)
	image.fill(Color(0.0, 1.0, 0.0))
	material.sheen_texture = ImageTexture.create_from_image(image)
	_view.add_child(Kit.make_sphere(material, 64))
	await _light(Kit.constant(1.0))
	var got: Color = ((await _view.capture()) as Image).get_pixel(40, 20)
	# Metal is as bright as Schlick's rim in all channels.
	assert_float(got.g - got.r).is_greater(0.1)


func test_sheen_costs_four_lobes_and_nothing_where_it_is_off() -> void:
	var material := _material()
	var with := material.get_fetches()
	material.sheen_enabled = false
	var without := material.get_fetches()
	assert_int(with["environment"] - without["environment"]).is_equal(4)
	assert_int(with["samplers"] - without["samplers"]).is_equal(1)
	assert_str(material.get_shader_code()).not_contains("SHEEN")
	material.sheen_enabled = true
	material.sheen_color = Color.BLACK
	assert_str(material.get_shader_code()).not_contains("SHEEN")


func _material() -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.roughness = 0.4
	material.table_set = _tables
	material.sheen_enabled = true
	return material


func _light(panorama: Texture2D) -> void:
	_environment.panorama = panorama
	await _environment.rebuild()


# All over the sphere but the rim, where a polygon has no pixels.
func _expect_white(what: String) -> void:
	var image: Image = await _view.capture()
	var least := INF
	var most := 0.0
	for y in SIDE:
		for x in SIDE:
			if Kit.sphere_normal(x, y, SIDE).z > 0.15:
				least = minf(least, image.get_pixel(x, y).g)
				most = maxf(most, image.get_pixel(x, y).g)
	assert_float(least).append_failure_message(what).is_greater(0.995)
	assert_float(most).append_failure_message(what).is_less(1.005)
