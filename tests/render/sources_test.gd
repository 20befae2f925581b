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


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)


func after_test() -> void:
	_view.free()


func test_reflections_of_a_source(
	brdf: String, alpha: Vector2, deviation: float, _test_parameters := CASES
) -> void:
	var light := _light_of([[DIRECTION.normalized(), deviation, Color(100.0, 50.0, 10.0)]])
	_view.add_child(Kit.make_sphere(_metal(brdf, alpha, light), 128))
	var image: Image = await _view.capture()
	_compare(image, brdf, alpha, deviation, 100.0)


func _compare(image: Image, brdf: String, alpha: Vector2, deviation: float, energy: float) -> void:
	var expected := PackedFloat64Array()
	var got := PackedFloat64Array()
	var sums := Vector2.ZERO
	for y in range(0, SIDE, STEP):
		for x in range(0, SIDE, STEP):
			var normal := Kit.sphere_normal(x, y, SIDE)
			if normal == Vector3.ZERO or normal.z < 0.1:
				continue
			var frame := Kit.sphere_frame(normal)
			var value := energy * _reflected(brdf, alpha, frame, deviation)
			expected.append(value)
			got.append(image.get_pixel(x, y).r)
			sums += Vector2(value, got[-1])
	var text := "%.1f dB, energy %.4f" % [_psnr(expected, got), sums.y / sums.x]
	assert_float(_psnr(expected, got)).override_failure_message(text).is_greater(45.0)
	assert_float(sums.y / sums.x).override_failure_message(text).is_between(0.99, 1.01)


static func _reflected(brdf: String, alpha: Vector2, frame: Basis, deviation: float) -> float:
	var o := frame.transposed() * Vector3.BACK
	var middle := frame.transposed() * DIRECTION.normalized()
	var across := middle.cross(Vector3(0.3, 0.5, 0.7)).normalized()
	var aside := middle.cross(across)
	var kappa := 1.0 / (deviation * deviation)
	var sum := 0.0
	var weights := 0.0
	for ring in RINGS:
		var angle := (ring + 0.5) / RINGS * minf(5.0 * deviation, PI)
		var weight := sin(angle) * exp(kappa * (cos(angle) - 1.0))
		for spoke in SPOKES:
			var turn := TAU * (spoke + 0.5 * (ring % 2)) / SPOKES
			var i := cos(angle) * middle + sin(angle) * (cos(turn) * across + sin(turn) * aside)
			weights += weight
			if i.z > 0.0:
				sum += weight * BrdfOracle.value(brdf, alpha, i, o) * i.z
	return sum / weights


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
		var direction: Vector3 = sources[i][0]
		image.set_pixel(i, 0, Color(direction.x, direction.y, direction.z, sources[i][1]))
		image.set_pixel(i, 1, sources[i][2])
	var light := LobeLight.make_constant(Color.BLACK, true)
	light.sources = ImageTexture.create_from_image(image)
	return light
