extends GdUnitTestSuite
## LobeLightFilter as a task. Whether its light is right, tests/render/cpu_pyramid_test.gd and the
## library's own tests say.

const SIZE := 8
const WIDTH := 16

const REFUSED := [
	["size", 12, "size is 12, but must be a power of two"],
	["size", "big", 'size is "big" (String)'],
	["filter", "box", 'filter is "box"'],
	["samples", 0, "samples is 0"],
	["base_variance", -1.0, "base_variance"],
	["level_variance", 0, "level_variance"],
	["width", 7, "pixels must be a PackedFloat32Array of width * height * 3 = 168 numbers"],
	["height", 0, "panorama: has no pixels (16 x 0)"],
	["height", 100000, "panorama: claims 16 x 100000 pixels"],
	["pixels", [1.0], "pixels must be a PackedFloat32Array"],
	["max_sources", 5, "max_sources is 5, but must be from 0 to 4."],
	["max_sources", -1, "max_sources is -1"],
	["pixels", null, "pixels must be a PackedFloat32Array"],
	["sharp", true, '"sharp" is not a key of a panorama to filter'],
]


func test_even_light_fills_every_level() -> void:
	var result := LobeLightFilter.new().filter(_make_request(SIZE))
	assert_str(result.get("error", "")).is_empty()
	assert_int(result["size"]).is_equal(SIZE)
	var faces: Array = result["faces"]
	assert_int(faces.size()).is_equal(6)
	for data: PackedByteArray in faces:
		var image := Image.create_from_data(SIZE, SIZE, true, Image.FORMAT_RGBAH, data)
		assert_object(image).is_not_null()
		for at in range(0, data.size(), 8):
			assert_float(data.decode_half(at + 2)).is_equal(1.5)
			assert_float(data.decode_half(at + 6)).is_equal(1.0)


func test_works_in_the_background() -> void:
	var task := LobeLightFilter.new()
	assert_bool(task.start(_make_request(SIZE))).is_true()
	var result: Dictionary = await task.finished
	assert_int((result["faces"] as Array).size()).is_equal(6)
	assert_float(task.get_progress()).is_equal(1.0)
	assert_dict(task.get_result()).is_equal(result)


func test_can_be_cancelled() -> void:
	var task := LobeLightFilter.new()
	# Seconds of work.
	assert_bool(task.start(_make_request(1024))).is_true()
	task.cancel()
	while task.is_running():
		await get_tree().process_frame
	assert_dict(task.get_result()).is_empty()
	assert_str(task.get_error()).is_empty()
	assert_float(task.get_progress()).is_less(1.0)


func test_takes_a_sun_out_of_the_light() -> void:
	var request := _make_sun_request()
	var result := LobeLightFilter.new().filter(request)
	assert_int(result["source_count"]).is_equal(1)
	var sources: PackedFloat32Array = result["sources"]
	assert_int(sources.size()).is_equal(48)
	var image := Image.create_from_data(4, 3, false, Image.FORMAT_RGBAF, sources.to_byte_array())
	# Two by two texels about u = 1/4, v = 1/4: half-way up at +X.
	var direction := image.get_pixel(0, 0)
	var wanted := Vector3(sqrt(0.5), sqrt(0.5), 0.0)
	assert_vector(Vector3(direction.r, direction.g, direction.b)).is_equal_approx(
		wanted, Vector3.ONE * 1e-3
	)
	assert_float(direction.a).is_between(0.5 * PI / 128.0, PI / 128.0)
	var texel := PI / 128.0 * PI / 128.0 * sqrt(0.5)
	assert_float(image.get_pixel(0, 1).g).is_equal_approx(4e6 * texel, 4.0)
	assert_that(image.get_pixel(1, 1)).is_equal(Color(0.0, 0.0, 0.0, 0.0))
	# What is left is what there was beside it, and the light without a sun.
	request["pixels"] = _make_even_pixels(256)
	var even := LobeLightFilter.new().filter(request)
	assert_int(even["source_count"]).is_equal(0)
	for face in 6:
		var left: PackedByteArray = result["faces"][face]
		var without: PackedByteArray = even["faces"][face]
		for at in range(0, left.size(), 8):
			var value := without.decode_half(at)
			# The level that stays is at most 1.5 times the surroundings', or 1/65536 of the sun.
			assert_float(left.decode_half(at)).is_between(value, 16.0)
	var coarsest: PackedByteArray = result["faces"][0]
	assert_float(coarsest.decode_half(coarsest.size() - 8)).is_less(1.6)


