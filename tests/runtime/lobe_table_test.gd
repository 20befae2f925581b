extends GdUnitTestSuite
## LobeTable: its layout, its look-up and its files, without a renderer.

const FILES := [["user://table_test.tres"], ["user://table_test.res"]]
const MAX_VIEW_ANGLE := 1.5603243997469193  # 89.4 degrees


# Every texel different, so that a look-up at the wrong place shows.
func _make_table(lobes: int, views: Vector2i, alpha: Vector2) -> LobeTable:
	var image := Image.create_empty(views.x, views.y * lobes, false, Image.FORMAT_RGBAH)
	for y in views.y * lobes:
		for x in views.x:
			var k := float(y) / views.y
			image.set_pixel(x, y, Color(0.3 - 0.05 * x, 0.1 * k, 6.0 + 0.25 * x, 0.5 - 0.02 * y))
	var table := LobeTable.new()
	table.brdf = "test"
	table.alpha = alpha
	table.lobe_count = lobes
	table.views = views
	table.image = image
	return table


func _baked(changes: Dictionary) -> Dictionary:
	var data := PackedByteArray()
	data.resize(4 * 2 * 3 * 8)
	var result := {
		"brdf": "ward",
		"alpha": Vector2(0.1, 0.2),
		"lobes": 2,
		"views": Vector2i(4, 3),
		"method": "continuation",
		"seed": 7,
		"width": 4,
		"height": 6,
		"data": data,
		"seconds": 1.0,
	}
	result.merge(changes, true)
	return result


func test_from_baked() -> void:
	var table := LobeTable.from_baked(_baked({}))
	assert_str(table.get_problem()).is_empty()
	assert_str(table.brdf).is_equal("ward")
	assert_vector(table.alpha).is_equal(Vector2(0.1, 0.2))
	assert_int(table.lobe_count).is_equal(2)
	assert_vector(table.views).is_equal(Vector2i(4, 3))
	assert_int(table.seed).is_equal(7)
	assert_bool(table.is_isotropic()).is_false()


func test_views_may_be_floats() -> void:
	var table := LobeTable.from_baked(_baked({"views": Vector2(4.0, 3.0)}))
	assert_vector(table.views).is_equal(Vector2i(4, 3))


func test_numbers_that_are_not_finite_are_refused() -> void:
	# Half floats: infinity, minus infinity and two that are no number. 0x7BFF is the largest one.
	for bits: int in [0x7C00, 0xFC00, 0x7C01, 0xFE00, 0x7BFF]:
		var data := PackedByteArray()
		data.resize(4 * 2 * 3 * 8)
		data.encode_u16(2 * 17, bits)
		data.encode_u16(2 * 95, bits)
		var made: Array[LobeTable] = [null]
		var call_it := func() -> void: made[0] = LobeTable.from_baked(_baked({"data": data}))
		if bits == 0x7BFF:
			await assert_error(call_it).is_success()
			assert_object(made[0]).is_not_null()
			continue
		await assert_error(call_it).is_push_error(
			"LobeTable.from_baked: numbers that are not finite: 2 of 96."
		)
		assert_object(made[0]).is_null()


func test_problems_are_named() -> void:
	var table := _make_table(2, Vector2i(4, 3), Vector2(0.1, 0.2))
	table.lobe_count = 0
	assert_str(table.get_problem()).contains("1 to 32 lobes")
	table.lobe_count = 33
	assert_str(table.get_problem()).contains("1 to 32 lobes")
	table.lobe_count = 3
	assert_str(table.get_problem()).contains("4 x 9 texels")
	table.lobe_count = 2
	table.views = Vector2i(1, 6)
	assert_str(table.get_problem()).contains("at least 2 elevations")
	table.views = Vector2i(4, 3)
	table.alpha = Vector2(0.0, 0.1)
	assert_str(table.get_problem()).contains("alpha is positive")
	table.alpha = Vector2(NAN, 0.1)
	assert_str(table.get_problem()).contains("alpha is positive")
	table.alpha = Vector2(0.1, 0.1)
	assert_str(table.get_problem()).is_empty()
	table.image = null
	assert_str(table.get_problem()).contains("no image")
	assert_object(table.get_texture()).is_null()


func test_single_lobe() -> void:
	var table := LobeTable.make_single_lobe(0.2)
	assert_str(table.get_problem()).is_empty()
	var view := Vector3(0.6, 0.0, 0.8)
	var lobe := table.lobes_at(view)[0]
	assert_vector(lobe["mean"]).is_equal_approx(Vector3(-0.6, 0.0, 0.8), 1e-5 * Vector3.ONE)
	# 1 / (2 width²) at normal incidence, divided by o·h = 0.8 here.
	assert_float(lobe["kappa"]).is_equal_approx(12.5 / 0.8, 0.02)
	assert_float(table.directional_albedo(view)).is_equal(1.0)


