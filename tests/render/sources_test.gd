extends GdUnitTestSuite
## Compact lights that were taken out of the map: what materials reflect of them, against the
## integral over the source of BRDFs written from their papers.

const BrdfOracle := preload("support/brdf_oracle.gd")
const Kit := preload("support/render_kit.gd")
const SIDE := 32
# Every so many pixels are looked at.
const STEP := 2
const SETS: Dictionary[String, String] = {
	"ggx": "res://addons/lobelight/tables/ggx_8.res",
	"ward": "res://addons/lobelight/tables/ward_8.res",
}
const DIRECTION := Vector3(0.45, 0.4, 0.8)
const CASES := [
	["ggx", Vector2(0.03, 0.03), 0.01],
	["ggx", Vector2(0.1, 0.1), 0.02],
	["ggx", Vector2(0.36, 0.36), 0.006],
	["ggx", Vector2(0.05, 0.2), 0.02],
	["ggx", Vector2(0.3, 0.1), 0.01],
	["ward", Vector2(0.1, 0.1), 0.02],
	["ward", Vector2(0.05, 0.3), 0.01],
]
# Radial and azimuthal points of the integral.
const RINGS := 20
const SPOKES := 24

var _view: LinearViewport
var _sphere: MeshInstance3D


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)


func after_test() -> void:
	_view.free()
	_sphere = null


func test_reflections_of_a_source(
	brdf: String, alpha: Vector2, deviation: float, _test_parameters := CASES
) -> void:
	var light := _light_of([[DIRECTION, deviation, Color(100.0, 50.0, 10.0)]])
	_show(_metal(brdf, alpha, light))
	var value := func(i: Vector3, o: Vector3) -> float:
		return BrdfOracle.value(brdf, alpha, i, o) * i.z
	_compare(await _view.capture(), deviation, 100.0, value, 45.0)


func test_a_coat() -> void:
	var material := _black(_light_of([[DIRECTION, 0.02, Color(100.0, 0.0, 0.0)]]))
	material.clearcoat_enabled = true
	material.clearcoat = 0.5
	material.clearcoat_roughness = 1.0
	_show(material)
	var value := func(i: Vector3, o: Vector3) -> float:
		var fresnel := 0.04 + 0.96 * pow(1.0 - o.dot((i + o).normalized()), 5.0)
		return 0.5 * fresnel * BrdfOracle.value("ggx", Vector2(0.1, 0.1), i, o) * i.z
	_compare(await _view.capture(), 0.02, 100.0, value, 40.0)


func test_diffuse_light() -> void:
	var material := _black(_light_of([[DIRECTION, 0.05, Color(2.0, 0.0, 0.0)]]))
	material.albedo_color = Color.WHITE
	_show(material)
	var value := func(i: Vector3, _o: Vector3) -> float: return i.z / PI
	_compare(await _view.capture(), 0.05, 2.0, value, 45.0)


# And other BRDFs than GGX and Ward, by their lobes.
func test_sheen() -> void:
	var material := _black(_light_of([[DIRECTION, 0.05, Color(20.0, 0.0, 0.0)]]))
	material.sheen_enabled = true
	material.sheen_color = Color.WHITE
	material.sheen_roughness = 0.5
	_show(material)
	var tables: LobeTableSet = load("res://addons/lobelight/tables/charlie_4.res")
	var table := tables.table_at(Vector2(0.25, 0.25))
	_compare(await _view.capture(), 0.05, 20.0, _value_of_lobes(table), 36.0)
	material = LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = table
	material.light = _light_of([[DIRECTION, 0.05, Color(20.0, 0.0, 0.0)]])
	_show(material)
	_compare(await _view.capture(), 0.05, 20.0, _value_of_lobes(table), 36.0)


# What a rough white metal's microfacets lose is made up for.
func test_white_metal() -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.8
	material.light = _light_of([[DIRECTION, 0.02, Color(10.0, 0.0, 0.0)]])
	_show(material)
	var table := (load(SETS["ggx"]) as LobeTableSet).table_at(Vector2(0.64, 0.64))
	# Of the last view.
	var albedos := {}
	var value := func(i: Vector3, o: Vector3) -> float:
		if not albedos.has(o):
			albedos.clear()
			albedos[o] = 0.0
			for lobe in table.lobes_at(o):
				albedos[o] += lobe["weight"]
		return BrdfOracle.value("ggx", Vector2(0.64, 0.64), i, o) * i.z / albedos[o]
	_compare(await _view.capture(), 0.02, 10.0, value, 40.0)


