extends GdUnitTestSuite
## That a frozen material, as exports have it, looks as the one that it was made of.

const Features := preload("res://addons/lobelight/editor/export/features.gd")
const FrozenMaterials := preload("res://addons/lobelight/editor/export/frozen_materials.gd")
const Kit := preload("support/render_kit.gd")
const Oracle := preload("support/material_oracle.gd")
const OnDemand := preload("res://addons/lobelight/runtime/on_demand.gd")
const SIDE := 48

const SURFACES := [
	[
		{
			"metallic": 1.0,
			"anisotropy_enabled": true,
			"anisotropy": 0.8,
			"anisotropy_rotation": 0.5,
			"clearcoat_enabled": true,
		}
	],
	[{"roughness_texture": 0.3, "normal_enabled": true, "normal_texture": 0.5, "metallic": 0.5}],
	[{"albedo_texture": 0.6, "uv1_triplanar": true, "ao_enabled": true, "ao_texture": 0.4}],
	[
		{
			"sheen_enabled": true,
			"emission_enabled": true,
			"emission": Color.DARK_RED,
			"uv1_offset": Vector3(0.3, 0.2, 0.0),
			"albedo_texture": 0.8,
		}
	],
]

var _view: LinearViewport


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	var environment := LobeEnvironment3D.new()
	environment.panorama = Kit.make_panorama(32, Oracle.light)
	_view.add_child(environment)


func after_test() -> void:
	_view.free()


func test_a_frozen_material_looks_the_same(
	properties: Dictionary, _test_parameters := SURFACES
) -> void:
	var material := LobeMaterial3D.new()
	material.roughness = 0.4
	material.albedo_color = Color(0.9, 0.6, 0.3)
	for name: String in properties:
		material.set(name, _make(name, properties[name]))
	var sphere: MeshInstance3D = Kit.make_sphere(material, 32)
	_view.add_child(sphere)
	await _view.capture()
	var expected: Image = await _view.capture()
	var frozen := FrozenMaterials.new()
	sphere.material_override = frozen.make(material)
	sphere.mesh.surface_set_material(0, null)
	assert_str(frozen.why_not).is_empty()
	material = null
	var image: Image = await _view.capture()
	assert_float(expected.get_pixel(24, 24).v).is_greater(0.05)
	for y in range(0, SIDE, 3):
		for x in range(0, SIDE, 3):
			var wanted := expected.get_pixel(x, y)
			var got := image.get_pixel(x, y)
			assert_float(absf(got.r - wanted.r) + absf(got.g - wanted.g)).is_less(1.0 / 255.0)


func test_a_frozen_material_shows_sources_where_there_are_any() -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	var frozen := FrozenMaterials.new()
	var features := Features.new()
	features.add(OnDemand.SOURCES, "a test")
	frozen.freeze(features, Callable())
	var shown := frozen.make(material)
	material = null
	_view.add_child(Kit.make_sphere(shown, 32))
	var before: Image = await _view.capture()
	var light := LobeLight.make_constant(Color.BLACK, true)
	var image := Image.create_empty(4, 3, false, Image.FORMAT_RGBAF)
	image.set_pixel(0, 0, Color(0.0, 0.0, 1.0, 0.05))
	image.set_pixel(0, 1, Color(5.0, 5.0, 5.0))
	light.sources = ImageTexture.create_from_image(image)
	shown.light = light
	await get_tree().process_frame
	var lit: Image = await _view.capture()
	assert_float(lit.get_pixel(24, 24).r).is_greater(0.1)
	shown.light = null
	await get_tree().process_frame
	var after: Image = await _view.capture()
	assert_float(after.get_pixel(24, 24).r).is_equal_approx(before.get_pixel(24, 24).r, 1e-3)


static func _make(name: String, value: Variant) -> Variant:
	if "_texture" not in name:
		return value
	var image := Image.create_empty(8, 8, false, Image.FORMAT_RGBA8)
	for y in 8:
		for x in 8:
			var varied: float = clampf(value + 0.05 * ((x + 2 * y) % 4), 0.0, 1.0)
			image.set_pixel(
				x, y, Color(varied, varied, 1.0 if name == "normal_texture" else varied)
			)
	image.generate_mipmaps()
	return ImageTexture.create_from_image(image)
