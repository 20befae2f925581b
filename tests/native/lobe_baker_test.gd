extends GdUnitTestSuite
## LobeBaker: what a recipe may say, what comes back, and what is refused.

## Small enough to be fitted in a few milliseconds.
const SMALL := {"brdf": "ward", "alpha": [0.1, 0.2], "lobes": 2, "views": [4, 3], "threads": 1}

## A recipe's value of the wrong kind or out of range, and what the sentence about it says.
const REFUSED := [
	["brdf", "phong", 'brdf is "phong"'],
	["brdf", 3, "brdf is 3 (int)"],
	["brdf", null, "brdf is null"],
	["alpha", "wide", 'alpha is "wide" (String)'],
	["alpha", 0.0, "alpha is (0, 0)"],
	["alpha", Vector2(-0.1, 0.1), "alpha is (-0.1, 0.1)"],
	["alpha", NAN, "alpha is (nan, nan)"],
	["alpha", [INF, 0.1], "alpha is (inf, 0.1)"],
	["alpha", [0.1], "alpha is [0.1] (Array)"],
	["alpha", [0.1, "0.1"], 'alpha is [0.1, "0.1"] (Array)'],
	["alpha", true, "alpha is true (bool)"],
	["lobes", 0, "lobes is 0"],
	["lobes", 1000, "lobes is 1000"],
	["lobes", 2.5, "lobes is 2.5 (float)"],
	["lobes", 1e300, "lobes is 1"],
	["lobes", 1 << 40, "lobes is 1099511627776 (int)"],
	["lobes", NAN, "lobes is nan (float)"],
	["lobes", "8", 'lobes is "8" (String)'],
	["views", Vector2i(1, 1), "views is (1, 1)"],
	["views", Vector2(16.5, 1), "views is (16.5, 1.0) (Vector2)"],
	["views", 16, "views is 16 (int)"],
	["views", [16, 8, 1], "views is [16, 8, 1] (Array)"],
	["views", Vector2i(100000, 1), "views is (100000, 1)"],
	["method", "guess", '"guess"'],
	["method", 1, "method is 1 (int)"],
	["refine", 1, "refine is 1 (int), but must be true or false."],
	["refine", "yes", 'refine is "yes" (String)'],
	[
		"placement",
		"line",
		'placement is "line", which is not known; known are "auto", "em", "arc".'
	],
	["placement", 1, "placement is 1 (int)"],
	["reach", 0.1, "reach is 0.1, but must be between 0.5 and 32, or 0 for the best one."],
	["reach", NAN, "reach is nan"],
	["reach", "far", 'reach is "far" (String)'],
	["seed", -1, "seed is -1 (int)"],
	["seed", 0.5, "seed is 0.5 (float)"],
	["threads", "all", 'threads is "all" (String)'],
	["lobe", 8, '"lobe" is not a key of a recipe'],
	["Alpha", 0.1, '"Alpha" is not a key of a recipe'],
	[5, 0.1, "5 (int) is not a key of a recipe"],
]

const BELOW_HORIZON := "view must point above the horizon: its z must be positive."
const ALBEDO_REFUSED := [
	[
		"phong",
		Vector2(0.1, 0.1),
		Vector3(0, 0, 1),
		(
			'brdf is "phong", which is not known; known are "ward", "ward_bounded", "ggx", '
			+ '"charlie", and files of measurements (.binary, .bsdf).'
		),
	],
	[
		"ward",
		Vector2(0.1, 0),
		Vector3(0, 0, 1),
		"alpha is (0.1, 0), but both widths must be between 0.0001 and 2.",
	],
	["ward", Vector2(0.1, 0.1), Vector3(0, 1, 0), BELOW_HORIZON],
	["ward", Vector2(0.1, 0.1), Vector3(0, NAN, 1), BELOW_HORIZON],
]