func test_four_sources_are_the_sum_of_each() -> void:
	var sources := []
	var sum := Image.create_empty(SIDE, SIDE, false, Image.FORMAT_RGBAF)
	for i in 4:
		var direction := Vector3(sin(1.7 * i), cos(1.7 * i), 0.6)
		sources.append([direction, 0.01 + 0.01 * i, Color(8.0, 4.0, 2.0)])
		_show(_metal("ggx", Vector2(0.2, 0.2), _light_of([sources[i]])))
		_add(sum, await _view.capture())
	_show(_metal("ggx", Vector2(0.2, 0.2), _light_of(sources)))
	_expect_alike(await _view.capture(), sum)


func test_half_floats_have_the_direction_in_two_parts() -> void:
	var light := _light_of([[DIRECTION, 0.01, Color(8.0, 4.0, 1.0)]])
	_show(_metal("ggx", Vector2(0.01, 0.01), light))
	var expected: Image = await _view.capture()
	var image := light.sources.get_image()
	var exact := image.get_pixel(0, 0)
	image.convert(Image.FORMAT_RGBAH)
	var rest := 1024.0 * (exact - image.get_pixel(0, 0))
	image.set_pixel(0, 2, Color(rest.r, rest.g, rest.b))
	light.sources = ImageTexture.create_from_image(image)
	_show(_metal("ggx", Vector2(0.01, 0.01), light))
	_expect_alike(await _view.capture(), expected)


func test_what_is_shut_off_sees_no_source() -> void:
	var material := _metal("ggx", Vector2(0.2, 0.2), _light_of([[DIRECTION, 0.01, Color.WHITE]]))
	material.ao_enabled = true
	material.ao_texture = ImageTexture.create_from_image(
		Image.create_empty(4, 4, false, Image.FORMAT_RGB8)
	)
	_show(material)
	var image: Image = await _view.capture()
	for x: int in [14, 18, 22]:
		assert_float(image.get_pixel(x, 12).r).is_less(1e-5)


func test_nothing_is_infinite() -> void:
	# From below, edge-on and from behind; sharp, and as wide as a window.
	for direction: Vector3 in [Vector3(0, 0, -1), Vector3(1, 0, 0), Vector3(0, 0, 1)]:
		for deviation: float in [0.0, 0.3]:
			var light := _light_of([[direction, deviation, Color(1e6, 1e6, 1e6)]])
			for alpha: Vector2 in [Vector2(0.005, 0.005), Vector2(0.005, 0.5)]:
				_show(_metal("ggx", alpha, light))
				assert_bool(Kit.is_finite_image(await _view.capture())).is_true()


func test_places_and_worlds() -> void:
	var environment := LobeEnvironment3D.new()
	environment.light = _light_of([[DIRECTION, 0.02, Color(8.0, 4.0, 1.0)]])
	_view.add_child(environment)
	_show(_metal("ggx", Vector2(0.2, 0.3), null))
	var expected: Image = await _view.capture()
	assert_float(expected.get_pixel(18, 12).r).is_greater(0.1)
	# Materials find the light of each pixel now.
	var probe := LobeProbe3D.new()
	probe.light = LobeLight.make_constant(Color.WHITE, true)
	probe.position = Vector3(50.0, 0.0, 0.0)
	_view.add_child(probe)
	_expect_alike(await _view.capture(), expected)
	# Inside the room, there is none.
	probe.position = Vector3.ZERO
	probe.size = Vector3(10.0, 10.0, 10.0)
	var inside: Image = await _view.capture()
	assert_float(inside.get_pixel(12, 20).r).is_equal_approx(inside.get_pixel(18, 12).r, 0.1)
	probe.free()
	var other := LinearViewport.new(SIDE)
	add_child(other)
	var elsewhere := LobeEnvironment3D.new()
	elsewhere.light = _light_of([[Vector3(-0.5, 0.2, 0.8), 0.05, Color(1.0, 4.0, 8.0)]])
	other.add_child(elsewhere)
	var sphere := Kit.make_sphere(_metal("ggx", Vector2(0.2, 0.3), null), 128)
	other.add_child(sphere)
	_expect_alike(await _view.capture(), expected)
	var image: Image = await other.capture()
	sphere.material_override = _metal("ggx", Vector2(0.2, 0.3), elsewhere.light)
	_expect_alike(image, await other.capture())
	assert_float(image.get_pixel(10, 14).b).is_greater(0.1)
	other.free()


func _show(material: LobeMaterial3D) -> void:
	if _sphere == null:
		_sphere = Kit.make_sphere(null, 128)
		_view.add_child(_sphere)
	_sphere.material_override = material


static func _add(sum: Image, image: Image) -> void:
	for y in SIDE:
		for x in SIDE:
			sum.set_pixel(x, y, sum.get_pixel(x, y) + image.get_pixel(x, y))


