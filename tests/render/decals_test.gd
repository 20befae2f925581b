extends GdUnitTestSuite
## What decals change of a material's light: the engine applies them after the material's shader.

const Kit := preload("support/render_kit.gd")
const SIDE := 32

var _view: LinearViewport
var _material: LobeMaterial3D
var _quad: MeshInstance3D


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_material = LobeMaterial3D.new()
	_material.metallic_specular = 0.0
	_quad = SphereImpostor.make_quad(_material)
	_view.add_child(_quad)
	var environment := LobeEnvironment3D.new()
	_view.add_child(environment)
	environment.panorama = Kit.constant(0.5)
	await environment.rebuild()


func after_test() -> void:
	_view.free()


## Diffuse light that the engine gives takes the decal's colour, as Godot's material has it.
func test_a_decal_colours_diffuse_light_from_the_engine() -> void:
	var surroundings := _view.camera.environment
	surroundings.ambient_light_source = Environment.AMBIENT_SOURCE_COLOR
	surroundings.ambient_light_color = Color.WHITE
	surroundings.ambient_light_energy = 0.5
	_material.diffuse_light = LobeMaterial3D.DiffuseLight.ENGINE
	_add_decal()
	var found := await _middle()
	var standard := StandardMaterial3D.new()
	standard.metallic_specular = 0.0
	_quad.material_override = standard
	var expected := await _middle()
	for channel in 3:
		assert_float(found[channel]).is_equal_approx(expected[channel], 0.005)
	# There are no decals in Compatibility.
	if not LinearViewport.is_compatibility():
		assert_float(found.r).is_greater(10.0 * found.g)


## The environment's light does not know of decals, except of their emission.
func test_a_decal_only_adds_to_the_environments_light() -> void:
	_material.diffuse_light = LobeMaterial3D.DiffuseLight.ENVIRONMENT
	var before := await _middle()
	var decal := _add_decal()
	decal.texture_emission = _plain(Color.BLUE)
	var found := await _middle()
	assert_float(found.g).is_equal_approx(before.g, 0.005)
	if not LinearViewport.is_compatibility():
		assert_float(found.b).is_greater(before.b + 0.5)


func _add_decal() -> Decal:
	var decal := Decal.new()
	decal.size = Vector3(1.0, 2.0, 1.0)
	decal.basis = Basis(Vector3.RIGHT, 0.5 * PI)
	decal.texture_albedo = _plain(Color.RED)
	_view.add_child(decal)
	return decal


func _middle() -> Color:
	# The engine needs a frame to put a decal's textures together.
	await _view.capture()
	var image: Image = await _view.capture()
	@warning_ignore("integer_division")
	return image.get_pixel(SIDE / 2, SIDE / 2)


static func _plain(colour: Color) -> ImageTexture:
	var image := Image.create_empty(16, 16, true, Image.FORMAT_RGBA8)
	image.fill(colour)
	image.generate_mipmaps()
	return ImageTexture.create_from_image(image)
