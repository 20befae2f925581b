extends GdUnitTestSuite
## `./dev compare --room`: a sphere in a room by the addon's own probe and by its rivals, against
## the integrator and against what the same light gives from far away.

const ComparatorKit := preload("support/comparator_kit.gd")

const TEXELS := 64
const SIZE := 32
const BRDF := "ggx"

var _folder := ""


func before() -> void:
	_folder = ProjectSettings.globalize_path(create_temp_dir("comparison_room"))


func after() -> void:
	clean_temp_dir()


func test_a_lamp_is_where_the_sphere_sees_it() -> void:
	var room := _save_room("near", Vector3(6, 3, 8), Vector3(1.2, -0.4, 1.0), 0.4, _lamps_of_walls)
	var pictures := await _draw(room, ["gmm8", "gmm8_flat", "fis16"], [0.2, 0.2])
	var psnr: Dictionary[String, float] = {}
	for title: String in pictures:
		psnr[title] = _psnr(pictures[title], pictures["reference"])
	# 27.95 in this room, whose lamp is nearer than what walls of pictures show.
	assert_float(psnr["gmm8"]).is_greater(27.0)
	assert_float(psnr["fis16"]).is_greater(22.0)
	# Without parallax, lamps are in other places.
	assert_float(psnr["gmm8_flat"]).is_less(psnr["gmm8"] - 10.0)


func test_far_walls_are_an_environment() -> void:
	var room := _save_room("far", Vector3(2000, 2000, 2000), Vector3.ZERO, 1.0, _smooth)
	var near := await _draw(room, ["gmm8"], [0.2, 0.2])
	var panorama := _folder.path_join("smooth.exr")
	assert_str(_save_panorama(panorama)).is_empty()
	var comparison := _make(["gmm8"], [0.2, 0.2])
	comparison.environment_path = panorama
	comparison.stage.panorama = Comparison.load_panorama(panorama)["texture"]
	var under := await _pictures_of(comparison)
	for title: String in ["gmm8", "reference"]:
		assert_float(_largest_step(near[title], under[title], under["reference"])).is_less(1.0)


func test_stock_shows_the_room_from_where_the_sphere_is() -> void:
	# Its BRDF, its range and its filter are its own; but bright walls are where they are.
	var room := _save_room("stock", Vector3(6, 3, 8), Vector3(1.2, -0.4, 1.0), 0.4, _halves)
	var pictures := await _draw(room, ["stock"], [0.1, 0.1])
	var shown: PackedFloat32Array = pictures["stock"]
	var expected: PackedFloat32Array = pictures["reference"]
	var agreed := 0
	var seen := 0
	for y in SIZE:
		for x in SIZE:
			var i := 3 * (y * SIZE + x)
			if expected[i] > 0.7 or (expected[i] > 0.0 and expected[i] < 0.25):
				seen += 1
				agreed += 1 if (shown[i] > 0.4) == (expected[i] > 0.4) else 0
	assert_int(seen).is_greater(300)
	assert_float(float(agreed) / seen).is_greater(0.93)


func _draw(room: String, methods: PackedStringArray, alpha: PackedFloat64Array) -> Dictionary:
	var comparison := _make(methods, alpha)
	comparison.environment_path = room
	comparison.stage.room = CompareRoom.read(room)
	assert_str(comparison.stage.room.get_error()).is_empty()
	return await _pictures_of(comparison)


func _make(methods: PackedStringArray, alpha: PackedFloat64Array) -> Comparison:
	var comparison := Comparison.new()
	comparison.brdf = BRDF
	comparison.alpha = alpha
	comparison.names = methods
	comparison.size = SIZE
	comparison.samples = 2048
	comparison.timing_rounds = 0
	comparison.stage = ComparisonStage.new(get_tree())
	return comparison


