extends GdUnitTestSuite
## LobeReference: the sphere in known light, and what is refused.

const SIZE := 16
const OPTIONS := {"brdf": "ward", "alpha": 0.3, "size": SIZE, "samples": 64, "threads": 1}

## An option of the wrong kind or out of range, and what the sentence about it says.
const REFUSED := [
	["brdf", "phong", 'brdf is "phong"'],
	["alpha", 0, "alpha is (0, 0)"],
	["size", 0, "size"],
	["size", 100000, "size"],
	["size", "big", 'size is "big" (String)'],
	["samples", 0, "samples"],
	["seed", -3, "seed is -3 (int)"],
	["env", "", "env is missing"],
	["env", 7, "env is 7 (int)"],
	["lobes", 8, '"lobes" is not a key of a sphere to render'],
	["walls", ["x.exr"], "env and walls exclude each other"],
]

## The same of a room.
const REFUSED_ROOMS := [
	["walls", ["x.exr"], "walls must be an Array of six paths"],
	["room_size", [6, 3], "room_size must be an Array of three numbers"],
	["room_size", [6, 0, 8], "room_size must be three positive numbers"],
	["centre", [0, 1.2, 0], "does not lie within the room"],
	["radius", -1, "radius must be a positive number"],
]

var _grey := ""


func before() -> void:
	_grey = create_temp_dir("lobe_reference").path_join("grey.exr")
	var pixels := PackedFloat32Array()
	pixels.resize(8 * 4 * 3)
	pixels.fill(2.0)
	LobeImageFile.save_exr(_grey, 8, 4, pixels)


func after() -> void:
	clean_temp_dir()


func test_constant_light_gives_the_albedo() -> void:
	var picture := LobeReference.new().render_sphere(_options({"samples": 1024}))
	assert_str(picture.get("error", "")).is_empty()
	assert_int(picture.size).is_equal(SIZE)
	assert_int(picture.clamped).is_equal(0)
	assert_int(picture.pixels.size()).is_equal(SIZE * SIZE * 3)
	assert_int(picture.standard_error.size()).is_equal(SIZE * SIZE * 3)
	var inside := 0
	for row in SIZE:
		for column in SIZE:
			var x := (2.0 * column + 1) / SIZE - 1
			var y := 1 - (2.0 * row + 1) / SIZE
			var index := (row * SIZE + column) * 3
			if x * x + y * y >= 1:
				assert_float(picture.pixels[index]).is_equal(0.0)
				continue
			# The view in the surface's frame; the surface is isotropic.
			var z := sqrt(1 - x * x - y * y)
			var view := Vector3(sqrt(1 - z * z), 0, z)
			var albedo := LobeBaker.directional_albedo("ward", Vector2(0.3, 0.3), view)
			# Five standard errors, and the quadrature's own.
			var tolerance: float = 5 * picture.standard_error[index] + 2e-3
			for channel in 3:
				assert_float(picture.pixels[index + channel]).is_equal_approx(2 * albedo, tolerance)
			inside += 1
	# π/4 of the square.
	assert_int(inside).is_between(190, 212)


func test_a_room_of_constant_walls_is_as_a_constant_panorama() -> void:
	var room := OPTIONS.merged(
		{"walls": [_grey, _grey, _grey, _grey, _grey, _grey], "room_size": [6, 3, 8]}
	)
	room.merge({"centre": [2.2, -0.9, 2.6], "radius": 0.4})
	var picture := LobeReference.new().render_sphere(room)
	assert_str(picture.get("error", "")).is_empty()
	var expected := LobeReference.new().render_sphere(_options({}))
	for index: int in picture.pixels.size():
		assert_float(picture.pixels[index]).is_equal_approx(expected.pixels[index], 1e-5)


func test_rooms_that_cannot_be_meant_are_refused(
	key: String, value: Variant, said: String, _test_parameters := REFUSED_ROOMS
) -> void:
	var room := OPTIONS.merged(
		{"walls": [_grey, _grey, _grey, _grey, _grey, _grey], "room_size": [6, 3, 8]}
	)
	room.merge({"centre": [0, 0, 0], "radius": 0.4})
	room[key] = value
	assert_str(LobeReference.new().render_sphere(room).get("error", "")).contains(said)


func test_threads_do_not_change_the_picture() -> void:
	var env := {"env": "res://tests/data/forest.exr"}
	var one := LobeReference.new().render_sphere(_options(env.merged({"threads": 1})))
	var two := LobeReference.new().render_sphere(_options(env.merged({"threads": 2})))
	assert_str(one.get("error", "")).is_empty()
	assert_bool(one.pixels == two.pixels).is_true()
	assert_bool(one.standard_error == two.standard_error).is_true()


func test_seeds_differ() -> void:
	var env := {"env": "res://tests/data/forest.exr"}
	var one := LobeReference.new().render_sphere(_options(env.merged({"seed": 1})))
	var two := LobeReference.new().render_sphere(_options(env.merged({"seed": 2})))
	assert_bool(one.pixels == two.pixels).is_false()


func test_background_work_gives_the_same_picture() -> void:
	var reference := LobeReference.new()
	assert_bool(reference.start(_options({}))).is_true()
	var result: Dictionary = await reference.finished
	var expected := LobeReference.new().render_sphere(_options({}))
	assert_bool(result.pixels == expected.pixels).is_true()


func test_cancel() -> void:
	var reference := LobeReference.new()
	assert_bool(reference.start(_options({"size": 2048, "samples": 1 << 20}))).is_true()
	await await_millis(20)
	reference.cancel()
	await reference.cancelled
	assert_bool(reference.is_running()).is_false()
	assert_dict(reference.get_result()).is_empty()


func test_missing_environment_is_refused_at_once() -> void:
	var reference := LobeReference.new()
	assert_bool(reference.start()).is_false()
	assert_str(reference.get_error()).is_equal("env is missing.")


func test_bad_option_is_refused_by_name(
	key: String, value: Variant, named: String, _test_parameters := REFUSED
) -> void:
	var options := _options({})
	options[key] = value
	var result := LobeReference.new().render_sphere(options)
	assert_array(result.keys()).contains_exactly("error")
	assert_str(result.get("error", "")).contains(named)
	assert_str(result.get("error", "")).ends_with(".")


func _options(changes: Dictionary) -> Dictionary:
	return {"env": _grey}.merged(OPTIONS).merged(changes, true)