func test_grid_views_give_the_texels() -> void:
	for views: Vector2i in [Vector2i(5, 1), Vector2i(4, 3)]:
		var table := _make_table(3, views, Vector2(0.2, 0.4))
		for p in views.y:
			# The pole has no azimuth.
			for t in range(0 if p == 0 else 1, views.x):
				var view := table.get_view(t, p)
				assert_float(view.length()).is_equal_approx(1.0, 1e-6)
				# Denser towards grazing: what is left of the columns squared is what is left of the angle.
				var rest := 1.0 - float(t) / (views.x - 1)
				var elevation := MAX_VIEW_ANGLE * (1.0 - rest * rest)
				assert_float(table.get_column(elevation)).is_equal_approx(t, 1e-3)
				assert_float(view.angle_to(Vector3.BACK)).is_equal_approx(elevation, 1e-3)
				for k in 3:
					var texel := table.image.get_pixel(t, k * views.y + p)
					var slope := Vector3(0.2 * texel.r, 0.4 * texel.g, 1.0).normalized()
					var lobe := table.lobes_at(view)[k]
					# The mean is the view mirrored at the half-vector; at the pole any azimuth will do.
					if t > 0:
						var mirrored := 2.0 * view.dot(slope) * slope - view
						assert_vector(lobe["mean"]).is_equal_approx(mirrored, 1e-3 * Vector3.ONE)
					assert_float(lobe["weight"]).is_equal_approx(texel.a, 1e-3)
					var kappa := pow(2.0, texel.b) / view.dot(slope)
					assert_float((lobe["kappa"] as float) / kappa).is_equal_approx(1.0, 2e-3)


func test_interpolation_is_linear_in_the_texels() -> void:
	var table := _make_table(2, Vector2i(5, 1), Vector2(0.2, 0.2))
	var theta := MAX_VIEW_ANGLE * (1.0 - (2.75 / 4.0) ** 2)
	var lobe := table.lobes_at(Vector3(sin(theta), 0.0, cos(theta)))[1]
	# Between columns 1 and 2 of lobe 1, a quarter of the way.
	var texel := table.image.get_pixel(1, 1).lerp(table.image.get_pixel(2, 1), 0.25)
	var half := Vector3(0.2 * texel.r, 0.2 * texel.g, 1.0).normalized()
	var view := Vector3(sin(theta), 0.0, cos(theta))
	assert_vector(lobe["mean"]).is_equal_approx(
		2.0 * view.dot(half) * half - view, 1e-4 * Vector3.ONE
	)


func test_quadrants_mirror_one_another() -> void:
	var table := _make_table(3, Vector2i(5, 4), Vector2(0.1, 0.4))
	var view := Vector3(0.5, 0.3, 0.7).normalized()
	for mirror: Vector3 in [Vector3(-1, 1, 1), Vector3(1, -1, 1), Vector3(-1, -1, 1)]:
		var here := table.lobes_at(view)
		var there := table.lobes_at(view * mirror)
		for k in 3:
			assert_vector(there[k]["mean"]).is_equal_approx(
				(here[k]["mean"] as Vector3) * mirror, 1e-6 * Vector3.ONE
			)
			assert_float(there[k]["kappa"]).is_equal_approx(here[k]["kappa"], 1e-3)


func test_isotropic_tables_turn_with_the_view() -> void:
	var table := _make_table(3, Vector2i(5, 1), Vector2(0.2, 0.2))
	var view := Vector3(0.6, 0.0, 0.8)
	var turn := Basis(Vector3.BACK, 2.1)
	var here := table.lobes_at(view)
	var there := table.lobes_at(turn * view)
	for k in 3:
		assert_vector(there[k]["mean"]).is_equal_approx(
			turn * (here[k]["mean"] as Vector3), 1e-5 * Vector3.ONE
		)


func test_all_views_give_finite_lobes() -> void:
	for views: Vector2i in [Vector2i(5, 1), Vector2i(5, 4)]:
		var table := _make_table(3, views, Vector2(0.9, 0.9))
		for view: Vector3 in [
			Vector3.BACK, Vector3.FORWARD, Vector3.RIGHT, Vector3(0.0, 1.0, -0.2).normalized()
		]:
			for lobe in table.lobes_at(view):
				var mean: Vector3 = lobe["mean"]
				assert_float(mean.length()).is_equal_approx(1.0, 1e-4)
				assert_float(lobe["kappa"]).is_between(1e-3, 1e8)


