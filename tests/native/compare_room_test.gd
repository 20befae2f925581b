extends GdUnitTestSuite
## CompareRoom: how ROOM.json is read, what is refused, and where the walls' pictures lie.

## What is put into a good file, by key ("sphere.radius" lies in an object), and a part of what is
## said. A null takes the key out.
const FAULTS := [
	["size", null, "size is missing"],
	["size", [6, 3], "size must be three finite numbers"],
	["size", [6, 0, 8], "size is [6.0, 0.0, 8.0], but must be above 0"],
	["size", [6, -3, 8], "but must be above 0"],
	["size", [6, 3, 1e30], "and at most 10000"],
	["size", "large", "size must be three finite numbers"],
	["walls", null, "walls is missing"],
	["walls", [], "walls must be an object with the keys +x, -x, +y, -y, +z, -z"],
	["walls.+y", null, "walls.+y is missing"],
	["walls.+y", 7, "walls.+y must be the path of a picture"],
	["walls.+y", "nowhere.exr", "nowhere.exr: there is no such file"],
	["walls.+y", "text.exr", "text.exr: is neither an OpenEXR nor a Radiance"],
	["walls.up", "grey.exr", "walls.up is not known"],
	["probe", null, "probe is missing"],
	["probe", [0, 1.5, 0], "probe is [0.0, 1.5, 0.0], which is not inside the box"],
	["probe", [0, null, 0], "probe must be three finite numbers"],
	["sphere", 3, "sphere must be an object with the keys centre, radius"],
	["sphere.centre", [9, 0, 0], "sphere.centre is [9.0, 0.0, 0.0], which is not inside the box"],
	["sphere.centre", [2.7, 0, 0], "the sphere reaches through a wall"],
	["sphere.radius", 0, "sphere.radius is 0.0, but must be above 0"],
	["sphere.radius", -0.4, "but must be above 0"],
	["sphere.radius", "wide", "sphere.radius must be a finite number"],
	["sphere.colour", "red", "sphere.colour is not known"],
	["colour", "red", "colour is not known"],
]
## As text, for what JSON.stringify() would not write.
const TEXTS := [
	["", "is not JSON"],
	["{", "is not JSON"],
	["[1, 2]", "the file must be an object with the keys size, walls, probe, sphere"],
	['{"size": [null, 3, 8], "walls": {}, "probe": [], "sphere": {}}', "three finite numbers"],
	['{"size": [NaN, 3, 8]}', "is not JSON"],
]

var _folder := ""


func before() -> void:
	_folder = ProjectSettings.globalize_path(create_temp_dir("compare_room"))
	var pixels := PackedFloat32Array()
	pixels.resize(4 * 2 * 3)
	pixels.fill(0.5)
	NativeLibrary.save_exr(_folder.path_join("grey.exr"), 4, 2, pixels)
	_write("text.exr", "This is text, not a picture.")


func after() -> void:
	clean_temp_dir()


func test_a_good_file_is_read() -> void:
	var room := CompareRoom.read(_write("room.json", JSON.stringify(_good())))
	assert_str(room.get_error()).is_empty()
	assert_vector(room.size).is_equal(Vector3(6, 3, 8))
	assert_vector(room.centre).is_equal(Vector3(0.5, -0.25, 0.25))
	assert_vector(room.probe).is_equal(Vector3(1, 0, 0))
	assert_float(room.radius).is_equal(0.5)
	# Relative to the file, not to where the command was called; no word of their proportions.
	assert_array(room.walls).contains([_folder.path_join("grey.exr")])
	assert_int(room.walls.size()).is_equal(6)
	assert_array(room.remarks).is_empty()


func test_walls_that_are_wider_than_high_are_no_panoramas() -> void:
	var pixels := PackedFloat32Array()
	pixels.resize(3 * 3 * 3)
	NativeLibrary.save_exr(_folder.path_join("square.exr"), 3, 3, pixels)
	var room := CompareRoom.read(_write_with("walls.-x", "square.exr"))
	assert_str(room.get_error()).is_empty()
	assert_array(room.remarks).is_empty()


func test_faults_are_named(
	key: String, value: Variant, said: String, _test_parameters := FAULTS
) -> void:
	_assert_refused(_write_with(key, value), said)


func test_what_is_no_room_is_refused(text: String, said: String, _test_parameters := TEXTS) -> void:
	_assert_refused(_write("text.json", text), said)


func test_a_file_that_is_not_there() -> void:
	_assert_refused(_folder.path_join("none.json"), "there is no such file")


func test_pictures_lie_on_the_walls_as_the_contract_says() -> void:
	var room := CompareRoom.read(_write("room.json", JSON.stringify(_good())))
	# s and t of a point d of the unit cube, by the contract's table.
	var expected: Array[Callable] = [
		func(d: Vector3) -> Vector2: return Vector2(-d.z, -d.y),
		func(d: Vector3) -> Vector2: return Vector2(d.z, -d.y),
		func(d: Vector3) -> Vector2: return Vector2(d.x, d.z),
		func(d: Vector3) -> Vector2: return Vector2(d.x, -d.z),
		func(d: Vector3) -> Vector2: return Vector2(d.x, -d.y),
		func(d: Vector3) -> Vector2: return Vector2(-d.x, -d.y),
	]
	for wall in 6:
		for uv: Vector2 in [Vector2(0.1, 0.3), Vector2(0.9, 0.6)]:
			var d := room.get_point(wall, uv) / (0.5 * room.size)
			@warning_ignore("integer_division")
			assert_float(d[wall / 2]).is_equal_approx(1.0 if wall % 2 == 0 else -1.0, 1e-6)
			var st: Vector2 = expected[wall].call(d)
			assert_vector(0.5 * (st + Vector2.ONE)).is_equal_approx(uv, 1e-6 * Vector2.ONE)


func _assert_refused(path: String, said: String) -> void:
	var error := CompareRoom.read(path).get_error()
	assert_str(error).starts_with(path + ": ")
	assert_str(error).contains(said)
	assert_str(error).ends_with(".")
	assert_int(error.count("\n")).is_equal(0)


func _good() -> Dictionary:
	var walls := {}
	for wall in CompareRoom.WALLS:
		walls[wall] = "grey.exr"
	return {
		"size": [6, 3, 8],
		"walls": walls,
		"probe": [1, 0, 0],
		"sphere": {"centre": [0.5, -0.25, 0.25], "radius": 0.5},
	}


func _write_with(key: String, value: Variant) -> String:
	var room := _good()
	var target := room
	var parts := key.split(".")
	if parts.size() == 2:
		target = room[parts[0]]
	if value == null:
		target.erase(parts[-1])
	else:
		target[parts[-1]] = value
	return _write("room.json", JSON.stringify(room))


func _write(title: String, text: String) -> String:
	var path := _folder.path_join(title)
	FileAccess.open(path, FileAccess.WRITE).store_string(text)
	return path
