extends GdUnitTestSuite
## The methods that `./dev compare` sets beside this project's own do what their papers say.

const Kit := preload("support/render_kit.gd")
const Bench := preload("support/comparator_bench.gd")
const ComparatorKit := preload("support/comparator_kit.gd")
const Oracle := preload("support/brdf_oracle.gd")
const Fis := preload("res://bake/comparators/fis.gd")
const Toral := preload("res://bake/comparators/toral.gd")
const DualParaboloidMap := preload("res://bake/comparators/dual_paraboloid_map.gd")

const SIDE := ComparatorKit.SIDE
const GRADIENT := Vector3(0.5, 0.3, -0.4)
const NORMALS := ComparatorKit.NORMALS
const MATERIALS := [
	["ward", 0.2, 0.2],
	["ward", 0.1, 0.4],
	["ward_bounded", 0.15, 0.3],
	["ggx", 0.2, 0.2],
	["ggx", 0.1, 0.4],
]
# How far the sum of the weights of 40 points may be from the albedo, at angles up to 63 degrees.
const FURNACE_BIAS := 0.03
const TABLE_FETCHES: Dictionary[String, int] = {
	"toral8": 8, "toral16": 16, "majoraxis8": 1, "majoraxis32": 1, "splitsum": 1, "stock": 1
}
# Wide enough for GGX's bounded cap to leave much out.
const CONVERGING_MATERIALS := [
	["ward", 0.1, 0.4], ["ward_bounded", 0.15, 0.3], ["ggx", 0.1, 0.4], ["ggx", 0.5, 0.5]
]
# Samples of a converged picture, and how many of them one shader takes.
const MANY := 1024
const MANY_OF_GGX := 4096
const PART := 64

var _bench: Bench


func before_test() -> void:
	_bench = auto_free(Bench.new(create_temp_dir("comparators")))
	add_child(_bench)


func after() -> void:
	clean_temp_dir()


func test_known_and_unknown_names() -> void:
	for name: String in CompareMethods.RIVALS + PackedStringArray(["gmm8"]):
		assert_str(CompareMethods.error(name)).is_empty()
		var method := CompareMethods.make(name, "ward", PackedFloat64Array([0.1, 0.1]))
		assert_str(method.name).is_equal(name)
		# What gmm costs, its table says.
		if name == "gmm8":
			continue
		var number := name.lstrip("abcdefghijklmnopqrstuvwxyz").to_int()
		match name:
			"asg":
				number = 8
			"splitsum", "stock":
				number = 1
		assert_int(method.cost()["fetches"]).is_equal(number)
		assert_int(method.cost()["probes"]).is_equal(number)
		assert_int(method.cost()["table_fetches"]).is_equal(TABLE_FETCHES.get(name, 0))
	for name: String in [
		"fis", "fis9", "fis8g", "toral4", "gmm", "gmm-1", "GMM8", "fis40gg", "allfreq", "asg8"
	]:
		assert_str(CompareMethods.error(name)).contains("is unknown")


func test_all_methods_draw_the_same_pixels() -> void:
	# Times are of equal work: the pixels whose centre is on the sphere, and no others.
	_bench.stage.panorama = Kit.constant(0.5)
	var names := CompareMethods.RIVALS + PackedStringArray(["gmm1", "gmm2", "gmm8"])
	for title in names:
		await _bench.drawn(_bench.make(title, "ward", 0.2, 0.2))
		var image := _bench.view.get_texture().get_image()
		var wrong := 0
		for y in SIDE:
			for x in SIDE:
				var p := Vector2(2 * x + 1, 2 * y + 1) / SIDE - Vector2.ONE
				var is_drawn := image.get_pixel(x, y).a > 0.5
				wrong += int(is_drawn != (p.length_squared() < 1.0))
		assert_int(wrong).append_failure_message("%s: %d pixels" % [title, wrong]).is_equal(0)


