extends GdUnitTestSuite
## The pyramid of LobeEnvironment3D, on environments whose every level is known.

const Kit := preload("support/render_kit.gd")
const Pyramid := preload("res://addons/lobelight/runtime/pyramid/pyramid.gd")
const PyramidChain := preload("res://addons/lobelight/runtime/pyramid/pyramid_chain.gd")

const FILTERS := [
	[Pyramid.Filter.BOX],
	[Pyramid.Filter.BINOMIAL],
	[Pyramid.Filter.GAUSSIAN],
	[Pyramid.Filter.DISC],
]
const ROUND_FILTERS := [[Pyramid.Filter.GAUSSIAN], [Pyramid.Filter.DISC]]
const SIZE := 32
const GRADIENT := Vector3(0.4, -0.3, 0.2)


# A steep environment: an even grey, and small lights wherever kernels differ.
static func _lights(direction: Vector3) -> Color:
	var sum := 0.05
	for light: Vector3 in [Vector3(1, 0, 0), Vector3(1, 1, 0), Vector3(1, 1, 1), Vector3(-3, 1, 2)]:
		sum += 40.0 * exp(400.0 * (light.normalized().dot(direction) - 1.0))
	return Color(sum, 2.0 * sum, 0.5 * sum)


static func _linear(direction: Vector3) -> Color:
	var value := 1.0 + GRADIENT.dot(direction)
	return Color(value, value, value)


func test_constant_stays_constant(filter: Pyramid.Filter, _test_parameters := FILTERS) -> void:
	for value: float in [0.01, 0.7, 64.0]:
		var faces: Array[Image] = await _build(Kit.constant(value), SIZE, filter)
		var stored := PackedByteArray([0, 0])
		stored.encode_half(0, value)
		var half := stored.decode_half(0)
		for face in faces:
			var data := face.get_data()
			for i in range(0, data.size(), 8):
				# One step of a half float either way.
				var off := absf(data.decode_half(i) / half - 1.0)
				if off > 0.001:
					fail("%s at byte %d of a face of %s" % [data.decode_half(i), i, half])
					return
	assert_bool(true).is_true()


func test_light_of_the_sphere_is_kept(filter: Pyramid.Filter, _test_parameters := FILTERS) -> void:
	var faces: Array[Image] = await _build(Kit.make_panorama(64, _lights), SIZE, filter)
	var before := _mean(Kit.level_of(faces, 0))
	for level in range(1, 6):
		var after := _mean(Kit.level_of(faces, level))
		assert_float(after / before).append_failure_message("level %d" % level).is_equal_approx(
			1.0, 0.01
		)
		before = after


func test_no_seam(filter: Pyramid.Filter, _test_parameters := FILTERS) -> void:
	# Blurring by anything symmetric leaves of a radiance linear in the direction a linear one, of the
	# same mean and less slope. At an edge the slope must be the same as elsewhere.
	var faces: Array[Image] = await _build(Kit.make_panorama(64, _linear), SIZE, filter)
	for level in 4:
		var images := Kit.level_of(faces, level)
		var size := images[0].get_width()
		var slope := _slope(images)
		var worst := 0.0
		for face in 6:
			for y in size:
				for x in size:
					var direction := Kit.texel_direction(face, x, y, size)
					var expected := 1.0 + slope * GRADIENT.dot(direction)
					worst = maxf(worst, absf(images[face].get_pixel(x, y).r - expected))
		# Box kernels lie askew on the sphere; for 4 x 4 texels that is a little.
		assert_float(worst).append_failure_message("level %d, slope %f" % [level, slope]).is_less(
			0.0015 if level == 0 else 0.01 * pow(2.0, level - 1)
		)


