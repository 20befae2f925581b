extends GdUnitTestSuite
## LobeBaker with files of measurements: what comes back, and what is refused.

const PATH := "user://measured_brdf_test.bsdf"

## Reflectance times cosine of the file, the same in all directions.
const VALUE := 0.1


func after() -> void:
	DirAccess.remove_absolute(ProjectSettings.globalize_path(PATH))


## An isotropic RGL file: "tensor_file", its version, and for each field name, dimensions, type,
## offset and shape, as the reader's header says. Every warp is the identity.
func _write_file(bad_values: int, colour := Color.WHITE) -> void:
	var names := ["theta_i", "phi_i", "ndf", "sigma", "vndf", "rgb", "jacobian"]
	var shapes := [[3], [1], [2, 2], [2, 2], [1, 3, 2, 2], [1, 3, 3, 2, 2], [1]]
	var rgb := PackedFloat32Array()
	rgb.resize(36)
	for n in rgb.size():
		@warning_ignore("integer_division")
		rgb[n] = 4 * VALUE * colour[n / 4 % 3]
	for n in bad_values:
		rgb[n] = [NAN, -1.0, INF][n % 3]
	var ones := PackedFloat32Array([1, 1, 1, 1])
	var data: Array[PackedByteArray] = [
		PackedFloat32Array([0, PI / 4, PI / 2]).to_byte_array(),
		PackedFloat32Array([0]).to_byte_array(),
		ones.to_byte_array(),
		ones.to_byte_array(),
		(ones + ones + ones).to_byte_array(),
		rgb.to_byte_array(),
		PackedByteArray([1]),
	]
	var offset := 18
	for n in names.size():
		offset += 2 + (names[n] as String).length() + 11 + 8 * (shapes[n] as Array).size()
	var file := FileAccess.open(PATH, FileAccess.WRITE)
	file.store_buffer("tensor_file".to_ascii_buffer() + PackedByteArray([0, 1, 0]))
	file.store_32(names.size())
	for n in names.size():
		file.store_16((names[n] as String).length())
		file.store_buffer((names[n] as String).to_ascii_buffer())
		file.store_16((shapes[n] as Array).size())
		file.store_8(1 if names[n] == "jacobian" else 10)
		file.store_64(offset)
		for extent: int in shapes[n]:
			file.store_64(extent)
		offset += data[n].size()
	for bytes in data:
		file.store_buffer(bytes)
	file.close()


func test_a_file_becomes_a_table_of_its_own_widths() -> void:
	_write_file(0)
	var table := LobeBaker.new().bake({"brdf": PATH, "lobes": 2, "views": [3, 1]})
	assert_str(table.get("error", "")).is_empty()
	assert_str(table.brdf).is_equal("measured_brdf_test.bsdf")
	assert_int(table.clamped).is_equal(0)
	assert_float(table.asymmetry).is_equal_approx(0.0, 1e-6)
	assert_float(table.alpha.x).is_greater(0.1)
	assert_float(table.alpha.y).is_equal(table.alpha.x)
	# The integral of the file's value over the hemisphere.
	var sum := 0.0
	for lobe in 2:
		sum += (table.data as PackedByteArray).decode_half(lobe * 3 * 8 + 6)
	assert_float(sum).is_equal_approx(TAU * VALUE, 0.01 * TAU * VALUE)


func test_the_default_views_are_those_of_an_isotropic_material() -> void:
	_write_file(0)
	var table := LobeBaker.new().bake({"brdf": PATH, "lobes": 1, "alpha": 0.5})
	assert_that(table.views).is_equal(Vector2i(16, 1))
	assert_that(table.alpha).is_equal(Vector2(0.5, 0.5))


func test_bad_numbers_are_counted() -> void:
	_write_file(5)
	var table := LobeBaker.new().bake({"brdf": PATH, "lobes": 1, "views": [2, 1]})
	assert_str(table.get("error", "")).is_empty()
	assert_int(table.clamped).is_equal(5)


func test_coloured_tables_do_not_depend_on_the_threads() -> void:
	_write_file(0, Color(0.9, 0.5, 0.1))
	for way: Dictionary in [{}, {"refine": true}]:
		var recipe := {"brdf": PATH, "lobes": 2, "views": [3, 1]}.merged(way, true)
		var one := LobeBaker.new().bake(recipe.merged({"threads": 1}))
		assert_str(one.get("error", "")).is_empty()
		var many := LobeBaker.new().bake(recipe.merged({"threads": 8}))
		assert_bool(many.data == one.data).is_true()
		var table := LobeTable.from_baked(one)
		assert_str(table.get_problem()).is_empty()
		# Two rows of texels for each lobe: the table is coloured.
		assert_int(one.height).is_equal(2 * one.lobes)
		var view := table.get_view(1, 0)
		assert_float(table.directional_albedo(view)).is_equal_approx(TAU * VALUE * 0.5, 5e-3)


func test_files_are_refused_by_name_and_reason() -> void:
	var refused := {"brdf": "user://no_such_file.bsdf", "lobes": 1}
	var sentence: String = LobeBaker.new().bake(refused).error
	assert_str(sentence).contains("no_such_file.bsdf: no such file")
	var file := FileAccess.open(PATH, FileAccess.WRITE)
	file.store_string("This is text, not a tensor file.")
	file.close()
	sentence = LobeBaker.new().bake({"brdf": PATH, "lobes": 1}).error
	assert_str(sentence).contains("measured_brdf_test.bsdf: is not a tensor file")
	_write_file(0)
	sentence = LobeBaker.new().bake({"brdf": PATH, "alpha": Vector2(0.1, 0.2)}).error
	assert_str(sentence).contains("alpha is (0.1, 0.2), but the measurements are isotropic")