func test_result_has_the_documented_shape() -> void:
	var table := LobeBaker.new().bake(SMALL)
	(
		assert_array(table.keys())
		. contains_exactly_in_any_order(
			[
				"brdf",
				"alpha",
				"lobes",
				"views",
				"method",
				"refine",
				"placement",
				"seed",
				"width",
				"height",
				"data",
				"seconds",
				"iterations",
				"log_likelihood",
				"first_view_curve",
				"errors",
			]
		)
	)
	assert_str(table.brdf).is_equal("ward")
	assert_that(table.alpha).is_equal(Vector2(0.1, 0.2))
	assert_int(table.lobes).is_equal(2)
	assert_that(table.views).is_equal(Vector2i(4, 3))
	assert_str(table.method).is_equal("continuation")
	assert_bool(table.refine).is_false()
	assert_str(table.placement).is_equal("em")
	assert_int(table.seed).is_equal(0)
	assert_int(table.width).is_equal(4)
	assert_int(table.height).is_equal(2 * 3)
	assert_int(typeof(table.data)).is_equal(TYPE_PACKED_BYTE_ARRAY)
	assert_int(table.data.size()).is_equal(4 * 6 * 8)
	assert_float(table.seconds).is_greater(0.0)
	assert_int(typeof(table.iterations)).is_equal(TYPE_PACKED_INT32_ARRAY)
	assert_int(table.iterations.size()).is_equal(4 * 3)
	assert_int(typeof(table.log_likelihood)).is_equal(TYPE_PACKED_FLOAT32_ARRAY)
	assert_int(table.log_likelihood.size()).is_equal(4 * 3)
	assert_int(typeof(table.errors)).is_equal(TYPE_PACKED_FLOAT32_ARRAY)
	assert_int(table.errors.size()).is_equal(4 * 3)
	assert_float(table.first_view_curve[-1]).is_greater(table.first_view_curve[0])


func test_errors_fall_with_the_number_of_lobes() -> void:
	var recipe := {"brdf": "ggx", "alpha": 0.3, "views": [3, 1]}
	var worst: Array[float] = []
	for lobes: int in [1, 8]:
		recipe["lobes"] = lobes
		var errors := Array(LobeBaker.new().bake(recipe).errors)
		worst.append(errors.max())
		assert_float(errors.min()).is_greater(0.0)
	# Two densities of mass one are 2 apart at most.
	assert_float(worst[0]).is_between(0.1, 2.0)
	assert_float(worst[1]).is_less(0.5 * worst[0])


func test_slice_in_plane_is_the_brdf_times_the_cosine() -> void:
	# Ward 1992 at equal angles: h = n, so rho cos = 1 / (4 pi alpha^2) for o = mirror of i.
	var view := Vector3(-0.6, 0.0, 0.8)
	var slice := LobeBaker.slice_in_plane("ward", Vector2(0.2, 0.2), view, 181)
	assert_int(slice.size()).is_equal(181)
	assert_float(slice[0]).is_equal_approx(0.0, 1e-6)
	# The view's side has the positive angles; the mirror direction is at -36.87 degrees.
	var peak := slice.find(Array(slice).max())
	assert_int(peak - 90).is_between(-45, -33)
	var fine := LobeBaker.slice_in_plane("ward", Vector2(0.2, 0.2), Vector3(0, 0, 1), 3)
	assert_float(fine[1]).is_equal_approx(1.0 / (4.0 * PI * 0.04), 1e-4)


func test_plots_take_the_widths_that_bakes_take() -> void:
	# A Vector2's 1e-4 is a little less than 0.0001.
	for width: float in [1e-4, 0.1, 2.0]:
		var alpha := Vector2(width, width)
		var baked := LobeBaker.new().bake({"alpha": alpha, "lobes": 1, "views": [2, 1]})
		assert_str(baked.get("error", "")).is_empty()
		var albedo := LobeBaker.directional_albedo("ward", alpha, Vector3(0, 0, 1))
		assert_float(albedo).is_between(0.05, 1.01)
		var slice := LobeBaker.slice_in_plane("ward", alpha, Vector3(0, 0, 1), 3)
		assert_int(slice.size()).is_equal(3)
		# Ward 1992 at normal incidence.
		assert_float(slice[1] * 4.0 * PI * width * width).is_equal_approx(1.0, 1e-5)


func test_slice_is_refused_for_what_cannot_be(
	brdf: String, alpha: Vector2, view: Vector3, message: String, _test_parameters := ALBEDO_REFUSED
) -> void:
	var sizes := [1]
	var call_it := func() -> void: sizes[0] = LobeBaker.slice_in_plane(brdf, alpha, view, 9).size()
	await assert_error(call_it).is_push_error(message)
	assert_int(sizes[0]).is_equal(0)


func test_refinement_changes_lobes_and_keeps_the_albedo() -> void:
	var recipe := {"brdf": "ward", "alpha": 0.2, "lobes": 4, "views": [3, 1]}
	var plain := LobeBaker.new().bake(recipe)
	recipe["refine"] = false
	assert_array(LobeBaker.new().bake(recipe).data).is_equal(plain.data)
	recipe["refine"] = true
	var refined := LobeBaker.new().bake(recipe)
	assert_bool(refined.refine).is_true()
	assert_array(refined.data).is_not_equal(plain.data)
	for view in 3:
		assert_float(_weight_sum(refined, view)).is_equal_approx(_weight_sum(plain, view), 2e-3)