func test_variance_of_levels(filter: Pyramid.Filter, _test_parameters := FILTERS) -> void:
	# The shader's V_l is t² (b + a (c (4^l - 1) + 4^l / 6)), a = m³ or 1, of which the sampler's tent
	# has t² m³ 4^l / 6.
	var c := Pyramid.LEVEL_VARIANCES[filter]
	var even := Pyramid.is_round(filter)
	# Towards the corners the texels of the cube are askew, and so are their means. Faces of 8 texels
	# and fewer are no matter of variances, see seam_test.gd.
	var tolerances: Dictionary[Vector3, float] = {
		Vector3(0.1, 0.05, 1): 0.1, Vector3(1, 0.8, 0.2): 0.1, Vector3(1, 1, 0.9): 0.2
	}
	for centre in tolerances:
		var axis := centre.normalized()
		# Wide enough for the texels of the levels that are measured.
		var blob := func(direction: Vector3) -> Color:
			var value := exp(80.0 * (axis.dot(direction) - 1.0))
			return Color(value, value, value)
		var faces: Array[Image] = await _build(Kit.make_panorama(64, blob), 128, filter)
		var start := Kit.level_of(faces, 0)
		var before := _variance(start, axis)
		var m_cubed := _mean_m_cubed(start)
		var texel := 4.0 / (128.0 * 128.0)
		for level in [2, 3]:
			var added := _variance(Kit.level_of(faces, level), axis) - before
			var stated := texel * c * (pow(4.0, level) - 1.0)
			if even:
				stated += texel * (1.0 - m_cubed) / 6.0 * (pow(4.0, level) - 1.0)
			else:
				stated *= m_cubed
			(
				assert_float(added / stated)
				. append_failure_message("level %d about %s" % [level, axis])
				. is_equal_approx(1.0, tolerances[centre])
			)


func test_level_0_is_blurred_where_the_panorama_is_coarse(
	filter: Pyramid.Filter, _test_parameters := ROUND_FILTERS
) -> void:
	# In the middle of a face, at a corner, beside a pole.
	for axis: Vector3 in [
		Vector3(0.1, 0.05, 1).normalized(),
		Vector3(1, 1, 0.9).normalized(),
		Vector3(0.02, 1, 0.03).normalized(),
	]:
		var blob := func(direction: Vector3) -> Color:
			var value := exp(200.0 * (axis.dot(direction) - 1.0))
			return Color(value, value, value)
		var panorama := Kit.make_panorama(64, blob)
		# One sample per texel, and nothing else.
		var sharp: Array[Image] = await _build(panorama, 64, Pyramid.Filter.BOX)
		var blurred: Array[Image] = await _build(panorama, 64, filter)
		var added := (
			_variance(Kit.level_of(blurred, 0), axis) - _variance(Kit.level_of(sharp, 0), axis)
		)
		var shrinking := (1.0 - _mean_m_cubed(Kit.level_of(sharp, 0))) / 6.0
		var texel := 4.0 / (64.0 * 64.0)
		var stated := texel * (Pyramid.base_variance(panorama, 64, filter) + shrinking)
		assert_float(stated).is_greater(0.0)
		assert_float(added / stated).is_equal_approx(1.0, 0.05)
	# Whose texels are finer than half the cube's.
	var fine := Kit.make_panorama(128, func(_direction: Vector3) -> Color: return Color.WHITE)
	assert_float(Pyramid.base_variance(fine, 64, filter)).is_equal(0.0)


func test_bad_texels_are_dark() -> void:
	var image := Image.create_empty(64, 32, false, Image.FORMAT_RGBAF)
	image.fill(Color(0.5, 0.5, 0.5))
	var right := Vector2i(16, 16)
	for offset: Vector2i in [Vector2i.ZERO, Vector2i(0, 3), Vector2i(4, 0)]:
		image.set_pixelv(right + offset, Color(NAN, -5.0, INF))
	var texture := ImageTexture.create_from_image(image)
	var faces: Array[Image] = await _build(texture, SIZE, Pyramid.Filter.GAUSSIAN)
	var darkest := 1.0
	for level in 6:
		for face in Kit.level_of(faces, level):
			for y in face.get_height():
				for x in face.get_width():
					var pixel := face.get_pixel(x, y)
					for channel in 3:
						var sound: bool = pixel[channel] >= 0.0 and pixel[channel] <= 0.5005
						assert_bool(sound).append_failure_message(str(pixel)).is_true()
						darkest = minf(darkest, pixel[channel])
	# The texels count as 0, they are not left out; level 0 is blurred, though.
	assert_float(darkest).is_less(0.4)


