extends GdUnitTestSuite
## White furnace for whole materials: in light of 1 from all sides, what is white is white, whatever
## metal, plastic, coat, roughness and brushing there is, from all views.

const Kit := preload("support/render_kit.gd")
const SIDE := 64
const TOLERANCE := 0.005
const ROUGHNESSES: Array[float] = [0.05, 0.3, 0.7, 1.0]
const METALLIC: Array[float] = [0.0, 0.5, 1.0]
const COATS: Array[float] = [0.0, 0.6]
const BRUSHINGS := [[0.0], [0.9]]
# As far as they go.
const EXTREMES: Array[float] = [-1.0, 1.1]

var _view: LinearViewport
var _environment: LobeEnvironment3D
var _spheres: Array[MeshInstance3D] = []


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_environment = LobeEnvironment3D.new()
	_environment.panorama = Kit.constant(1.0)
	_view.add_child(_environment)
	_spheres.clear()
	# One for each roughness, in the corners of the picture.
	for i in ROUGHNESSES.size():
		var sphere := Kit.make_sphere(null, 32)
		sphere.scale = 0.5 * Vector3.ONE
		sphere.position = Vector3(-0.5 + (i % 2), 0.5 if i < 2 else -0.5, 0.0)
		_view.add_child(sphere)
		_spheres.append(sphere)


func after_test() -> void:
	_view.free()


func test_metal_plastic_and_coat(brushing: float, _test_parameters := BRUSHINGS) -> void:
	assert_bool(await _environment.rebuild()).is_true()
	for metallic in METALLIC:
		for coat in COATS:
			_show(_material.bind(metallic, coat, brushing))
			await _check("metallic %s, coat %s" % [metallic, coat])


func test_extremes() -> void:
	assert_bool(await _environment.rebuild()).is_true()
	for brushing in EXTREMES:
		_show(_material.bind(0.5, 1.0, brushing))
		await _check("anisotropy %s" % brushing)
		_show(_mapped.bind(0.0, brushing))
		await _check("maps, anisotropy %s" % brushing)


func test_all_amounts_of_specular() -> void:
	assert_bool(await _environment.rebuild()).is_true()
	for amount: float in [0.0, 0.2, 1.0]:
		for metallic: float in [0.0, 0.5]:
			_show(
				func(roughness: float) -> LobeMaterial3D:
					var material := _material(roughness, metallic, 0.0, 0.0)
					material.metallic_specular = amount
					return material
			)
			await _check("specular %s, metallic %s" % [amount, metallic])


func test_maps_of_metal_and_roughness(brushing: float, _test_parameters := BRUSHINGS) -> void:
	assert_bool(await _environment.rebuild()).is_true()
	for coat in COATS:
		_show(_mapped.bind(coat, brushing))
		await _check("maps, coat %s" % coat)


func test_in_a_room() -> void:
	assert_bool(await _environment.rebuild()).is_true()
	# The light of 1 fades from the room's into the environment's within the picture.
	var room := LobeProbe3D.new()
	var light := LobeLight.new()
	var faces: Array[Image] = []
	for face in 6:
		var image := Image.create_empty(1, 1, false, Image.FORMAT_RGBAH)
		image.fill(Color.WHITE)
		faces.append(image)
	light.faces = faces
	light.is_even = true
	room.light = light
	room.size = Vector3(4.0, 8.0, 8.0)
	room.position = Vector3(-2.0, 0.0, 0.0)
	room.blend_distance = 0.5
	_view.add_child(room)
	for metallic: float in [0.0, 0.5, 1.0]:
		_show(_material.bind(metallic, 0.5 if metallic == 0.5 else 0.0, 0.9))
		await _check("room, metallic %s" % metallic)


func _show(make: Callable) -> void:
	for i in ROUGHNESSES.size():
		_spheres[i].material_override = make.call(ROUGHNESSES[i])


static func _material(
	roughness: float, metallic: float, coat: float, brushing: float
) -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.roughness = roughness
	material.metallic = metallic
	material.clearcoat_enabled = coat > 0.0
	material.clearcoat = coat
	material.anisotropy_enabled = brushing != 0.0
	material.anisotropy = brushing
	return material


# Metal to the right, rougher below, and open to all sides.
static func _mapped(roughness: float, coat: float, brushing: float) -> LobeMaterial3D:
	var image := Image.create_empty(16, 16, false, Image.FORMAT_RGB8)
	for y in 16:
		for x in 16:
			image.set_pixel(x, y, Color(1.0, 0.25 + 0.05 * y, x / 15.0))
	var material := _material(roughness, 1.0, coat, brushing)
	material.ao_enabled = true
	material.orm_texture = ImageTexture.create_from_image(image)
	return material


func _check(what: String) -> void:
	var image: Image = await _view.capture()
	var covered := 0
	var worst := 0.0
	var where := ""
	for y in SIDE:
		for x in SIDE:
			var pixel := image.get_pixel(x, y)
			if pixel.a < 1.0:
				continue
			covered += 1
			var error := absf(pixel.g - 1.0)
			if error > worst:
				worst = error
				where = "%s, (%d, %d): %s" % [what, x, y, pixel]
	assert_int(covered).override_failure_message(what).is_greater(SIDE * SIDE / 2)
	assert_float(worst).override_failure_message(where).is_less(TOLERANCE)