func test_lookup_hits_texel_centres() -> void:
	var table := _make_table(3, Vector2i(5, 4), Vector2(0.1, 0.4))
	var lookup := table.get_lookup()
	assert_float(lookup.y).is_equal_approx(0.5 / 5.0, 1e-6)
	assert_float(lookup.x + lookup.y).is_equal_approx(4.5 / 5.0, 1e-6)
	assert_float(lookup.w).is_equal_approx(0.5 / 12.0, 1e-6)
	assert_float(0.5 * PI * lookup.z + lookup.w).is_equal_approx(3.5 / 12.0, 1e-6)


func test_second_texels_colour_the_lobes() -> void:
	var table := _make_table(2, Vector2i(4, 3), Vector2(0.1, 0.2))
	var plain := table.lobes_at(Vector3(0.3, 0.2, 0.8).normalized())
	assert_bool(table.has_second_texels()).is_false()
	var image := Image.create_empty(4, 12, false, Image.FORMAT_RGBAH)
	image.blit_rect(table.image, Rect2i(0, 0, 4, 6), Vector2i.ZERO)
	for y in range(6, 12):
		for x in 4:
			image.set_pixel(x, y, Color(0.0, 0.0, 0.5, 0.25 if y < 9 else 2.0))
	table.image = image
	assert_str(table.get_problem()).is_empty()
	assert_bool(table.has_second_texels()).is_true()
	assert_float(table.get_lookup().w).is_equal_approx(0.5 / 12.0, 1e-6)
	var lobes := table.lobes_at(Vector3(0.3, 0.2, 0.8).normalized())
	for k in 2:
		assert_vector(lobes[k]["mean"]).is_equal(plain[k]["mean"])
		assert_float(lobes[k]["weight"]).is_equal(plain[k]["weight"])
	assert_that(lobes[0]["tint"]).is_equal(Color(0.5, 2.25, 0.25))
	assert_that(lobes[1]["tint"]).is_equal(Color(0.5, 0.5, 2.0))
	var listed: Array = table.to_json_dictionary()["directions"][0]["lobes"]
	assert_array(listed[1]["tint"]).is_equal([0.5, 0.5, 2.0])


func test_json_dictionary() -> void:
	var table := _make_table(3, Vector2i(5, 4), Vector2(0.1, 0.4))
	var parsed: Dictionary = JSON.parse_string(
		JSON.stringify(table.to_json_dictionary(), "", false)
	)
	assert_array(parsed.keys()).contains_exactly(["brdf", "alpha", "lobes", "directions"])
	var directions: Array = parsed["directions"]
	assert_int(directions.size()).is_equal(20)
	var entry: Dictionary = directions[7]
	var listed: Array = entry["view"]
	var view := Vector3(listed[0], listed[1], listed[2])
	assert_vector(view).is_equal_approx(table.get_view(2, 1), 1e-5 * Vector3.ONE)
	var lobes: Array = entry["lobes"]
	assert_int(lobes.size()).is_equal(3)
	var sum := 0.0
	for lobe: Dictionary in lobes:
		assert_array(lobe.keys()).contains_exactly(["weight", "mean", "kappa"])
		sum += lobe["weight"]
	assert_float(sum).is_equal_approx(table.directional_albedo(view), 1e-5)


func test_files_keep_the_table(path: String, _test_parameters := FILES) -> void:
	var table := _make_table(3, Vector2i(5, 4), Vector2(0.1, 0.4))
	assert_int(ResourceSaver.save(table, path)).is_equal(OK)
	var loaded: LobeTable = ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE)
	assert_str(loaded.get_problem()).is_empty()
	assert_vector(loaded.alpha).is_equal(table.alpha)
	assert_array(loaded.image.get_data()).is_equal(table.image.get_data())
	DirAccess.remove_absolute(path)


func test_equal_tables_are_saved_as_equal_bytes() -> void:
	var sums: Array[String] = []
	for path: String in ["user://first_table_test.res", "user://second_table_test.res"]:
		var table := LobeTable.from_baked(_baked({}))
		assert_int(ResourceSaver.save(table, path, ResourceSaver.FLAG_COMPRESS)).is_equal(OK)
		sums.append(FileAccess.get_sha256(path))
		DirAccess.remove_absolute(path)
	assert_str(sums[0]).is_not_empty()
	assert_str(sums[0]).is_equal(sums[1])


func test_changes_are_told_and_renew_the_texture() -> void:
	var table := _make_table(2, Vector2i(4, 3), Vector2(0.1, 0.2))
	var told := [0]
	table.changed.connect(func() -> void: told[0] += 1)
	var before := table.get_texture()
	assert_object(table.get_texture()).is_same(before)
	table.image = table.image.duplicate() as Image
	assert_int(told[0]).is_equal(1)
	assert_bool(table.get_texture() == before).is_false()