func test_srgb_pictures_are_decoded() -> void:
	var image := Image.create_empty(16, 8, false, Image.FORMAT_RGB8)
	image.fill(Color8(128, 64, 255))
	var texture := ImageTexture.create_from_image(image)
	var faces: Array[Image] = await _build(texture, 8, Pyramid.Filter.BOX)
	var got := faces[0].get_pixel(3, 3)
	# IEC 61966-2-1: 128/255 is 0.2158605, 64/255 is 0.0512695.
	assert_float(got.r).is_equal_approx(0.2158605, 0.0003)
	assert_float(got.g).is_equal_approx(0.0512695, 0.0001)
	assert_float(got.b).is_equal_approx(1.0, 0.001)


func test_fine_panoramas_lose_no_light() -> void:
	# One texel of 256 × 128, which single samples of 8 × 8 texels would miss or overrate.
	var image := Image.create_empty(256, 128, false, Image.FORMAT_RGBAF)
	var texel := Vector2i(150, 50)
	image.set_pixelv(texel, Color(5000.0, 0.0, 0.0))
	var texture := ImageTexture.create_from_image(image)
	var faces: Array[Image] = await _build(texture, 8, Pyramid.Filter.BOX)
	var solid_angle := sin(PI * (texel.y + 0.5) / 128.0) * (PI / 128.0) * (TAU / 256.0)
	var expected := 5000.0 * solid_angle / (4.0 * PI)
	assert_float(_mean(Kit.level_of(faces, 0)) / expected).is_between(0.8, 1.25)


func _build(panorama: Texture2D, size: int, filter: Pyramid.Filter) -> Array[Image]:
	var chain := PyramidChain.new()
	chain.pyramid.set_up_panorama(panorama, size, filter)
	chain.make_cube()
	chain.draw(-1)
	await RenderingServer.frame_post_draw
	assert_bool(chain.receive(-1)).is_true()
	# What materials sample, read back.
	var faces: Array[Image] = chain.cube.get_faces()
	assert_int(faces.size()).is_equal(6)
	assert_int(faces[0].get_mipmap_count()).is_equal(roundi(log(size) / log(2.0)))
	return faces


# The mean over the sphere of the first channel.
func _mean(images: Array[Image]) -> float:
	var sum := 0.0
	var size := images[0].get_width()
	for image in images:
		for y in size:
			for x in size:
				sum += image.get_pixel(x, y).r * Kit.texel_solid_angle(x, y, size)
	return sum / (4.0 * PI)


# What is left of GRADIENT: the least-squares slope.
func _slope(images: Array[Image]) -> float:
	var numerator := 0.0
	var denominator := 0.0
	var size := images[0].get_width()
	for face in 6:
		for y in size:
			for x in size:
				var along := GRADIENT.dot(Kit.texel_direction(face, x, y, size))
				var weight := Kit.texel_solid_angle(x, y, size)
				numerator += weight * along * (images[face].get_pixel(x, y).r - 1.0)
				denominator += weight * along * along
	return numerator / denominator


# The second moment about an axis, per axis across it, in radians squared.
func _variance(images: Array[Image], axis: Vector3) -> float:
	var sum := 0.0
	var weights := 0.0
	var size := images[0].get_width()
	for face in 6:
		for y in size:
			for x in size:
				var weight := images[face].get_pixel(x, y).r * Kit.texel_solid_angle(x, y, size)
				var direction := Kit.texel_direction(face, x, y, size)
				# Two axes; 2 (1 - cos) is the squared distance.
				sum += weight * (1.0 - direction.dot(axis))
				weights += weight
	return sum / weights


# The mean of m³ over the light, m being the direction's largest component.
func _mean_m_cubed(images: Array[Image]) -> float:
	var sum := 0.0
	var weights := 0.0
	var size := images[0].get_width()
	for face in 6:
		for y in size:
			for x in size:
				var weight := images[face].get_pixel(x, y).r * Kit.texel_solid_angle(x, y, size)
				var components := Kit.texel_direction(face, x, y, size).abs()
				sum += weight * pow(components[components.max_axis_index()], 3.0)
				weights += weight
	return sum / weights