func test_data_is_an_image() -> void:
	var table := LobeBaker.new().bake(SMALL)
	var image := Image.create_from_data(
		table.width, table.height, false, Image.FORMAT_RGBAH, table.data
	)
	assert_bool(image.is_empty()).is_false()
	for y in image.get_height():
		for x in image.get_width():
			var texel := image.get_pixel(x, y)
			assert_bool(is_finite(texel.r + texel.g + texel.b + texel.a)).is_true()
			assert_float(texel.a).is_greater_equal(0.0)


func test_weights_add_up_to_the_albedo() -> void:
	# The quadrature that directional_albedo uses and the one of the fit see the same BRDF; what is
	# left is the rounding to half floats, 2^-11 of each weight.
	for brdf: String in ["ward", "ward_bounded", "ggx"]:
		var recipe := {"brdf": brdf, "alpha": 0.2, "lobes": 4, "views": [3, 1]}
		var table := LobeBaker.new().bake(recipe)
		for t in 3:
			var sum := _weight_sum(table, t)
			var angle := deg_to_rad(89.4) * (1.0 - (1.0 - t / 2.0) ** 2)
			var view := Vector3(sin(angle), 0, cos(angle))
			var albedo := LobeBaker.directional_albedo(brdf, Vector2(0.2, 0.2), view)
			assert_float(sum).is_equal_approx(albedo, 1e-3 * albedo)


func test_defaults() -> void:
	var plain := LobeBaker.new().bake({"views": [2, 1]})
	var spelled_out := LobeBaker.new().bake(
		{
			"brdf": "ward",
			"alpha": 0.1,
			"lobes": 8,
			"views": [2, 1],
			"method": "continuation",
			"seed": 0,
			"threads": 0
		}
	)
	assert_int(plain.lobes).is_equal(8)
	assert_bool(plain.data == spelled_out.data).is_true()


func test_default_views() -> void:
	var isotropic := LobeBaker.new().bake({"lobes": 1})
	assert_that(isotropic.views).is_equal(Vector2i(16, 1))
	var anisotropic := LobeBaker.new().bake({"lobes": 1, "alpha": Vector2(0.1, 0.2)})
	assert_that(anisotropic.views).is_equal(Vector2i(16, 8))


func test_threads_do_not_change_a_byte() -> void:
	var recipe := {"alpha": [0.05, 0.2], "lobes": 3, "views": [5, 4]}
	for method: String in ["continuation", "independent"]:
		recipe.method = method
		var one := LobeBaker.new().bake(recipe.merged({"threads": 1}))
		var two := LobeBaker.new().bake(recipe.merged({"threads": 2}))
		assert_int(one.data.size()).is_equal(5 * 4 * 3 * 8)
		assert_bool(one.data == two.data).is_true()
		assert_bool(one.log_likelihood == two.log_likelihood).is_true()


func test_a_recipe_means_the_same_in_every_form() -> void:
	var expected: PackedByteArray = LobeBaker.new().bake(SMALL).data
	# JSON has floats only, and a Vector2 holds single precision.
	var from_json: Dictionary = JSON.parse_string(JSON.stringify(SMALL))
	var forms: Array[Dictionary] = [
		from_json,
		SMALL.merged({"alpha": Vector2(0.1, 0.2)}, true),
		SMALL.merged({"views": Vector2i(4, 3)}, true),
		SMALL.merged({"views": Vector2(4, 3)}, true),
		{&"brdf": &"ward", &"alpha": [0.1, 0.2], &"lobes": 2, &"views": [4, 3]},
	]
	for form in forms:
		var table := LobeBaker.new().bake(form)
		assert_str(table.get("error", "")).is_empty()
		assert_bool(table.get("data") == expected).is_true()


func test_one_number_stands_for_both_widths() -> void:
	var one := LobeBaker.new().bake({"alpha": 0.15, "lobes": 2, "views": [2, 1]})
	var two := LobeBaker.new().bake({"alpha": [0.15, 0.15], "lobes": 2, "views": [2, 1]})
	assert_int(one.data.size()).is_equal(2 * 2 * 8)
	assert_bool(one.data == two.data).is_true()


func test_bad_recipe_is_refused_by_name(
	key: Variant, value: Variant, named: String, _test_parameters := REFUSED
) -> void:
	var recipe := SMALL.duplicate()
	recipe[key] = value
	var result := LobeBaker.new().bake(recipe)
	assert_array(result.keys()).contains_exactly(["error"])
	var message: String = result.get("error", "")
	assert_str(message).contains(named)
	_assert_one_sentence(message)
	# The same from start(), which must not begin to work.
	var baker := LobeBaker.new()
	assert_bool(baker.start(recipe)).is_false()
	assert_str(baker.get_error()).is_equal(message)
	assert_bool(baker.is_running()).is_false()