func test_finds_sources_alone() -> void:
	var request := _make_sun_request()
	var found := LobeLightFilter.new().find_sources(request)
	assert_bool(found.has("faces")).is_false()
	assert_bool(request.has("only_sources")).is_false()
	var filtered := LobeLightFilter.new().filter(request)
	assert_that(found["sources"]).is_equal(filtered["sources"])
	# None are looked for where none are asked for, nor in pictures that end at white.
	request.erase("max_sources")
	assert_int(LobeLightFilter.new().find_sources(request)["source_count"]).is_equal(0)
	request["max_sources"] = 4
	request["srgb"] = true
	assert_int(LobeLightFilter.new().find_sources(request)["source_count"]).is_equal(0)
	assert_str(LobeLightFilter.new().find_sources({}).get("error", "")).is_not_empty()


func test_an_infinite_sun_is_as_bright_as_its_reader_makes_it() -> void:
	var request := _make_sun_request(INF)
	assert_int(LobeLightFilter.new().find_sources(request)["source_count"]).is_equal(0)
	var path := "user://infinite_sun.exr"
	assert_str(LobeImageFile.save_exr(path, 256, 128, request["pixels"])).is_empty()
	request["pixels"] = LobeImageFile.load_panorama(path)["pixels"]
	var found := LobeLightFilter.new().find_sources(request)
	assert_int(found["source_count"]).is_equal(1)
	var sources: PackedFloat32Array = found["sources"]
	var texel := PI / 128.0 * PI / 128.0 * sqrt(0.5)
	assert_float(sources[16]).is_equal_approx(4.0 * 65504.0 * texel, 0.5)
	# On a map as coarse as that of the field, a sun of 17 degrees is none.
	var read := LobeImageFile.load_panorama("res://tests/data/field/inf_sun.exr")
	var coarse := {
		"pixels": read["pixels"], "width": read["width"], "height": read["height"], "max_sources": 4
	}
	assert_int(LobeLightFilter.new().find_sources(coarse)["source_count"]).is_equal(0)


func test_says_what_light_is_lost_unless_it_is_a_source() -> void:
	var request := _make_sun_request()
	assert_array(LobeLightFilter.new().find_sources(request)["warnings"]).is_empty()
	request["max_sources"] = 0
	var warnings: Array = LobeLightFilter.new().find_sources(request)["warnings"]
	assert_int(warnings.size()).is_equal(1)
	assert_str(warnings[0]).contains("4 texels that are brighter than 65504")
	assert_str(warnings[0]).contains("an Exposure of -4.0 EV keeps it")
	# Exposure comes first.
	request["exposure"] = -4.0
	assert_array(LobeLightFilter.new().find_sources(request)["warnings"]).is_empty()
	request["max_sources"] = 4
	var darker: PackedFloat32Array = LobeLightFilter.new().find_sources(request)["sources"]
	request.erase("exposure")
	var sources: PackedFloat32Array = LobeLightFilter.new().find_sources(request)["sources"]
	assert_float(16.0 * darker[16]).is_equal_approx(sources[16], 1e-3)


func test_refusals(
	key: String, value: Variant, sentence: String, _test_parameters := REFUSED
) -> void:
	var request := _make_request(SIZE)
	request[key] = value
	var error: String = LobeLightFilter.new().filter(request).get("error", "")
	assert_str(error).contains(sentence)
	assert_bool("\n" in error).is_false()


func _make_request(size: int) -> Dictionary:
	return {
		"pixels": _make_even_pixels(WIDTH),
		"width": WIDTH,
		"height": WIDTH / 2,
		"size": size,
		"threads": 1
	}


func _make_sun_request(radiance := 1e6) -> Dictionary:
	var pixels := _make_even_pixels(256)
	for texel: int in [31 * 256 + 63, 31 * 256 + 64, 32 * 256 + 63, 32 * 256 + 64]:
		for channel in 3:
			pixels[3 * texel + channel] = radiance
	return {"pixels": pixels, "width": 256, "height": 128, "size": 64, "max_sources": 4}


func _make_even_pixels(width: int) -> PackedFloat32Array:
	var pixels := PackedFloat32Array()
	pixels.resize(width * width / 2 * 3)
	pixels.fill(1.5)
	return pixels
