extends GdUnitTestSuite
## The methods of `./dev compare` that put lobes in the place of a BRDF by formulas: allfreq, asg
## and closed8.

const Kit := preload("support/render_kit.gd")
const Bench := preload("support/comparator_bench.gd")
const ComparatorKit := preload("support/comparator_kit.gd")
const LineLobes := preload("res://bake/comparators/line_lobes.gd")
const Microfacet := preload("res://bake/comparators/microfacet.gd")

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

var _bench: Bench


func before_test() -> void:
	_bench = auto_free(Bench.new(create_temp_dir("comparators")))
	add_child(_bench)


func after() -> void:
	clean_temp_dir()


func test_white_furnace(brdf: String, x: float, y: float, _test_parameters := MATERIALS) -> void:
	_bench.stage.panorama = Kit.constant(3.0)
	for name in METHODS:
		var pixels := await _bench.drawn(_bench.make(name, brdf, x, y))
		for normal in ComparatorKit.NORMALS:
			var albedo := ComparatorKit.albedo_at(brdf, Vector2(x, y), normal)
			var share := ComparatorKit.value_at(pixels, normal) / (3.0 * albedo)
			(
				assert_float(share)
				. append_failure_message("%s, normal %s: %f of the albedo" % [name, normal, share])
				. is_equal_approx(1.0, FURNACE_BIAS[name])
			)


func test_levels_of_one_lobe() -> void:
	# In a cube map whose levels hold 1 + their number: Wang et al.'s warped lobe has the sharpness
	# 1 / (2 alpha_x alpha_y (o.n)), and level l of 2 × 2 means blurs by (4^l (1/12 + 1/6) - 1/12)
	# of a texel's solid angle.
	var method := _bench.make("allfreq1", "ward", 0.1, 0.4)
	_bench.stage._lights[_bench.stage.filter] = ComparatorKit.level_light(32, "box")
	var pixels := await _bench.drawn(method)
	var weight := Microfacet.normals_integral("ward", [0.1, 0.4])
	for normal in ComparatorKit.NORMALS:
		var n := ComparatorKit.exact_normal(normal)
		var direction := (2.0 * n.z * n - Vector3.BACK).abs()
		var texel := 4.0 / (32.0 * 32.0) * pow(direction[direction.max_axis_index()], 3.0)
		var variance := 2.0 * 0.1 * 0.4 * n.z
		var level := 0.5 * log((variance / texel + 1.0 / 12.0) * 4.0) / log(2.0)
		# Between two levels the sampler mixes variances: 1 + 3 f of the lower one's.
		var whole := floorf(level)
		level = clampf(whole + (pow(4.0, level - whole) - 1.0) / 3.0, 0.0, 5.0)
		assert_float(level).is_between(0.5, 4.5)
		var got := ComparatorKit.value_at(pixels, normal) / (weight * n.z)
		assert_float(got).is_equal_approx(1.0 + level, 0.08)


func test_sharp_lobes_agree_with_the_reference() -> void:
	# What they leave out vanishes with the width: the curvature of the highlight and what varies
	# over it.
	_bench.light_lamps()
	var expected := _bench.reference("ward", 0.02, 0.02)
	for name in METHODS:
		var error := ComparatorKit.error(
			await _bench.drawn(_bench.make(name, "ward", 0.02, 0.02)), expected
		)
		assert_float(error).append_failure_message("%s: %f" % [name, error]).is_less(0.01)


func test_lobes_along_the_wider_axis_follow_a_long_highlight(
	brdf: String, x: float, y: float, _test_parameters := LONG_MATERIALS
) -> void:
	_bench.light_lamps()
	var expected := _bench.reference(brdf, x, y)
	var errors: Dictionary[String, float] = {}
	for name in METHODS:
		errors[name] = ComparatorKit.error(
			await _bench.drawn(_bench.make(name, brdf, x, y)), expected
		)
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
