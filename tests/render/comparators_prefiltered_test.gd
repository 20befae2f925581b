extends GdUnitTestSuite
## The methods of `./dev compare` that have a prefiltered environment: splitsum, majoraxis8, stock.

const Kit := preload("support/render_kit.gd")
const Bench := preload("support/comparator_bench.gd")
const ComparatorKit := preload("support/comparator_kit.gd")
const MajorAxis := preload("res://bake/comparators/major_axis.gd")
const Stock := preload("res://bake/comparators/stock.gd")

const SIDE := ComparatorKit.SIDE
const METHODS: PackedStringArray = ["splitsum", "majoraxis8"]
const MATERIALS := [["ward", 0.05, 0.2], ["ward_bounded", 0.15, 0.15], ["ggx", 0.2, 0.05]]
const ROUND_MATERIALS := [["ward", 0.1], ["ward_bounded", 0.2], ["ggx", 0.1]]

var _bench: Bench


func before_test() -> void:
	_bench = auto_free(Bench.new(create_temp_dir("comparators")))
	add_child(_bench)


func after() -> void:
	clean_temp_dir()


func test_white_furnace(brdf: String, x: float, y: float, _test_parameters := MATERIALS) -> void:
	# Both multiply by the exact albedo.
	_bench.stage.panorama = Kit.constant(3.0)
	for name in METHODS:
		var pixels := await _drawn(name, brdf, x, y)
		for normal in ComparatorKit.NORMALS:
			var albedo := ComparatorKit.albedo_at(brdf, Vector2(x, y), normal)
			var share := ComparatorKit.value_at(pixels, normal) / (3.0 * albedo)
			(
				assert_float(share)
				. append_failure_message("%s, normal %s: %f of the albedo" % [name, normal, share])
				. is_equal_approx(1.0, 0.005)
			)


func test_split_sum_is_exact_along_the_normal(
	brdf: String, width: float, _test_parameters := ROUND_MATERIALS
) -> void:
	# That is what its map is filtered for. At the edge it is not.
	_bench.light_lamps()
	var expected := _bench.reference(brdf, width, width)
	var pixels := await _drawn("splitsum", brdf, width, width)
	var worst_inside := 0.0
	var worst := 0.0
	for y in SIDE:
		for x in SIDE:
			var height := Kit.sphere_normal(x, y, SIDE).z
			if height < 0.4:
				continue
			var i := 3 * (y * SIDE + x)
			var off := absf(pixels[i] / expected[i] - 1.0)
			worst = maxf(worst, off)
			if height > 0.995:
				worst_inside = maxf(worst_inside, off)
	assert_float(worst_inside).is_less(0.01)
	assert_float(worst).is_greater(0.03)


func test_bent_normal_of_the_split_sum() -> void:
	# Filament's formula on its own: grain along the bitangent, bent by the anisotropy.
	var gradient := Vector3(0.5, 0.3, -0.4)
	_bench.stage.panorama = Kit.make_panorama(
		64,
		func(direction: Vector3) -> Color:
			var value := 1.0 + gradient.dot(direction)
			return Color(value, value, value)
	)
	for widths: Vector2 in [Vector2(0.2, 0.02), Vector2(0.02, 0.2)]:
		var pixels := await _drawn("splitsum", "ward", widths.x, widths.y)
		for normal in ComparatorKit.NORMALS:
			var frame := Kit.sphere_frame(ComparatorKit.exact_normal(normal))
			var grain := frame.y if widths.x > widths.y else frame.x
			var grain_normal := grain.cross(Vector3.BACK).cross(grain)
			# 9/11 of the anisotropy; roughness sqrt(0.11) bends fully.
			var bent := frame.z.lerp(grain_normal, 9.0 / 11.0).normalized()
			var direction := 2.0 * bent.z * bent - Vector3.BACK
			var albedo := ComparatorKit.albedo_at("ward", widths, normal)
			var got := ComparatorKit.value_at(pixels, normal) / albedo
			# The map's blur takes 2 alpha² of the slope of the light.
			var left := 1.0 - 2.0 * 0.11 * 0.11
			assert_float(got).is_equal_approx(1.0 + left * gradient.dot(direction), 0.015)


func test_major_axis_lies_between_the_extrema_of_the_ellipse() -> void:
	# In a radiance of 1 + g·d, samples without width show their mean direction; here found by
	# walking around the rim.
	var gradient := Vector3(0.5, 0.3, -0.4)
	_bench.stage.panorama = Kit.make_panorama(
		64,
		func(direction: Vector3) -> Color:
			var value := 1.0 + gradient.dot(direction)
			return Color(value, value, value)
	)
	var widths := Vector2(0.3, 0.02)
	var pixels := await _drawn("majoraxis8", "ward", widths.x, widths.y)
	for normal in ComparatorKit.NORMALS:
		var frame := Kit.sphere_frame(ComparatorKit.exact_normal(normal))
		var o := frame.transposed() * Vector3.BACK
		var mean := _mean_along_major_axis(o, widths / sqrt(2.0))
		var got := ComparatorKit.value_at(pixels, normal)
		got /= LobeBaker.directional_albedo("ward", widths, o)
		var expected := 1.0 + gradient.dot(frame * mean)
		assert_float(got).append_failure_message("normal %s" % normal).is_equal_approx(
			expected, 0.012
		)


