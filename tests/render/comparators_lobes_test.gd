extends GdUnitTestSuite
## The methods of `./dev compare` that put lobes in the place of a BRDF by formulas: allfreq, asg
## and closed8.

const Kit := preload("support/render_kit.gd")
const ComparatorKit := preload("support/comparator_kit.gd")
const LineLobes := preload("res://bake/comparators/line_lobes.gd")
const Microfacet := preload("res://bake/comparators/microfacet.gd")

const SIDE := ComparatorKit.SIDE
const METHODS: PackedStringArray = ["allfreq1", "allfreq8", "asg", "closed8"]
const MATERIALS := [
	["ward", 0.1, 0.1],
	["ward", 0.05, 0.2],
	["ward_bounded", 0.15, 0.05],
	["ggx", 0.05, 0.1],
]
const LONG_MATERIALS := [["ward", 0.03, 0.2], ["ward_bounded", 0.2, 0.03], ["ggx", 0.03, 0.1]]
# How far from the albedo the weights may be where the view is less than 63 degrees off the normal.
# allfreq1 and asg take what varies over the lobe at its middle; closed8 leaves out the slopes of
# GGX beyond its reach.
const FURNACE_BIAS: Dictionary[String, float] = {
	"allfreq1": 0.05, "allfreq8": 0.03, "asg": 0.05, "closed8": 0.04
}

var _lamps := ""
var _view: LinearViewport
var _stage: ComparisonStage


func before() -> void:
	_lamps = create_temp_dir("comparators_lobes").path_join("lamps.exr")
	assert_str(ComparatorKit.save_lamps(_lamps)).is_empty()


func after() -> void:
	clean_temp_dir()


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_stage = ComparisonStage.new(get_tree())


func after_test() -> void:
	_stage = null
	_view.free()


func test_white_furnace(brdf: String, x: float, y: float, _test_parameters := MATERIALS) -> void:
	_stage.panorama = Kit.constant(3.0)
	for name in METHODS:
		var pixels := await _drawn(_make(name, brdf, x, y))
		for normal in ComparatorKit.NORMALS:
			var pixel := ComparatorKit.pixel_of(normal)
			var frame := Kit.sphere_frame(Kit.sphere_normal(pixel.x, pixel.y, SIDE))
			var view := frame.transposed() * Vector3.BACK
			var albedo := LobeBaker.directional_albedo(brdf, Vector2(x, y), view)
			var share := pixels[3 * (pixel.y * SIDE + pixel.x)] / (3.0 * albedo)
			(
				assert_float(share)
				. append_failure_message("%s, normal %s: %f of the albedo" % [name, normal, share])
				. is_equal_approx(1.0, FURNACE_BIAS[name])
			)


func test_levels_of_one_lobe() -> void:
	# In a cube map whose levels hold 1 + their number: Wang et al.'s warped lobe has the sharpness
	# 1 / (2 alpha_x alpha_y (o.n)), and level l of 2 × 2 means blurs by (4^l (1/12 + 1/6) - 1/12)
	# of a texel's solid angle.
	var method := _make("allfreq1", "ward", 0.1, 0.4)
	_stage._lights[_stage.filter] = ComparatorKit.level_light(32, "box")
	var pixels := await _drawn(method)
	var weight := Microfacet.normals_integral("ward", [0.1, 0.4])
	for normal in ComparatorKit.NORMALS:
		var pixel := ComparatorKit.pixel_of(normal)
		var n := Kit.sphere_normal(pixel.x, pixel.y, SIDE)
		var direction := (2.0 * n.z * n - Vector3.BACK).abs()
		var texel := 4.0 / (32.0 * 32.0) * pow(direction[direction.max_axis_index()], 3.0)
		var variance := 2.0 * 0.1 * 0.4 * n.z
		var level := 0.5 * log((variance / texel + 1.0 / 12.0) * 4.0) / log(2.0)
		# Between two levels the sampler mixes variances: 1 + 3 f of the lower one's.
		var whole := floorf(level)
		level = clampf(whole + (pow(4.0, level - whole) - 1.0) / 3.0, 0.0, 5.0)
		assert_float(level).is_between(0.5, 4.5)
		var got := pixels[3 * (pixel.y * SIDE + pixel.x)] / (weight * n.z)
		assert_float(got).is_equal_approx(1.0 + level, 0.08)


