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


func test_refusals(
	key: String, value: Variant, sentence: String, _test_parameters := REFUSED
) -> void:
	var request := _make_request(SIZE)
	request[key] = value
	var error: String = LobeLightFilter.new().filter(request).get("error", "")
	assert_str(error).contains(sentence)
	assert_bool("\n" in error).is_false()


func _make_request(size: int) -> Dictionary:
	var pixels := PackedFloat32Array()
	pixels.resize(WIDTH * WIDTH / 2 * 3)
	pixels.fill(1.5)
	return {"pixels": pixels, "width": WIDTH, "height": WIDTH / 2, "size": size, "threads": 1}
