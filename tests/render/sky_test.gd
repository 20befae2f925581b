extends GdUnitTestSuite
## A mirror shows the sky that the camera sees: same colours, same places, for every kind of sky.

const Kit := preload("support/render_kit.gd")
const EnvironmentSource := preload("res://addons/lobelight/runtime/live/environment_source.gd")
const SkyKit := preload("support/sky_kit.gd")
const SIDE := 48
# The kind of sky, its rotation, the energy of the background, whether the camera has a perspective.
const SKIES := [
	["panorama", Vector3.ZERO, 1.0, false],
	["panorama", Vector3(0.4, 1.1, -0.3), 0.7, true],
	["procedural", Vector3.ZERO, 1.0, true],
	["procedural", Vector3(0.4, 1.1, -0.3), 2.5, false],
	["physical", Vector3.ZERO, 1.0, false],
	["physical", Vector3(0.0, 2.0, 0.0), 0.5, true],
	["shader", Vector3.ZERO, 1.0, true],
	["shader", Vector3(0.4, 1.1, -0.3), 3.0, false],
	["colour", Vector3.ZERO, 0.6, false],
	["clear", Vector3.ZERO, 1.0, false],
]

var _view: LinearViewport
var _sphere: MeshInstance3D
var _environment: LobeEnvironment3D
var _surroundings: Environment


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_surroundings = _view.camera.environment
	_view.add_child(SkyKit.make_sun())
	_environment = LobeEnvironment3D.new()
	_environment.filter = LobeEnvironment3D.Filter.BOX
	_environment.size = 64
	_view.add_child(_environment)
	_sphere = SkyKit.make_mirror()
	_view.add_child(_sphere)


func after_test() -> void:
	_view.free()


func test_mirror_shows_the_sky(
	kind: String, turn: Vector3, energy: float, perspective: bool, _test_parameters := SKIES
) -> void:
	SkyKit.set_sky(_surroundings, kind)
	_surroundings.sky_rotation = turn
	_surroundings.background_energy_multiplier = energy
	var camera := _view.camera
	camera.look_at_from_position(Vector3(2.5, 1.5, 2.0), Vector3.ZERO)
	if perspective:
		camera.set_perspective(40.0, 0.1, 10.0)
	assert_bool(await _environment.rebuild()).is_true()
	var mirrored: Image = await _view.capture()
	await _assert_sky(mirrored, SkyKit.all_reflected(camera, SIDE))


# Fog hides a part of the sky, from all sides.
func test_fog_before_the_sky() -> void:
	SkyKit.set_sky(_surroundings, "panorama")
	_surroundings.fog_enabled = true
	_surroundings.fog_light_color = Color(0.9, 0.3, 0.1)
	_surroundings.fog_sky_affect = 0.5
	# It would hide the mirror as well.
	_surroundings.fog_density = 0.0
	await _environment.rebuild()
	var mirrored: Image = await _view.capture()
	await _assert_sky(mirrored, SkyKit.all_reflected(_view.camera, SIDE))


func test_the_world_s_environment() -> void:
	_view.camera.environment = null
	var world := WorldEnvironment.new()
	world.environment = _surroundings
	_view.add_child(world)
	_surroundings.background_color = Color(0.0, 1.0, 0.0)
	await _environment.rebuild()
	var image: Image = await _view.capture()
	assert_float(image.get_pixel(24, 24).g).is_equal_approx(1.0, 0.01)


func test_brightness_that_eight_bits_do_not_hold() -> void:
	SkyKit.set_sky(_surroundings, "panorama")
	_sky_panorama().panorama = Kit.constant(4.0)
	_surroundings.background_energy_multiplier = 50.0
	await _environment.rebuild()
	var image: Image = await _view.capture()
	# Compatibility takes colours of skies for sRGB and decodes them by a cubic (Godot,
	# drivers/gles3/shaders/tonemap_inc.glsl), up to what half floats hold.
	var expected := 200.0
	if LinearViewport.is_compatibility():
		expected = 200.0 * (200.0 * (200.0 * 0.305306011 + 0.682171111) + 0.012522878)
		expected = minf(expected, 65504.0)
	assert_float(image.get_pixel(24, 24).r / expected).is_equal_approx(1.0, 0.01)


func test_the_skys_own_panorama_is_taken_but_in_compatibility() -> void:
	SkyKit.set_sky(_surroundings, "panorama")
	await _environment.rebuild()
	var kinds := EnvironmentSource.Kind
	var expected := kinds.SKY_VIEWS if LinearViewport.is_compatibility() else kinds.SKY_PANORAMA
	assert_int(_environment._live.source.get_kind()).is_equal(expected)
	# Fog is drawn by views.
	_surroundings.fog_enabled = true
	await _environment.rebuild()
	assert_int(_environment._live.source.get_kind()).is_equal(kinds.SKY_VIEWS)


func test_other_backgrounds_are_black() -> void:
	_surroundings.background_mode = Environment.BG_CANVAS
	await _environment.rebuild()
	var image: Image = await _view.capture()
	assert_float(image.get_pixel(24, 24).r).is_equal(0.0)


# Compares what the mirror has shown, by the directions that it reflected, with the sky.
func _assert_sky(mirrored: Image, directions: PackedVector3Array) -> void:
	_sphere.hide()
	_view.size = Vector2i(128, 128)
	var around: Array[Image] = await SkyKit.look_around(_view)
	var found := SkyKit.compare(mirrored, directions, around)
	# Horizons and suns are as sharp as the texels of the map, 1.4 degrees.
	assert_float(found.x).is_greater(0.95)
	assert_float(found.y).is_less(0.015)


func _sky_panorama() -> PanoramaSkyMaterial:
	return _surroundings.sky.sky_material
