extends GdUnitTestSuite
## Metal of any roughness under a panorama whose sun of 10^6 covers four texels, as it is imported:
## against the integral by brute force, which takes most of its samples where the sun is.

const Kit := preload("support/render_kit.gd")
const LightFormats := preload("res://addons/lobelight/editor/light/light_formats.gd")
const PanoramaFilter := preload("res://addons/lobelight/editor/light/panorama_filter.gd")

# And how far the sums over the pictures may be apart: a mirror's sun is about one pixel wide.
const ROUGHNESSES := [[0.0, 0.04], [0.1, 0.02], [0.3, 0.01], [0.6, 0.01]]
const SETS := "res://addons/lobelight/tables/ggx_8.res"
const HEIGHT := 96
const SIDE := 112
const SUN := 1e6
# What is drawn has half floats: it is drawn darker than it is.
const ENERGY := 1.0 / 64.0

var _map := ""
var _light: LobeLight
var _view: LinearViewport


func before() -> void:
	var folder := create_temp_dir("sun")
	_map = ProjectSettings.globalize_path(folder.path_join("sun.exr"))
	var image := Kit.make_panorama(HEIGHT, _sky).get_image()
	for texel in 4:
		@warning_ignore("integer_division")
		image.set_pixel(112 + texel % 2, 28 + texel / 2, Color(SUN, 0.9 * SUN, 0.7 * SUN))
	image.convert(Image.FORMAT_RGBF)
	var pixels := image.get_data().to_float32_array()
	var problem := NativeLibrary.save_exr(_map, 2 * HEIGHT, HEIGHT, pixels)
	assert_str(problem).is_empty()
	var request := PanoramaFilter.make_request(image, 128)
	request["max_sources"] = 4
	var result: Dictionary = NativeLibrary.create(&"LobeLightFilter").call("filter", request)
	_light = PanoramaFilter.make_light(request, result)
	assert_str(LightFormats.convert_light(_light, LightFormats.Format.SHARED_EXPONENT)).is_empty()
	_light.energy = ENERGY


func after() -> void:
	clean_temp_dir()


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)


func after_test() -> void:
	_view.free()


func test_metal_under_a_sun(
	roughness: float, share: float, _test_parameters := ROUGHNESSES
) -> void:
	var tables: LobeTableSet = load(SETS)
	var width := maxf(roughness * roughness, tables.widths[0])
	var table := tables.table_at(width * Vector2.ONE)
	var sphere := SphereImpostor.make(table)
	(sphere.mesh.surface_get_material(0) as LobeMaterial3D).light = _light
	_view.add_child(sphere)
	await _view.measure_gpu_time(2)
	var drawn := _read(await _view.capture())
	var reference: Dictionary = NativeLibrary.create(&"LobeReference").call(
		"render_sphere",
		{"env": _map, "brdf": "ggx", "alpha": [width, width], "size": SIDE, "samples": 96}
	)
	assert_str(reference.get("error", "")).is_empty()
	var expected: PackedFloat32Array = reference["pixels"]
	var figures := _measure(expected, drawn)
	var text := "%.1f dB, energy %.4f, peak %.3f, the reference's %.3f" % Array(figures)
	assert_float(figures[0]).override_failure_message(text).is_greater(35.0)
	assert_float(figures[1]).override_failure_message(text).is_between(1.0 - share, 1.0 + share)
	# No pixel sticks out of its neighbours that does not in the reference.
	assert_float(figures[2]).override_failure_message(text).is_less(1.1 * figures[3])
	# And the reference is one.
	var error := _sum(reference["standard_error"]) / _sum(expected)
	assert_float(error).is_less(0.01)


static func _sky(direction: Vector3) -> Color:
	var blue := 0.5 + 0.5 * direction.y
	return Color(0.4 + 0.1 * direction.x, 0.5, 0.3 + blue)


# Red, green and blue, as bright as the light is.
static func _read(image: Image) -> PackedFloat32Array:
	image.convert(Image.FORMAT_RGBF)
	var values := image.get_data().to_float32_array()
	for i in values.size():
		values[i] /= ENERGY
	return values


# PSNR as ./dev compare has it, the sums' ratio, and for both pictures the most that a pixel is
# brighter than each of its neighbours.
static func _measure(expected: PackedFloat32Array, drawn: PackedFloat32Array) -> PackedFloat64Array:
	var pixels: PackedInt32Array = []
	var means: PackedFloat32Array = []
	for at in SIDE * SIDE:
		@warning_ignore("integer_division")
		if Kit.sphere_normal(at % SIDE, at / SIDE, SIDE).z > 0.03:
			pixels.append(at)
			means.append((expected[3 * at] + expected[3 * at + 1] + expected[3 * at + 2]) / 3.0)
	means.sort()
	@warning_ignore("integer_division")
	var exposure := 0.18 / means[means.size() / 2]
	var squares := 0.0
	var sums := Vector2.ZERO
	for at in pixels:
		for channel in 3:
			var pair := Vector2(expected[3 * at + channel], drawn[3 * at + channel])
			sums += pair
			var shown := (pair * exposure).clamp(Vector2.ZERO, Vector2.ONE)
			squares += pow(pow(shown.x, 1.0 / 2.2) - pow(shown.y, 1.0 / 2.2), 2.0)
	var mean := maxf(squares / (3.0 * pixels.size()), 1e-12)
	return [-10.0 * log(mean) / log(10.0), sums.y / sums.x, _peak(drawn), _peak(expected)]


static func _peak(picture: PackedFloat32Array) -> float:
	var most := 0.0
	for y in range(1, SIDE - 1):
		for x in range(1, SIDE - 1):
			if Kit.sphere_normal(x, y, SIDE).z < 0.2:
				continue
			var around := 0.0
			for step: Vector2i in [
				Vector2i(-1, -1),
				Vector2i(0, -1),
				Vector2i(1, -1),
				Vector2i(-1, 0),
				Vector2i(1, 0),
				Vector2i(-1, 1),
				Vector2i(0, 1),
				Vector2i(1, 1)
			]:
				around = maxf(around, picture[3 * ((y + step.y) * SIDE + x + step.x) + 1])
			most = maxf(most, picture[3 * (y * SIDE + x) + 1] / maxf(around, 1e-6))
	return most


static func _sum(values: PackedFloat32Array) -> float:
	var sum := 0.0
	for value in values:
		sum += value
	return sum
