extends GdUnitTestSuite
## LobeTableSet: its layout, the interpolation over the widths, and its files, without the library.

const WidthsTexture := preload("res://addons/lobelight/runtime/table/widths_texture.gd")

const WIDTHS: Array[float] = [0.1, 0.2, 0.4]
const VIEWS := Vector2i(3, 4)
const LOBES := 2


# The number that stands for a texel's first channel: linear in the logarithms of the widths, with
# factors that tell the axes apart, so that interpolation has to give back the formula.
static func _value(alpha: Vector2) -> float:
	return 0.25 * log(alpha.x / 0.1) / log(2.0) - 0.125 * log(alpha.y / 0.1) / log(2.0)


func _make_set() -> LobeTableSet:
	var pairs: Array[Vector2] = []
	for x in WIDTHS.size():
		for y in x + 1:
			pairs.append(Vector2(WIDTHS[x], WIDTHS[y]))
	var rows := LOBES * (pairs.size() * VIEWS.y + WIDTHS.size())
	var image := Image.create_empty(VIEWS.x, rows, false, Image.FORMAT_RGBAH)
	var row := 0
	for pair in pairs:
		for lobe in LOBES:
			for p in VIEWS.y:
				for t in VIEWS.x:
					var slope_y := 0.5 * lobe + 0.0625 * p
					image.set_pixel(t, row, Color(_value(pair), slope_y, 5.0 + t, 0.25))
				row += 1
	for width in WIDTHS:
		for lobe in LOBES:
			for t in VIEWS.x:
				image.set_pixel(t, row, Color(8.0 + log(width / 0.1) / log(2.0), lobe, t, 0.5))
			row += 1
	var tables := LobeTableSet.new()
	tables.brdf = "test"
	tables.widths = PackedFloat64Array(WIDTHS)
	tables.lobe_count = LOBES
	tables.views = VIEWS
	tables.image = image
	return tables


# With one lobe and the smallest grid.
func _make_set_of(count: int) -> LobeTableSet:
	var tables := LobeTableSet.new()
	tables.lobe_count = 1
	tables.views = Vector2i(2, 2)
	for i in count:
		tables.widths.append(0.01 * pow(1.2, i))
	var rows := 2 * tables.get_pair_count() + count
	tables.image = Image.create_empty(2, rows, false, Image.FORMAT_RGBAH)
	return tables


func test_grid_widths_give_the_tables() -> void:
	var tables := _make_set()
	assert_str(tables.get_problem()).is_empty()
	assert_int(tables.get_table_count()).is_equal(6 + 3)
	for x in WIDTHS.size():
		for y in x:
			var table := tables.table_at(Vector2(WIDTHS[x], WIDTHS[y]))
			assert_str(table.get_problem()).is_empty()
			assert_that(table.views).is_equal(VIEWS)
			@warning_ignore("integer_division")
			var number := x * (x + 1) / 2 + y
			assert_bool(table.image.get_data() == tables.get_table_data(number)).is_true()
	for level in WIDTHS.size():
		var table := tables.table_at(Vector2(WIDTHS[level], WIDTHS[level]))
		assert_bool(table.is_isotropic()).is_true()
		assert_bool(table.image.get_data() == tables.get_table_data(6 + level)).is_true()


func test_interpolation_is_linear_in_the_logarithms() -> void:
	var tables := _make_set()
	# Inside a square of four tables, inside a triangle at the diagonal, and on the edge of both.
	for alpha: Vector2 in [Vector2(0.29, 0.13), Vector2(0.17, 0.12), Vector2(0.2, 0.15)]:
		var table := tables.table_at(alpha)
		assert_vector(table.alpha).is_equal(alpha)
		for p in VIEWS.y:
			var texel := table.image.get_pixel(1, VIEWS.y + p)
			assert_float(texel.r).is_equal_approx(_value(alpha), 2e-3)
			assert_float(texel.g).is_equal_approx(0.5 + 0.0625 * p, 1e-3)
			assert_float(texel.b).is_equal_approx(6.0, 1e-2)
	var isotropic := tables.table_at(Vector2(0.3, 0.3))
	assert_int(isotropic.views.y).is_equal(1)
	assert_float(isotropic.image.get_pixel(2, 1).r).is_equal_approx(8.0 + log(3.0) / log(2.0), 8e-3)


func test_no_jump_between_cells() -> void:
	var tables := _make_set()
	for edge: Vector2 in [Vector2(0.2, 0.13), Vector2(0.3, 0.2), Vector2(0.2, 0.2)]:
		var below := tables.table_at(edge * Vector2(0.999, 0.998)).image.get_pixel(0, 0).r
		var above := tables.table_at(edge * Vector2(1.001, 0.999)).image.get_pixel(0, 0).r
		assert_float(above).is_equal_approx(below, 4e-3)


func test_exchanged_widths_are_seen_from_the_other_axis() -> void:
	var tables := _make_set()
	var here := tables.table_at(Vector2(0.3, 0.15))
	var there := tables.table_at(Vector2(0.15, 0.3))
	assert_vector(there.alpha).is_equal(Vector2(0.15, 0.3))
	for view: Vector3 in [Vector3(0.6, 0.2, 0.7), Vector3(0.1, 0.9, 0.3), Vector3(0.5, 0.0, 0.5)]:
		var lobes := here.lobes_at(view.normalized())
		var exchanged := there.lobes_at(Vector3(view.y, view.x, view.z).normalized())
		for k in LOBES:
			var mean: Vector3 = lobes[k]["mean"]
			assert_vector(exchanged[k]["mean"]).is_equal_approx(
				Vector3(mean.y, mean.x, mean.z), 1e-5 * Vector3.ONE
			)
			assert_float(exchanged[k]["weight"]).is_equal_approx(lobes[k]["weight"], 1e-6)
			var kappa: float = lobes[k]["kappa"]
			assert_float(exchanged[k]["kappa"]).is_equal_approx(kappa, 1e-4 * kappa)