func _expect_alike(image: Image, expected: Image) -> void:
	for y in range(0, SIDE, 3):
		for x in range(0, SIDE, 3):
			var wanted := expected.get_pixel(x, y)
			var got := image.get_pixel(x, y)
			for channel in 3:
				var off := absf((got[channel] as float) - (wanted[channel] as float))
				var allowed: float = 5e-4 + 4e-3 * wanted[channel]
				(
					assert_float(off)
					. override_failure_message("%d, %d: %s, not %s" % [x, y, got, wanted])
					. is_less(allowed)
				)


func _compare(image: Image, deviation: float, energy: float, value: Callable, least: float) -> void:
	var expected := PackedFloat64Array()
	var got := PackedFloat64Array()
	var sums := Vector2.ZERO
	for y in range(0, SIDE, STEP):
		for x in range(0, SIDE, STEP):
			var normal := Kit.sphere_normal(x, y, SIDE)
			if normal == Vector3.ZERO or normal.z < 0.1:
				continue
			var reflected := energy * _integral(Kit.sphere_frame(normal), deviation, value)
			expected.append(reflected)
			got.append(image.get_pixel(x, y).r)
			sums += Vector2(reflected, got[-1])
	var text := "%.1f dB, energy %.4f" % [_psnr(expected, got), sums.y / sums.x]
	assert_float(_psnr(expected, got)).override_failure_message(text).is_greater(least)
	assert_float(sums.y / sums.x).override_failure_message(text).is_between(0.99, 1.01)


# Of `value`, a function of the directions of light and view, over the source.
static func _integral(frame: Basis, deviation: float, value: Callable) -> float:
	var o := frame.transposed() * Vector3.BACK
	var middle := frame.transposed() * DIRECTION.normalized()
	var across := middle.cross(Vector3(0.3, 0.5, 0.7)).normalized()
	var aside := middle.cross(across)
	var kappa := 1.0 / (deviation * deviation)
	var sum := 0.0
	var weights := 0.0
	for ring in RINGS:
		var angle := (ring + 0.5) / RINGS * 5.0 * deviation
		var weight := sin(angle) * exp(kappa * (cos(angle) - 1.0))
		for spoke in SPOKES:
			var turn := TAU * (spoke + 0.5 * (ring % 2)) / SPOKES
			var i := cos(angle) * middle + sin(angle) * (cos(turn) * across + sin(turn) * aside)
			weights += weight
			if i.z > 0.0:
				sum += weight * (value.call(i, o) as float)
	return sum / weights


static func _value_of_lobes(table: LobeTable) -> Callable:
	# Of the last view.
	var lobes := {}
	return func(i: Vector3, o: Vector3) -> float:
		if not lobes.has(o):
			lobes.clear()
			lobes[o] = table.lobes_at(o)
		var sum := 0.0
		for lobe: Dictionary in lobes[o]:
			var kappa: float = lobe["kappa"]
			var share := kappa / (TAU * (1.0 - exp(-2.0 * kappa)))
			sum += lobe["weight"] * share * exp(kappa * (i.dot(lobe["mean"]) - 1.0))
		return sum


# As ./dev compare has it, but for what is so dark that the source does not light it at all.
static func _psnr(expected: PackedFloat64Array, got: PackedFloat64Array) -> float:
	var sorted := expected.duplicate()
	sorted.sort()
	@warning_ignore("integer_division")
	var middle := sorted[
		sorted.bsearch(1e-3 * sorted[-1]) + (sorted.size() - sorted.bsearch(1e-3 * sorted[-1])) / 2
	]
	var exposure := 0.18 / middle
	var sum := 0.0
	for i in expected.size():
		var shown := pow(clampf(expected[i] * exposure, 0.0, 1.0), 1.0 / 2.2)
		sum += pow(pow(clampf(got[i] * exposure, 0.0, 1.0), 1.0 / 2.2) - shown, 2.0)
	return -10.0 * log(maxf(sum / expected.size(), 1e-12)) / log(10.0)


# Nothing is reflected but by what lies over it.
static func _black(light: LobeLight) -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.albedo_color = Color.BLACK
	material.metallic_specular = 0.0
	material.light = light
	return material


static func _metal(brdf: String, alpha: Vector2, light: LobeLight) -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = (load(SETS[brdf]) as LobeTableSet).table_at(alpha)
	material.light = light
	return material


# No light but these, each [direction, deviation, energy].
static func _light_of(sources: Array) -> LobeLight:
	var image := Image.create_empty(4, 3, false, Image.FORMAT_RGBAF)
	for i in sources.size():
		var direction: Vector3 = (sources[i][0] as Vector3).normalized()
		image.set_pixel(i, 0, Color(direction.x, direction.y, direction.z, sources[i][1]))
		image.set_pixel(i, 1, sources[i][2])
	var light := LobeLight.make_constant(Color.BLACK, true)
	light.sources = ImageTexture.create_from_image(image)
	return light