func test_sharp_lobes_agree_with_the_reference() -> void:
	# What they leave out vanishes with the width: the curvature of the highlight and what varies
	# over it.
	_stage.panorama = ComparatorKit.load_panorama(_lamps)
	var expected := _reference("ward", 0.02, 0.02)
	for name in METHODS:
		var error := ComparatorKit.error(await _drawn(_make(name, "ward", 0.02, 0.02)), expected)
		assert_float(error).append_failure_message("%s: %f" % [name, error]).is_less(0.01)


func test_lobes_along_the_wider_axis_follow_a_long_highlight(
	brdf: String, x: float, y: float, _test_parameters := LONG_MATERIALS
) -> void:
	_stage.panorama = ComparatorKit.load_panorama(_lamps)
	var expected := _reference(brdf, x, y)
	var errors: Dictionary[String, float] = {}
	for name in METHODS:
		errors[name] = ComparatorKit.error(await _drawn(_make(name, brdf, x, y)), expected)
	# A Gaussian has no tails as GGX has them, however long it is.
	var share := 0.8 if brdf == "ggx" else 0.5
	assert_float(errors["asg"]).append_failure_message(str(errors)).is_less(
		share * errors["allfreq1"]
	)
	for name: String in ["allfreq8", "closed8"]:
		assert_float(errors[name]).append_failure_message(str(errors)).is_less(
			0.5 * errors["allfreq1"]
		)
		assert_float(errors[name]).append_failure_message(str(errors)).is_less(0.08)


func test_points_on_the_line_share_out_the_slopes() -> void:
	for is_ggx: bool in [false, true]:
		var parameters := LineLobes.get_parameters(8, is_ggx)
		var lobes: PackedVector3Array = parameters[&"line_lobes"]
		var spread: Vector2 = parameters[&"line_spread"]
		var weights := 0.0
		var mean := 0.0
		var square := 0.0
		for lobe in lobes:
			weights += lobe.y
			mean += lobe.y * lobe.x
			square += lobe.y * lobe.x * lobe.x
		assert_float(weights).is_equal_approx(1.0, 1e-5)
		assert_float(mean).is_equal_approx(0.0, 1e-5)
		# Ward's slopes over alpha have the variance 1/2.
		if not is_ggx:
			assert_float(spread.x * square).is_equal_approx(0.5, 1e-5)
			assert_float(lobes[4].z).is_equal(0.5)


func test_integral_of_the_normals() -> void:
	# Of GGX with equal widths: the mean of sqrt(1 + alpha² u), u of the density 1 / (1 + u)², which
	# is 1 + alpha² arcosh(1 / alpha) / sqrt(1 - alpha²).
	var alpha := 0.3
	var exact := 1.0 + alpha * alpha * acosh(1.0 / alpha) / sqrt(1.0 - alpha * alpha)
	var ggx := Microfacet.normals_integral("ggx", [alpha, alpha])
	assert_float(ggx).is_equal_approx(exact, 2e-4)
	assert_float(Microfacet.normals_integral("ward", [0.01, 0.01])).is_equal_approx(1.0, 2e-4)


func _make(name: String, brdf: String, x: float, y: float) -> ComparisonMethod:
	return CompareMethods.make(name, brdf, PackedFloat64Array([x, y]))


func _drawn(method: ComparisonMethod) -> PackedFloat32Array:
	assert_str(await method.prepare(_stage)).is_empty()
	var sphere := method.make_sphere()
	_view.add_child(sphere)
	var image: Image = await _view.capture()
	sphere.free()
	image.convert(Image.FORMAT_RGBF)
	return image.get_data().to_float32_array()


func _reference(brdf: String, x: float, y: float) -> PackedFloat32Array:
	var options := {"env": _lamps, "brdf": brdf, "alpha": [x, y], "size": SIDE, "samples": 1024}
	var result: Dictionary = NativeLibrary.create(&"LobeReference").call("render_sphere", options)
	assert_str(result.get("error", "")).is_empty()
	return result["pixels"]
