extends GdUnitTestSuite
## LobeImageFile: what goes out comes back, and bad files are refused in one sentence.

const WIDTH := 5
const HEIGHT := 3

var _folder := ""


func before() -> void:
	_folder = create_temp_dir("lobe_image_file")


func after() -> void:
	clean_temp_dir()


func test_exr_round_trip_keeps_every_value() -> void:
	var pixels := PackedFloat32Array()
	for i in WIDTH * HEIGHT * 3:
		pixels.append(pow(1.7, i - 20))
	var path := _folder.path_join("round trip ä.exr")
	assert_str(LobeImageFile.save_exr(path, WIDTH, HEIGHT, pixels)).is_empty()
	var read := LobeImageFile.load_panorama(path)
	assert_array(read.keys()).contains_exactly_in_any_order(
		["width", "height", "pixels", "clamped", "notes", "warnings"]
	)
	assert_int(read.width).is_equal(WIDTH)
	assert_int(read.height).is_equal(HEIGHT)
	assert_int(read.clamped).is_equal(0)
	assert_int(typeof(read.pixels)).is_equal(TYPE_PACKED_FLOAT32_ARRAY)
	assert_bool(read.pixels == pixels).is_true()


func test_the_engine_reads_what_is_written() -> void:
	var pixels := PackedFloat32Array([0.25, 1.0, 4.0, 0.5, 2.0, 8.0])
	var path := _folder.path_join("engine.exr")
	assert_str(LobeImageFile.save_exr(path, 2, 1, pixels)).is_empty()
	var image := Image.load_from_file(ProjectSettings.globalize_path(path))
	assert_object(image).is_not_null()
	assert_that(image.get_pixel(0, 0)).is_equal(Color(0.25, 1.0, 4.0))
	assert_that(image.get_pixel(1, 0)).is_equal(Color(0.5, 2.0, 8.0))


func test_values_that_are_no_light_are_counted_and_replaced() -> void:
	# Three of four texels, one of them twice over.
	var pixels := PackedFloat32Array([1, -1, NAN, 1, 2, 3, INF, 0, 0, 0, -0.5, 0])
	var path := _folder.path_join("clamped.exr")
	assert_str(LobeImageFile.save_exr(path, 4, 1, pixels)).is_empty()
	var read := LobeImageFile.load_panorama(path)
	assert_int(read.clamped).is_equal(3)
	var expected := PackedFloat32Array([1, 0, 0, 1, 2, 3, 65504, 0, 0, 0, 0, 0])
	assert_bool(read.pixels == expected).is_true()
	assert_array(read.notes).contains_exactly(
		"has 2 texels with negative channels, which are 0 now",
		"has 1 texel with a channel that is no number and is 0 now"
	)
	assert_int(read.warnings.size()).is_equal(1)
	assert_str(read.warnings[0]).starts_with("has 1 texel that is infinite and has 65504 now")


func test_half_panorama_is_an_image_for_a_texture() -> void:
	var pixels := PackedFloat32Array([0.25, 1.0, 40000.0, -1.0, 2.0, NAN])
	var path := _folder.path_join("half.exr")
	assert_str(LobeImageFile.save_exr(path, 2, 1, pixels)).is_empty()
	var read := LobeImageFile.load_half_panorama(path, "", 1.0)
	assert_int(read.clamped).is_equal(1)
	assert_int(read.capped).is_equal(1)
	var image := Image.create_from_data(2, 1, false, Image.FORMAT_RGBAH, read.data)
	assert_that(image.get_pixel(0, 0)).is_equal(Color(0.5, 2.0, 65504.0))
	assert_that(image.get_pixel(1, 0)).is_equal(Color(0.0, 4.0, 0.0))


func test_layers_are_listed_and_chosen_by_name() -> void:
	var path := _folder.path_join("layers.exr")
	assert_str(LobeImageFile.save_exr(path, 1, 1, PackedFloat32Array([1, 2, 3]))).is_empty()
	assert_array(LobeImageFile.list_layers(path).layers).is_equal([""])
	assert_str(LobeImageFile.load_panorama(path, "sun").error).contains("has no layer 'sun'")
	assert_str(LobeImageFile.list_layers(_folder.path_join("no.exr")).error).contains("no.exr")