func test_major_axis_follows_a_long_highlight() -> void:
	# Closer to the reference than the bent normal that it is to replace. More samples do not converge
	# to the reference, because all of them weigh the same; they are narrower, and else much the same.
	_bench.light_lamps()
	for widths: Vector2 in [Vector2(0.15, 0.02)]:
		var expected := _bench.reference("ggx", widths.x, widths.y)
		var bent := await _drawn("splitsum", "ggx", widths.x, widths.y)
		var method: MajorAxis = _bench.make("majoraxis8", "ggx", widths.x, widths.y)
		var few := await _bench.drawn(method)
		method.samples = 64
		var many := await _bench.captured(method)
		var error := ComparatorKit.error(few, expected)
		assert_float(error).is_less(0.3 * ComparatorKit.error(bent, expected))
		assert_float(ComparatorKit.error(many, expected)).is_less(0.25)
		assert_float(ComparatorKit.error(many, few)).is_between(0.01, 0.15)


func test_stock_reflects_a_constant_sky() -> void:
	# Compatibility takes it for sRGB; the engine's albedo is below 1.
	_bench.stage.panorama = Kit.constant(0.5)
	var light := _as_the_engine_shows_it(0.5)
	for widths: Vector2 in [Vector2(0.1, 0.1), Vector2(0.1, 0.2)]:
		var pixels := await _drawn("stock", "ggx", widths.x, widths.y)
		for normal: Vector3 in ComparatorKit.NORMALS.slice(0, 3):
			var got := ComparatorKit.value_at(pixels, normal)
			assert_float(got).append_failure_message(str(normal)).is_between(
				0.75 * light, 1.02 * light
			)


func test_stock_shows_the_panorama_where_the_others_do() -> void:
	# A lamp that is smooth enough for all of them, in the range that Mobile's sky has.
	_bench.stage.panorama = Kit.make_panorama(
		64,
		func(direction: Vector3) -> Color:
			var value := 0.1 + 0.8 * exp(3.0 * (direction.dot(Vector3(-0.48, 0.64, 0.6)) - 1.0))
			return Color(value, value, value)
	)
	var expected := await _drawn("splitsum", "ggx", 0.05, 0.05)
	var got := await _drawn("stock", "ggx", 0.05, 0.05)
	var sums := Vector2.ZERO
	for i in expected.size():
		expected[i] = _as_the_engine_shows_it(expected[i])
		sums += Vector2(expected[i], got[i])
	# But for the engine's albedo. Its sky is up to half a degree off, Mobile's has ten bits,
	# and Compatibility's is taken for sRGB before it is blurred.
	for i in got.size():
		got[i] *= sums.x / sums.y
	var most := 0.2 if LinearViewport.is_compatibility() else 0.08
	assert_float(ComparatorKit.error(got, expected)).is_less(most)


func _as_the_engine_shows_it(light: float) -> float:
	if not LinearViewport.is_compatibility():
		return light
	return light * (light * (light * 0.305306011 + 0.682171111) + 0.012522878)


# The mean of eight directions as the paper places them, and none of its clamping: for views whose
# axis is above the horizon.
func _mean_along_major_axis(o: Vector3, radii: Vector2) -> Vector3:
	var mirror := Vector3(-o.x, -o.y, o.z)
	var nearest := Vector2.ZERO
	var farthest := Vector2.ZERO
	for step in 20000:
		var slope := Vector2.from_angle(PI * step / 20000.0) * radii
		var away := _mirrored(o, slope).distance_to(mirror)
		if farthest == Vector2.ZERO or away > _mirrored(o, farthest).distance_to(mirror):
			farthest = slope
		if nearest == Vector2.ZERO or away < _mirrored(o, nearest).distance_to(mirror):
			nearest = slope
	var reach := _mirrored(o, farthest).distance_to(_mirrored(o, -farthest))
	var width := _mirrored(o, nearest).distance_to(_mirrored(o, -nearest))
	var sum := Vector3.ZERO
	var end := Vector3(farthest.x, farthest.y, 1.0).normalized()
	var start := Vector3(-farthest.x, -farthest.y, 1.0).normalized()
	var kept := (reach - width) / reach
	end = Vector3.BACK.lerp(end, kept).normalized()
	start = Vector3.BACK.lerp(start, kept).normalized()
	for k in 8:
		var h := start.lerp(end, k / 7.0).normalized()
		sum += 2.0 * o.dot(h) * h - o
	return sum / 8.0


func _mirrored(o: Vector3, slope: Vector2) -> Vector3:
	var h := Vector3(slope.x, slope.y, 1.0).normalized()
	return 2.0 * o.dot(h) * h - o


# The engine filters the smallest of its maps in a fraction of the time.
func _drawn(title: String, brdf: String, x: float, y: float) -> PackedFloat32Array:
	var method := _bench.make(title, brdf, x, y)
	if method is Stock:
		(method as Stock).radiance_size = Sky.RADIANCE_SIZE_64
	return await _bench.drawn(method)
