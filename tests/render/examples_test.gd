extends GdUnitTestSuite
## The examples in demo/examples: each is drawn without an error, and shows what it is for.

const FOLDER := "res://demo/examples"
const SIDE := 64
# Until captures and maps are there.
const FRAMES := 8

var _view: LinearViewport


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	_view.transparent_bg = false
	add_child(_view)


func after_test() -> void:
	_view.free()
	# Lights linger for a moment, for the next scene.
	for frame in 3:
		await get_tree().process_frame


func test_no_example_is_left_out() -> void:
	# Examples with shaders of their own have a suite of theirs.
	var suites := ""
	for file in DirAccess.get_files_at("res://tests/render"):
		if file.ends_with("examples_test.gd"):
			suites += FileAccess.get_file_as_string("res://tests/render".path_join(file))
	for example in DirAccess.get_directories_at(FOLDER):
		var message := "No test opens demo/examples/%s." % example
		assert_str(suites).override_failure_message(message).contains(example)


func test_bolts() -> void:
	var example := await _open("bolts")
	var instances: MultiMeshInstance3D = example.get_node("Bolts")
	assert_int(instances.multimesh.instance_count).is_equal(1000)
	var brushed := await _draw_example()
	# Round highlights are other ones.
	var material: LobeMaterial3D = example.get("material")
	material.anisotropy = 0.0
	assert_float(_difference(await _draw_example(), brushed)).is_greater(0.002)
	# Without light there is nothing but the background.
	(example.get_node("LobeEnvironment3D") as LobeEnvironment3D).energy = 0.0
	assert_float(_mean(await _draw_example())).is_less(0.8 * _mean(brushed))


func test_visual_shader() -> void:
	var example := await _open("visual_shader")
	var lit := await _draw_example()
	# Without light there is nothing but the background.
	(example.get_node("LobeEnvironment3D") as LobeEnvironment3D).energy = 0.0
	assert_float(_mean(await _draw_example())).is_less(0.8 * _mean(lit))


func test_cloth() -> void:
	await _open("cloth")
	var picture := await _draw_example()
	@warning_ignore("integer_division")
	var half := SIDE / 2
	var with_sheen := _mean(picture.get_region(Rect2i(0, 0, half, SIDE)))
	var without := _mean(picture.get_region(Rect2i(half, 0, half, SIDE)))
	assert_float(with_sheen).is_greater(1.1 * without)


func test_day_night() -> void:
	var example := await _open("day_night")
	# Of the ball alone: the middle of its half.
	var ball := Rect2i(14, 26, 10, 12)
	var light: Dictionary[int, float] = {}
	for hour: int in [12, 0]:
		example.call(&"stop_at", hour)
		await _settle()
		var picture := await _draw_example()
		light[hour] = _mean(picture.get_region(ball))
	assert_float(light[0]).is_greater(0.0005)
	assert_float(light[12]).is_greater(5.0 * light[0])


func test_rooms() -> void:
	var example := await _open("rooms")
	await example.call(&"rebuild")
	await _settle()
	var redness: Dictionary[int, float] = {}
	for place: int in [-1, 1]:
		example.call(&"put_ball", place)
		var ball: Node3D = example.get_node("Ball")
		var camera := _view.get_camera_3d()
		var middle := Vector2i(camera.unproject_position(ball.global_position))
		var seen := await _draw_example()
		var region := seen.get_region(Rect2i(middle - Vector2i(2, 2), Vector2i(5, 5)))
		redness[place] = _mean(region, 0) / _mean(region, 2)
	# The walls' colours are what the ball reflects.
	assert_float(redness[-1]).is_greater(1.5 * redness[1])


# To be awaited: the example with its first light.
func _open(example_name: String) -> Node:
	var path := "%s/%s/%s.tscn" % [FOLDER, example_name, example_name]
	var scene: PackedScene = load(path)
	var example := scene.instantiate()
	# Nothing is to move by itself.
	for speed: StringName in [&"hours_a_second", &"period"]:
		if speed in example:
			example.set(speed, 0.0)
	_view.add_child(example)
	await _settle()
	return example


func _settle() -> void:
	for frame in FRAMES:
		await get_tree().process_frame


# To be awaited: the picture, which shows something and is finite.
func _draw_example() -> Image:
	await get_tree().process_frame
	var picture := await _view.capture()
	var least := INF
	var most := 0.0
	for value: float in picture.get_data().to_float32_array():
		assert_bool(is_finite(value)).is_true()
		least = minf(least, value)
		most = maxf(most, value)
	assert_float(most - least).is_greater(0.01)
	return picture


# Of one channel, or of all three.
func _mean(picture: Image, channel := -1) -> float:
	var sum := 0.0
	for y in picture.get_height():
		for x in picture.get_width():
			var colour := picture.get_pixel(x, y)
			sum += (colour.r + colour.g + colour.b) / 3.0 if channel < 0 else colour[channel]
	return sum / (picture.get_width() * picture.get_height())


func _difference(one: Image, other: Image) -> float:
	var sum := 0.0
	for y in SIDE:
		for x in SIDE:
			var colour := one.get_pixel(x, y) - other.get_pixel(x, y)
			sum += (absf(colour.r) + absf(colour.g) + absf(colour.b)) / 3.0
	return sum / (SIDE * SIDE)