func test_hammersley_fills_the_square_evenly() -> void:
	# Of 64 points, one in each elementary interval of area 1/64.
	for columns: int in [1, 4, 8, 64]:
		var cells := {}
		for k in 64:
			var u: Vector2 = Fis.hammersley(k, 64)
			cells[Vector2i((u * Vector2(columns, 64.0 / columns)).floor())] = true
		assert_int(cells.size()).is_equal(64)


func test_fis_weights_and_levels(
	brdf: String, x: float, y: float, _test_parameters := MATERIALS
) -> void:
	# In a cube map whose levels hold 1 + their number, a sample shows its level.
	_bench.stage._lights["box"] = ComparatorKit.level_light(32, "box")
	for form in ComparisonStage.FIS_FORMS:
		_bench.stage.fis_form = form
		var pixels := await _bench.drawn(_fis(brdf, x, y, 8))
		var bounded := form != "published"
		for normal in NORMALS:
			var exact := ComparatorKit.exact_normal(normal)
			var frame := ComparatorKit.frame(exact, x == y)
			var o := frame.transposed() * Vector3.BACK
			var expected := 0.0
			var lowest := INF
			for k in 8:
				var u := Fis.hammersley(k, 8)
				var h := Oracle.sample(brdf, Vector2(x, y), u, o, bounded)
				var direction := (frame * (2.0 * o.dot(h) * h - o)).abs()
				var m := direction[direction.max_axis_index()]
				var texel := 4.0 / (32.0 * 32.0) * pow(m, 3.0)
				var density := Oracle.density(brdf, Vector2(x, y), h, o, bounded)
				var solid_angle := _kernel(form, brdf, Vector2(x, y), h, o) / density
				var level := clampf(0.5 * log(solid_angle / texel) / log(2.0), 0.0, 5.0)
				expected += Oracle.weight(brdf, Vector2(x, y), h, o, bounded) * (1.0 + level) / 8.0
				lowest = minf(lowest, level)
			assert_float(lowest).is_less(4.0)
			var got := ComparatorKit.value_at(pixels, normal)
			_assert_close(got, expected, 0.01, "%s, normal %s" % [form, exact])


func test_kernels_hold_their_share_of_the_density() -> void:
	# Of e^-t² / pi, by summing it up over the disc.
	for square: float in [0.0, 0.1, 1.0, 3.0, 6.0]:
		for share: float in [1.0 / 8.0, 1.0 / 40.0, 1.0 / 1024.0]:
			var radius := sqrt(Fis.kernel_square(square, share))
			var sum := 0.0
			for ring in 64:
				var r := radius * (ring + 0.5) / 64.0
				for step in 64:
					var t := Vector2(sqrt(square), 0.0) + r * Vector2.from_angle(TAU * step / 64.0)
					sum += exp(-t.length_squared()) / PI * r * radius / 64.0 * TAU / 64.0
			assert_float(sum / share).is_equal_approx(1.0, 1e-3)


func test_bounded_samples_reflect_upwards_more_often() -> void:
	# The density is one of the whole sphere: its mean inverse over the samples, of those that go
	# upwards, is what they cover of the hemisphere, which is all of it.
	var alpha := Vector2(0.6, 0.8)
	var count := 4096
	for o: Vector3 in [Vector3(0.0, 0.0, 1.0), Vector3(0.5, 0.2, 0.8), Vector3(-0.3, 0.9, 0.4)]:
		var kept := Vector2i.ZERO
		var covered := 0.0
		for k in count:
			for bounded: bool in [false, true]:
				var u := Fis.hammersley(k, count)
				var h := Oracle.sample("ggx", alpha, u, o.normalized(), bounded)
				var i := 2.0 * o.normalized().dot(h) * h - o.normalized()
				kept[int(bounded)] += int(i.z > 0.0)
				if bounded and i.z > 0.0:
					covered += 1.0 / Oracle.density("ggx", alpha, h, o.normalized(), true) / count
		assert_int(kept.y).is_greater(kept.x)
		assert_float(covered / TAU).is_equal_approx(1.0, 0.01)