func test_radiance_file_is_known_by_its_content() -> void:
	var bytes := "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n".to_ascii_buffer()
	# 128 · 2^(129−136) = 1, 64 · 2^(130−136) = 1, and so on: (r, g, b) · 2^(e−136).
	bytes.append_array(PackedByteArray([128, 64, 32, 129, 64, 128, 255, 130]))
	var path := _write("mislabelled.exr", bytes)
	var read := LobeImageFile.load_panorama(path)
	assert_str(read.get("error", "")).is_empty()
	assert_int(read.width).is_equal(2)
	assert_int(read.height).is_equal(1)
	# A reader may add the half step that RGBE's rounding leaves open: 2^(e−137).
	for i in 6:
		var expected: float = [1.0, 0.5, 0.25, 1.0, 2.0, 255.0 / 64.0][i]
		assert_float(read.pixels[i]).is_equal_approx(expected, 1.0 / 64.0)


func test_project_environment_map_loads() -> void:
	var read := LobeImageFile.load_panorama("res://tests/data/forest.exr")
	assert_str(read.get("error", "")).is_empty()
	assert_int(read.width).is_equal(2 * read.height)
	assert_int(read.pixels.size()).is_equal(read.width * read.height * 3)


func test_missing_file() -> void:
	_assert_refused(LobeImageFile.load_panorama(_folder.path_join("nothing.exr")), "nothing.exr")


func test_folder() -> void:
	_assert_refused(LobeImageFile.load_panorama(_folder), "lobe_image_file")


func test_empty_path() -> void:
	_assert_refused(LobeImageFile.load_panorama(""), "The path is empty.")
	var message := LobeImageFile.save_exr("", 1, 1, PackedFloat32Array([1, 1, 1]))
	assert_str(message).is_equal("The path is empty.")


func test_text_in_an_exr() -> void:
	var path := _write("text.exr", "This is no picture.\n".to_ascii_buffer())
	_assert_refused(LobeImageFile.load_panorama(path), "text.exr")


func test_empty_file() -> void:
	_assert_refused(LobeImageFile.load_panorama(_write("empty.hdr", [])), "empty.hdr")


func test_cut_off_exr() -> void:
	var whole := FileAccess.get_file_as_bytes("res://tests/data/forest.exr")
	assert_int(whole.size()).is_greater(10000)
	for size: int in [4, 8, 100, whole.size() >> 1]:
		var path := _write("cut_off.exr", whole.slice(0, size))
		_assert_refused(LobeImageFile.load_panorama(path), "cut_off.exr")


func test_radiance_file_that_claims_to_be_huge() -> void:
	var bytes := "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40000 +X 40000\n".to_ascii_buffer()
	var path := _write("huge.hdr", bytes)
	_assert_refused(LobeImageFile.load_panorama(path), "huge.hdr")


func test_save_refuses_sizes_that_do_not_fit() -> void:
	var path := _folder.path_join("unsaved.exr")
	for size: Vector2i in [Vector2i(2, 2), Vector2i(0, 0), Vector2i(-1, -1), Vector2i(-1, 1)]:
		var message := LobeImageFile.save_exr(path, size.x, size.y, PackedFloat32Array([1, 1, 1]))
		_assert_one_sentence(message)
		assert_bool(FileAccess.file_exists(path)).is_false()


func test_save_into_a_missing_folder() -> void:
	var path := _folder.path_join("no_such_folder/x.exr")
	var message := LobeImageFile.save_exr(path, 1, 1, PackedFloat32Array([1, 1, 1]))
	_assert_one_sentence(message)
	assert_str(message).contains("no_such_folder")


func test_save_replaces_the_file_and_leaves_nothing_beside_it() -> void:
	var folder := create_temp_dir("lobe_image_file/replace")
	var path := folder.path_join("x.exr")
	for value: float in [1.0, 2.0]:
		var pixels := PackedFloat32Array([value, value, value])
		assert_str(LobeImageFile.save_exr(path, 1, 1, pixels)).is_empty()
		assert_float(LobeImageFile.load_panorama(path).pixels[0]).is_equal(value)
	assert_array(Array(DirAccess.get_files_at(folder))).contains_exactly("x.exr")


func _write(file_name: String, bytes: PackedByteArray) -> String:
	var path := _folder.path_join(file_name)
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_buffer(bytes)
	file.close()
	return path


func _assert_refused(result: Dictionary, named: String) -> void:
	assert_array(result.keys()).contains_exactly("error")
	var message: String = result.get("error", "")
	_assert_one_sentence(message)
	assert_str(message).contains(named)


func _assert_one_sentence(message: String) -> void:
	assert_str(message).is_not_empty()
	assert_str(message).not_contains("\n")