func test_auto_chooses_the_fewest_lobes() -> void:
	var recipe := {"alpha": 0.2, "lobes": "auto", "target": 26.0}
	var found := LobeBaker.new().bake(recipe)
	assert_str(found.get("error", "")).is_empty()
	assert_float(found.target).is_equal(26.0)
	assert_float(found.predicted_psnr).is_greater_equal(26.0)
	assert_int(found.lobes).is_between(2, 8)
	# It is the table that the count gives by itself.
	var plain := LobeBaker.new().bake({"alpha": 0.2, "lobes": found.lobes})
	assert_bool(found.data == plain.data).is_true()
	# One lobe has less, so that a target below that takes one.
	var one := LobeBaker.new().bake({"alpha": 0.2, "lobes": "auto", "target": 5.0})
	assert_int(one.lobes).is_equal(1)
	assert_float(one.predicted_psnr).is_less(26.0)


func test_auto_says_what_it_cannot_do() -> void:
	# Two elevations are too few for any count.
	var coarse := {"alpha": 0.1, "lobes": "auto", "target": 46.0, "views": [2, 1]}
	var message: String = LobeBaker.new().bake(coarse).get("error", "")
	assert_str(message).contains("The target of 46 dB is out of reach with up to 32 lobes")
	var few := {"alpha": 0.2, "lobes": "auto", "target": 45.0, "max_lobes": 2}
	message = LobeBaker.new().bake(few).get("error", "")
	assert_str(message).contains("out of reach with up to 2 lobes")
	for wrong: Array in [
		[{"lobes": "auto", "target": 60}, "target is 60"],
		[{"lobes": "auto", "max_lobes": 0}, "max_lobes is 0, but must be from 1 to 32."],
		[{"lobes": "auto", "max_lobes": 33}, "max_lobes is 33"],
		[{"lobes": 8, "max_lobes": 8}, 'max_lobes goes with lobes "auto" only.'],
		[{"lobes": "auto", "refine": true}, 'refine is true, but "auto"'],
		[{"lobes": "auto", "target": "good"}, 'target is "good" (String)'],
		[{"lobes": "auto", "environments": "hall.exr"}, "an Array of Strings"],
		[{"lobes": "auto", "environments": ["res://nowhere.exr"]}, "nowhere.exr"],
		[{"lobes": 8, "target": 30}, 'target goes with lobes "auto" only.'],
		[{"environments": []}, 'environments goes with lobes "auto" only.'],
	]:
		assert_str(LobeBaker.new().bake(wrong[0]).get("error", "")).contains(wrong[1])


func test_a_bake_that_would_not_fit_is_refused_at_once() -> void:
	var recipe := {"widths": range(1, 65).map(func(n: int) -> float: return 0.03 * n)}
	recipe.merge({"lobes": 32, "views": [256, 256]})
	var baker := LobeBaker.new()
	assert_bool(baker.start(recipe)).is_false()
	var message := baker.get_error()
	assert_str(message).contains("widths has 64 numbers, lobes is 32 and views is (256, 256)")
	_assert_one_sentence(message)
	assert_str(LobeBaker.new().bake(recipe).error).is_equal(message)
	assert_str(LobeBaker.new().refit(recipe, PackedByteArray(), 0).error).is_equal(message)


func test_long_values_are_cut_in_messages() -> void:
	var message: String = LobeBaker.new().bake({"brdf": ["ä\n\u001b\r".repeat(500)]}).error
	assert_int(message.length()).is_less(200)
	_assert_one_sentence(message)


func test_albedo_is_refused_for_what_cannot_be(
	brdf: String, alpha: Vector2, view: Vector3, message: String, _test_parameters := ALBEDO_REFUSED
) -> void:
	var albedo := [0.0]
	var call_it := func() -> void: albedo[0] = LobeBaker.directional_albedo(brdf, alpha, view)
	await assert_error(call_it).is_push_error(message)
	assert_bool(is_nan(albedo[0])).is_true()


func test_albedo_of_smooth_ward_is_nearly_one() -> void:
	# At normal incidence Ward reflects everything but what leaves by the wide tail.
	var albedo := LobeBaker.directional_albedo("ward", Vector2(0.05, 0.05), Vector3(0, 0, 3))
	assert_float(albedo).is_between(0.98, 1.0)


# Of the lobes of an isotropic table in the view of column `t`.
func _weight_sum(table: Dictionary, t: int) -> float:
	var bytes: PackedByteArray = table.data
	var width: int = table.width
	var sum := 0.0
	for lobe: int in table.lobes:
		sum += bytes.decode_half((lobe * width + t) * 8 + 6)
	return sum


func _assert_one_sentence(message: String) -> void:
	assert_str(message).ends_with(".")
	for control: String in ["\n", "\r", "\u001b"]:
		assert_str(message).not_contains(control)
	assert_str(message).not_contains(". ")