func test_fis_on_a_wider_pyramid_blurs_as_on_means_of_two_by_two() -> void:
	# A level of the Gaussian pyramid blurs by four times the variance.
	var variances: Array[float] = ComparisonStage.Pyramid.LEVEL_VARIANCES
	assert_float(Fis.matching_bias(variances[ComparisonStage.FILTERS["box"]])).is_equal(0.0)
	var gaussian: float = Fis.matching_bias(variances[ComparisonStage.FILTERS["gaussian"]])
	assert_float(gaussian).is_equal_approx(-1.0, 1e-6)


func test_fis_converges_to_the_reference(
	brdf: String, x: float, y: float, _test_parameters := CONVERGING_MATERIALS
) -> void:
	var expected := _bench.reference(brdf, x, y)
	_bench.light_lamps()
	var few := ComparatorKit.error(await _bench.drawn(_fis(brdf, x, y, 8)), expected)
	var more := ComparatorKit.error(await _bench.drawn(_fis(brdf, x, y, 40)), expected)
	var count := MANY_OF_GGX if brdf == "ggx" else MANY
	var most := ComparatorKit.error(await _drawn_in_parts(_fis(brdf, x, y, count)), expected)
	var figures := "%f, %f, %f" % [few, more, most]
	assert_float(more).append_failure_message(figures).is_less(0.4 * few)
	assert_float(most).append_failure_message(figures).is_less(0.005)


func test_white_furnace_of_fis(
	brdf: String, x: float, y: float, _test_parameters := MATERIALS
) -> void:
	_bench.stage.panorama = Kit.constant(3.0)
	for own_pyramid: bool in [false, true]:
		var method := _fis(brdf, x, y, 40)
		method.on_own_pyramid = own_pyramid
		var pixels := await _bench.drawn(method)
		for normal in NORMALS:
			var albedo := ComparatorKit.albedo_at(brdf, Vector2(x, y), normal)
			var got := ComparatorKit.value_at(pixels, normal)
			_assert_close(got, 3.0 * albedo, FURNACE_BIAS, "normal %s" % normal)


func test_white_furnace_of_toral() -> void:
	_bench.stage.panorama = Kit.constant(3.0)
	var method := _toral(Kit.make_odd_table(8, Vector2i(9, 1), Vector2(0.2, 0.2)))
	var pixels := await _drawn_with_table(method)
	for normal in NORMALS:
		var exact := ComparatorKit.exact_normal(normal)
		var nearest := roundi(method.table.get_column(acos(exact.z)))
		var albedo := method.table.directional_albedo(method.table.get_view(nearest, 0))
		_assert_close(ComparatorKit.value_at(pixels, normal), 3.0 * albedo, 0.005, str(exact))


func test_toral_texture_holds_the_lobes() -> void:
	var table := Kit.make_odd_table(8, Vector2i(7, 4), Vector2(0.1, 0.4))
	var image: Image = Toral.make_lobe_image(table)
	assert_vector(image.get_size()).is_equal(Vector2i(28, 8))
	for azimuth in 4:
		for elevation in 7:
			var lobes := table.lobes_at(table.get_view(elevation, azimuth))
			for k in 8:
				var texel := image.get_pixel(azimuth * 7 + elevation, k)
				var mean := Vector3(
					sin(texel.b) * cos(texel.a), sin(texel.b) * sin(texel.a), cos(texel.b)
				)
				var expected: Vector3 = lobes[k]["mean"]
				assert_vector(mean).is_equal_approx(expected.normalized(), 1e-5 * Vector3.ONE)
				var kappa: float = lobes[k]["kappa"]
				assert_float(texel.g).is_equal_approx(kappa, 1e-5 * kappa)
				assert_float(texel.r).is_equal_approx(lobes[k]["weight"], 1e-6)


