extends GdUnitTestSuite
## Lobes that need no table: their light and energy against the reference integrator, and nothing is
## seen of where materials change from tables to them or from one number of them to another.

const Kit := preload("support/render_kit.gd")
const Bench := preload("support/comparator_bench.gd")
const ComparatorKit := preload("support/comparator_kit.gd")
const LineChoice := preload("res://addons/lobelight/runtime/material/line_choice.gd")
const Widths := preload("res://addons/lobelight/runtime/table/widths.gd")

const MATERIALS := [["ward", 0.02, 0.2], ["ward_bounded", 0.2, 0.02], ["ggx", 0.02, 0.2]]
# Of the albedo, where the view is less than 63 degrees off the normal.
const FURNACE_BIAS := 0.01
const SIDE := 48
# Where the narrower width is no matter.
const ROUGHNESS := 0.3
# To either side of a change.
const STEP := 1e-6
# As screens show it.
const MOST_STEP := 2.0 / 255.0

var _bench: Bench
var _view: LinearViewport


func before_test() -> void:
	_bench = auto_free(Bench.new(create_temp_dir("line")))
	add_child(_bench)
	_view = LinearViewport.new(SIDE)
	add_child(_view)


func after_test() -> void:
	_view.free()


func after() -> void:
	clean_temp_dir()


func test_white_furnace(brdf: String, x: float, y: float, _test_parameters := MATERIALS) -> void:
	_bench.stage.panorama = Kit.constant(3.0)
	var pixels := await _bench.drawn(_bench.make("line24", brdf, x, y))
	for normal in ComparatorKit.NORMALS:
		var albedo := ComparatorKit.albedo_at(brdf, Vector2(x, y), normal)
		var share := ComparatorKit.value_at(pixels, normal) / (3.0 * albedo)
		(
			assert_float(share)
			. append_failure_message("normal %s: %f of the albedo" % [normal, share])
			. is_equal_approx(1.0, FURNACE_BIAS)
		)


func test_long_highlights(brdf: String, x: float, y: float, _test_parameters := MATERIALS) -> void:
	_bench.light_lamps()
	var expected := _bench.reference(brdf, x, y)
	var errors: Dictionary[String, float] = {}
	for name: String in ["closed8", "line24"]:
		errors[name] = ComparatorKit.error(
			await _bench.drawn(_bench.make(name, brdf, x, y)), expected
		)
	assert_float(errors["line24"]).append_failure_message(str(errors)).is_less(0.03)
	assert_float(errors["line24"]).append_failure_message(str(errors)).is_less(
		0.5 * errors["closed8"]
	)


func test_the_number_of_lobes_goes_by_the_widths() -> void:
	# Anisotropies, roughnesses and what is drawn: the table's lobes and the line's.
	var cases := [
		[0.0, 0.3, 8, 0], [0.7, 0.3, 8, 0], [0.78, 0.3, 8, 12], [0.9, 0.3, 0, 16], [1.0, 0.3, 0, 24]
	]
	# Where the narrower width is wide, where the longer one is the second, and beyond Godot's range.
	cases.append_array([[0.9, 0.8, 8, 0], [-1.0, 0.3, 8, 0], [1.1, 0.3, 0, 40]])
	for case: Array in cases:
		var material := LobeMaterial3D.new()
		material.metallic = 1.0
		material.anisotropy_enabled = true
		material.anisotropy = case[0]
		material.roughness = case[1]
		var fetches := material.get_fetches()
		assert_int(fetches["table"]).append_failure_message(str(case)).is_equal(case[2])
		assert_int(fetches["environment"]).append_failure_message(str(case)).is_equal(
			case[2] + case[3]
		)
		material.quality = LobeMaterial3D.Quality.LOBES_8
		assert_int(material.get_fetches()["environment"]).is_equal(8)
		assert_bool("LOBELIGHT_LINE" in material.get_shader_code()).is_false()


func test_tables_of_ward_go_further() -> void:
	for case: Array in [["ggx", 4.0, 12], ["ward", 4.0, 0], ["ward", 6.0, 16]]:
		var choice := LineChoice.new()
		var widths := Widths.to_roughness(Vector2(0.04, 0.04 * case[1]))
		choice.choose(case[0], widths.x, widths.y, 40)
		assert_int(choice.count).append_failure_message(str(case)).is_equal(case[2])
		# Where widths are those of pixels, as well.
		var fade: Vector4 = choice.get_parameters_of_pixels(case[0])[&"lobelight_line_fade"]
		var share := fade.x * log(case[1]) / log(2.0) + fade.y
		assert_bool(share > 0.0).append_failure_message(str(case)).is_equal(case[2] > 0)


func test_no_step_is_seen() -> void:
	var environment := LobeEnvironment3D.new()
	_view.add_child(environment)
	environment.panorama = (
		Comparison
		. load_panorama(ProjectSettings.globalize_path("res://demo/environments/hall.exr"))["texture"]
	)
	await environment.rebuild()
	var sphere := Kit.make_sphere(null)
	_view.add_child(sphere)
	var kinds: Dictionary[String, bool] = {}
	for anisotropy in _find_changes():
		var pictures: Array[Image] = []
		var materials: Array[LobeMaterial3D] = []
		for step: float in [-STEP, STEP]:
			var material := LobeMaterial3D.new()
			material.metallic = 1.0
			material.roughness = ROUGHNESS
			material.anisotropy_enabled = true
			material.anisotropy = anisotropy + step
			(sphere.mesh as PrimitiveMesh).material = material
			# Kept, so that the next one finds its shader.
			materials.append(material)
			kinds[material.get_shader_code()] = true
			pictures.append(await _view.capture())
		var change := _largest_difference(pictures[0], pictures[1])
		assert_float(change).append_failure_message("at %s" % anisotropy).is_less(MOST_STEP)
	# Or nothing was to be seen: table, both, and the numbers of lobes.
	assert_int(kinds.size()).is_greater_equal(4)


# Where materials change from one shader to another.
func _find_changes() -> PackedFloat64Array:
	var changes: PackedFloat64Array = []
	for i in 60:
		var from := 0.5 + 0.01 * i
		var to := from + 0.01
		if _find_kind(from) == _find_kind(to):
			continue
		for halving in 16:
			var middle := 0.5 * (from + to)
			if _find_kind(middle) == _find_kind(from):
				from = middle
			else:
				to = middle
		changes.append(to)
	return changes


func _find_kind(anisotropy: float) -> int:
	var choice := LineChoice.new()
	choice.choose("ggx", ROUGHNESS, anisotropy, 40)
	return 2 * choice.count + int(choice.fades)


func _largest_difference(a: Image, b: Image) -> float:
	var largest := 0.0
	for y in SIDE:
		for x in SIDE:
			var one := a.get_pixel(x, y).linear_to_srgb()
			var other := b.get_pixel(x, y).linear_to_srgb()
			for channel in 3:
				var difference := minf(one[channel], 1.0) - minf(other[channel], 1.0)
				largest = maxf(largest, absf(difference))
	return largest