func test_widths_outside_are_the_last_ones() -> void:
	var tables := _make_set()
	for pair: Array in [
		[Vector2(0.001, 0.001), Vector2(0.1, 0.1)],
		[Vector2(7.0, 0.2), Vector2(0.4, 0.2)],
		[Vector2(0.05, 0.3), Vector2(0.1, 0.3)],
	]:
		var outside := tables.table_at(pair[0])
		var inside := tables.table_at(pair[1])
		assert_vector(outside.alpha).is_equal(inside.alpha)
		assert_bool(outside.image.get_data() == inside.image.get_data()).is_true()


func test_problems_are_named() -> void:
	var tables := _make_set()
	tables.lobe_count = 0
	assert_str(tables.get_problem()).contains("1 to 32 lobes")
	tables.lobe_count = 3
	assert_str(tables.get_problem()).contains("3 x 81 texels")
	tables.lobe_count = LOBES
	tables.views = Vector2i(3, 0)
	assert_str(tables.get_problem()).contains("1 azimuth")
	tables.views = VIEWS
	for widths: Array in [[0.1, 0.1, 0.2], [0.0, 0.1, 0.2], [0.1, NAN, 0.2], [0.1, 0.2, INF]]:
		tables.widths = PackedFloat64Array(widths)
		assert_str(tables.get_problem()).contains("positive and rise")
	tables.widths = PackedFloat64Array([0.1])
	assert_str(tables.get_problem()).contains("2 to 64 widths")
	tables.widths = PackedFloat64Array(WIDTHS)
	tables.image = null
	assert_str(tables.get_problem()).contains("no image")


func test_bad_widths_are_refused() -> void:
	var tables := _make_set()
	for alpha: Vector2 in [
		Vector2(0.0, 0.1), Vector2(0.1, -0.1), Vector2(NAN, 0.1), Vector2(0.1, INF)
	]:
		var made: Array[LobeTable] = [null]
		var call_it := func() -> void: made[0] = tables.table_at(alpha)
		await assert_error(call_it).is_push_error(
			"LobeTableSet.table_at: alpha must be positive, not %s." % alpha
		)
		assert_object(made[0]).is_null()


func test_3d_textures_of_too_many_layers_are_refused() -> void:
	# Of 22 widths there are 253 pairs, of 23 there are 276.
	for count: int in [22, 23]:
		var tables := _make_set_of(count)
		assert_str(tables.get_problem()).is_empty()
		assert_str(WidthsTexture.find_problem(tables.widths, true)).is_empty()
		var problem := WidthsTexture.find_problem(tables.widths, false)
		var material := LobeMaterial3D.new()
		material.metallic = 1.0
		material.roughness = 0.4
		material.table_set = tables
		material.roughness_texture = ImageTexture.new()
		for anisotropy: float in [0.0, 0.5]:
			material.anisotropy = anisotropy
			material.anisotropy_enabled = true
			var per_pixel := "WIDTHS_PER_PIXEL" in material.get_shader_code()
			assert_bool(per_pixel).is_equal(anisotropy == 0.0 or count == 22)
		if count == 22:
			assert_str(problem).is_empty()
		else:
			assert_str(problem).contains("23 widths make 276").contains("256 layers")


func test_files_give_back_the_set() -> void:
	var tables := _make_set()
	var path := "user://table_set_test.res"
	assert_int(ResourceSaver.save(tables, path, ResourceSaver.FLAG_COMPRESS)).is_equal(OK)
	var loaded: LobeTableSet = ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE)
	assert_str(loaded.get_problem()).is_empty()
	assert_bool(loaded.widths == tables.widths).is_true()
	assert_bool(loaded.image.get_data() == tables.image.get_data()).is_true()
	DirAccess.remove_absolute(path)


func test_numbers_that_are_not_finite_are_refused() -> void:
	var data := _make_set().image.get_data()
	data.encode_u16(10, 0x7E00)
	var result := {
		"brdf": "test",
		"widths": WIDTHS,
		"lobes": LOBES,
		"views": VIEWS,
		"width": VIEWS.x,
		"height": LOBES * (6 * VIEWS.y + 3),
		"data": data,
	}
	var call_it := func() -> void: LobeTableSet.from_baked(result)
	await assert_error(call_it).is_push_error(
		"LobeTableSet.from_baked: numbers that are not finite: 1 of 648."
	)
	result["data"] = _make_set().image.get_data()
	assert_object(LobeTableSet.from_baked(result)).is_not_null()


func test_from_baked_names_what_is_missing() -> void:
	var result := {"brdf": "ward", "widths": [0.1, 0.2], "lobes": 1, "views": Vector2i(2, 2)}
	var call_it := func() -> void: LobeTableSet.from_baked(result)
	await assert_error(call_it).is_push_error('LobeTableSet.from_baked: the result has no "width".')