func test_toral_takes_the_lobes_of_the_nearest_view() -> void:
	# In a radiance 1 + g·d a lobe gives weight (1 + A g·mean), A = coth kappa - 1/kappa.
	_bench.stage.panorama = Kit.make_panorama(64, _linear)
	for table: LobeTable in [
		Kit.make_odd_table(8, Vector2i(9, 1), Vector2(0.2, 0.2), 9.0),
		Kit.make_odd_table(16, Vector2i(7, 4), Vector2(0.1, 0.4), 9.0),
	]:
		var pixels := await _drawn_with_table(_toral(table))
		for normal: Vector3 in NORMALS + [Vector3(-0.7, -0.8, 1.0)] as Array[Vector3]:
			var exact := ComparatorKit.exact_normal(normal)
			var frame := ComparatorKit.frame(exact, table.is_isotropic())
			var o := frame.transposed() * Vector3.BACK
			var fold := Vector3(signf(o.x), signf(o.y), 1.0)
			if table.is_isotropic():
				fold = Vector3.ONE
			var expected := 0.0
			for lobe in table.lobes_at(_nearest_view(table, o * fold)):
				var mean: Vector3 = frame * (fold * (lobe["mean"] as Vector3))
				var left := Kit.mean_cosine(lobe["kappa"])
				expected += (lobe["weight"] as float) * (1.0 + left * GRADIENT.dot(mean))
			var got := ComparatorKit.value_at(pixels, normal)
			_assert_close(got, expected, 0.015, "normal %s" % exact)


func test_toral_levels() -> void:
	# As for FIS: levels that hold 1 + their number.
	var table := Kit.make_odd_table(8, Vector2i(9, 1), Vector2(0.2, 0.2))
	var map := DualParaboloidMap.new()
	map.side = 64
	map.texture = Texture2DArray.new()
	map.texture.create_from_images([ComparatorKit.level_image(64), ComparatorKit.level_image(64)])
	_bench.stage._map = map
	for coverage: float in [0.47, 0.9]:
		_bench.stage.toral_coverage = coverage
		var pixels := await _drawn_with_table(_toral(table))
		for normal in NORMALS:
			var frame := ComparatorKit.frame(ComparatorKit.exact_normal(normal), true)
			var o := frame.transposed() * Vector3.BACK
			var expected := 0.0
			for lobe in table.lobes_at(_nearest_view(table, o)):
				var direction: Vector3 = frame * (lobe["mean"] as Vector3)
				var lobe_angle: float = -TAU * log(1.0 - coverage) / (lobe["kappa"] as float)
				var density := 4.0 * 1.2 * 1.2 * pow(absf(direction.z) + 1.0, 2.0)
				var level := 0.5 * log(lobe_angle / (density / (64.0 * 64.0))) / log(2.0)
				expected += (lobe["weight"] as float) * (1.0 + clampf(level, 0.0, 6.0))
			var got := ComparatorKit.value_at(pixels, normal)
			_assert_close(got, expected, 0.01, "normal %s, coverage %f" % [normal, coverage])


func test_dual_paraboloid_map_has_levels_of_two_by_two_means() -> void:
	_bench.stage.panorama = Kit.make_panorama(16, _linear)
	var map := await _bench.stage.dual_paraboloid_map()
	assert_int(map.side).is_equal(64)
	for half in 2:
		var image: Image = map.texture.get_layer_data(half)
		# Compatibility reads only the finest level back.
		if not image.has_mipmaps():
			continue
		var finer := _level_of(image, 0)
		var coarser := _level_of(image, 1)
		for y in coarser.get_height():
			for x in coarser.get_width():
				var sum := 0.0
				for offset: Vector2i in [
					Vector2i(0, 0), Vector2i(1, 0), Vector2i(0, 1), Vector2i(1, 1)
				]:
					sum += finer.get_pixelv(2 * Vector2i(x, y) + offset).r
				assert_float(coarser.get_pixel(x, y).r).is_equal_approx(0.25 * sum, 0.002)


static func _linear(direction: Vector3) -> Color:
	var value := 1.0 + GRADIENT.dot(direction)
	return Color(value, 2.0 * value, 0.5 * value)


func _fis(brdf: String, x: float, y: float, samples: int) -> Fis:
	var method: Fis = Fis.make(samples, false)
	method.name = "fis%d" % samples
	method.brdf = brdf
	method.alpha = [x, y]
	return method