func _pictures_of(comparison: Comparison) -> Dictionary:
	comparison.out = _folder.path_join("pictures")
	assert_str(await comparison.run()).is_empty()
	var pictures := {}
	for title: String in comparison.names + PackedStringArray(["reference"]):
		var file := comparison.out.path_join(title + ".exr")
		pictures[title] = NativeLibrary.load_panorama(file)["pixels"]
	return pictures


# As tools/compare/metrics.py has it, of all pixels of the sphere.
func _psnr(picture: PackedFloat32Array, reference: PackedFloat32Array) -> float:
	var exposure := _exposure(reference)
	var sum := 0.0
	var count := 0
	for i in picture.size():
		if reference[i] > 0.0:
			sum += pow(_encode(picture[i], exposure) - _encode(reference[i], exposure), 2.0)
			count += 1
	return -10.0 * log(sum / count) / log(10.0)


# Of 255.
func _largest_step(
	picture: PackedFloat32Array, other: PackedFloat32Array, reference: PackedFloat32Array
) -> float:
	var exposure := _exposure(reference)
	var largest := 0.0
	for i in picture.size():
		var step := absf(_encode(picture[i], exposure) - _encode(other[i], exposure))
		largest = maxf(largest, 255.0 * step)
	return largest


func _exposure(reference: PackedFloat32Array) -> float:
	var lit := PackedFloat32Array()
	for value in reference:
		if value > 0.0:
			lit.append(value)
	return 0.18 / LinearViewport.median(lit)


func _encode(value: float, exposure: float) -> float:
	return pow(clampf(exposure * value, 0.0, 1.0), 1.0 / 2.2)


# A room whose walls have the colour of their points.
func _save_room(
	title: String, size: Vector3, centre: Vector3, radius: float, colour: Callable
) -> String:
	var names := {}
	for wall in 6:
		var pixels := PackedFloat32Array()
		for y in TEXELS:
			for x in TEXELS:
				var st := Vector2(2 * x + 1, 2 * y + 1) / TEXELS - Vector2.ONE
				var d := CompareRoom.NeutralLight.face_direction(wall, st)
				var value: Color = colour.call(0.5 * size * d)
				pixels.append_array([value.r, value.g, value.b])
		var file := "%s_%d.exr" % [title, wall]
		NativeLibrary.save_exr(_folder.path_join(file), TEXELS, TEXELS, pixels)
		names[CompareRoom.WALLS[wall]] = file
	var room := {
		"size": [size.x, size.y, size.z],
		"walls": names,
		"probe": [0, 0, 0],
		"sphere": {"centre": [centre.x, centre.y, centre.z], "radius": radius},
	}
	var path := _folder.path_join(title + ".json")
	FileAccess.open(path, FileAccess.WRITE).store_string(JSON.stringify(room))
	return path


func _save_panorama(path: String) -> String:
	var height := 256
	var pixels := PackedFloat32Array()
	for y in height:
		for x in 2 * height:
			var u := (x + 0.5) / (2 * height)
			var d := ComparatorKit.Kit.panorama_direction(u, (y + 0.5) / height)
			var value := _smooth(d)
			pixels.append_array([value.r, value.g, value.b])
	return NativeLibrary.save_exr(path, 2 * height, height, pixels)


static func _lamps_of_walls(q: Vector3) -> Color:
	var lamp := 12.0 * exp(-2.0 * q.distance_squared_to(Vector3(0.5, 1.5, 1.0)))
	lamp += 8.0 * exp(-1.5 * q.distance_squared_to(Vector3(3.0, 0.2, 2.0)))
	return Color(0.3 + lamp, 0.25 + 0.05 * q.x + lamp, 0.35 - 0.05 * q.y + 0.5 * lamp)


# The same in all places of a direction.
static func _smooth(q: Vector3) -> Color:
	var d := q.normalized()
	return Color(1.0 + 0.6 * d.x, 1.0 + 0.5 * d.y * d.z, 1.0 - 0.4 * d.z)


static func _halves(q: Vector3) -> Color:
	return Color.WHITE if q.x > 1.5 else Color.BLACK