# A sample's kernel, times the density there: one of eight where the density is taken for constant.
func _kernel(form: String, brdf: String, alpha: Vector2, h: Vector3, o: Vector3) -> float:
	var share := 1.0 / 8.0
	if form == "published" or (form == "best" and brdf == "ggx"):
		return share
	if brdf != "ggx":
		var square := (Vector2(h.x, h.y) / (alpha * h.z)).length_squared()
		return Fis.kernel_square(square, share) * exp(-square)
	# Samples are spread evenly over a cap of the sphere about the stretched view v, whose normals'
	# slopes about v are its stereographic picture: a disc there is a cap's, whose share is known.
	var v := Oracle.stretched(alpha, o)
	var half_way := Vector3(h.x / alpha.x, h.y / alpha.y, h.z).normalized()
	var away := tan(v.angle_to(half_way))
	var angle := acos(1.0 - (1.0 + Oracle.lower_end(alpha, o)) * share)
	# By bisection, the cap whose picture's middle is there.
	var low := 0.0
	var high := PI - angle
	for step in 50:
		var middle := 0.5 * (low + high)
		var ends := Vector2(tan(0.5 * (middle - angle)), tan(0.5 * (middle + angle)))
		if 0.5 * (ends.x + ends.y) < away:
			low = middle
		else:
			high = middle
	var radius := 0.5 * (tan(0.5 * (low + angle)) - tan(0.5 * (low - angle)))
	# Over the plane, 1 / (pi (1 + away²)²) times the sphere's area over the cap's.
	var density := 2.0 / (1.0 + Oracle.lower_end(alpha, o)) / PI / pow(1.0 + away * away, 2.0)
	return PI * radius * radius * density


func _toral(table: LobeTable) -> Toral:
	var method: Toral = Toral.make(table.lobe_count)
	method.table = table
	return method


func _drawn_with_table(method: Toral) -> PackedFloat32Array:
	assert_str(await method.use(method.table, _bench.stage)).is_empty()
	return await _bench.captured(method)


# The mean of the pictures of all parts of the samples.
func _drawn_in_parts(method: Fis) -> PackedFloat32Array:
	assert_str(await method.prepare(_bench.stage)).is_empty()
	var sphere := method.make_part(0, PART)
	var material := (sphere.mesh as QuadMesh).material as ShaderMaterial
	_bench.view.add_child(sphere)
	var sums := PackedFloat32Array()
	sums.resize(3 * SIDE * SIDE)
	for first in range(0, method.samples, PART):
		material.set_shader_parameter(&"fis_samples", method.constants(first, PART))
		var pixels := await _bench.pixels()
		for i in sums.size():
			sums[i] += pixels[i] * PART / method.samples
	sphere.free()
	return sums


func _level_of(image: Image, level: int) -> Image:
	var size := image.get_width() >> level
	var offset := image.get_mipmap_offset(level)
	var data := image.get_data().slice(offset, offset + size * size * 8)
	return Image.create_from_data(size, size, false, Image.FORMAT_RGBAH, data)


# `o` in the first quadrant.
func _nearest_view(table: LobeTable, o: Vector3) -> Vector3:
	var best := Vector3.ZERO
	var least := INF
	for azimuth in table.views.y:
		for elevation in table.views.x:
			var view := table.get_view(elevation, azimuth)
			# Nearest in angle and azimuth, as the texture is laid out.
			var azimuth_angle := 0.5 * PI * azimuth / maxf(table.views.y - 1, 1)
			var across := 0.0 if table.is_isotropic() else absf(atan2(o.y, o.x) - azimuth_angle)
			var away := absf(acos(o.z) - acos(view.z)) + across
			if away < least:
				least = away
				best = view
	return best


func _assert_close(got: float, expected: float, tolerance: float, what: String) -> void:
	(
		assert_float(got / expected)
		. append_failure_message("%s: %f, expected %f" % [what, got, expected])
		. is_equal_approx(1.0, tolerance)
	)
