extends GdUnitTestSuite
## Neighbouring pixels of a slowly turning surface: lobes glide from view to view, nothing jumps.

const Kit := preload("support/render_kit.gd")
const TurningSurface := preload("support/turning_surface.gd")
const SIDE := 128
const MATERIALS := [
	["ward", [0.1, 0.1], 8],
	["ward", [0.05, 0.2], 8],
	["ggx", [0.1, 0.3], 8],
	["ward", [0.02, 0.2], 16],
]
## Between display values of neighbours, 1 being white.
const LARGEST_STEP := 2.0 / 255.0
## Of a step beyond the mean of the steps before and after it. The light itself changes by more than
## LARGEST_STEP over two pixels where narrow lobes meet the edge of a window, but never abruptly:
## pixels are a 23rd of a degree apart, and no lobe here is narrower than one degree.
const LARGEST_JUMP := 1.0 / 255.0


func test_nothing_jumps(
	brdf: String, alpha: Array, lobes: int, _test_parameters := MATERIALS
) -> void:
	var recipe := {"brdf": brdf, "alpha": alpha, "lobes": lobes}
	var baked: Dictionary = NativeLibrary.create(&"LobeBaker").call(&"bake", recipe)
	var values := await _display_values(LobeTable.from_baked(baked))
	var steps := _steps(values)
	assert_float(_largest_jump(steps)).is_less(LARGEST_JUMP)
	var narrowest: float = alpha.min()
	if narrowest >= 0.05:
		assert_float(_largest_step(steps)).is_less(LARGEST_STEP)
	# It is a picture of something.
	assert_float(_spread(values)).is_greater(0.1)


func test_views_apart_do_jump() -> void:
	# Lobes that have nothing to do with those of the next view, as independent fits looked up at the
	# nearest view have it: the test can fail.
	var random := RandomNumberGenerator.new()
	random.seed = 2
	var table := Kit.make_odd_table(8, Vector2i(256, 1), Vector2(0.2, 0.2))
	for x in 256:
		for y in 8:
			var texel := table.image.get_pixel(x, y)
			texel.r = random.randf_range(-1.5, 1.5)
			table.image.set_pixel(x, y, texel)
	var steps := _steps(await _display_values(table))
	assert_float(_largest_step(steps)).is_greater(LARGEST_STEP)
	assert_float(_largest_jump(steps)).is_greater(LARGEST_JUMP)


func _display_values(table: LobeTable) -> PackedFloat32Array:
	var path := ProjectSettings.globalize_path("res://demo/environments/hall.exr")
	var map := NativeLibrary.load_panorama(path)
	var pixels: PackedFloat32Array = map["pixels"]
	var size := Vector2i(map["width"], map["height"])
	var image := Image.create_from_data(
		size.x, size.y, false, Image.FORMAT_RGBF, pixels.to_byte_array()
	)
	var environment: LobeEnvironment3D = auto_free(LobeEnvironment3D.new())
	environment.panorama = ImageTexture.create_from_image(image)
	get_tree().root.add_child(environment)
	await environment.rebuild()

	var material := TurningSurface.new()
	material.table = table
	var viewport: LinearViewport = auto_free(LinearViewport.new(SIDE))
	get_tree().root.add_child(viewport)
	viewport.add_child(SphereImpostor.make_quad(material))
	await viewport.capture()
	var picture := await viewport.capture()
	return _encode(picture.get_data().to_float32_array())


# RGB of the normals, exposed so that the median luminance shows as 0.18, with gamma 2.2.
func _encode(data: PackedFloat32Array) -> PackedFloat32Array:
	var means := PackedFloat32Array()
	for n in TurningSurface.NORMALS:
		means.append((data[4 * n] + data[4 * n + 1] + data[4 * n + 2]) / 3.0)
	var exposure := 0.18 / LinearViewport.median(means)
	var values := PackedFloat32Array()
	for n in TurningSurface.NORMALS:
		for channel in 3:
			values.append(pow(clampf(exposure * data[4 * n + channel], 0.0, 1.0), 1.0 / 2.2))
	return values


# From each normal to the next, three channels each; 0 between the two halves of the path, which do
# not meet.
func _steps(values: PackedFloat32Array) -> PackedFloat32Array:
	var steps := PackedFloat32Array()
	@warning_ignore("integer_division")
	var middle := TurningSurface.NORMALS / 2
	for n in range(1, TurningSurface.NORMALS):
		for channel in 3:
			var step := values[3 * n + channel] - values[3 * n - 3 + channel]
			steps.append(step if n != middle else 0.0)
	return steps


func _largest_step(steps: PackedFloat32Array) -> float:
	var largest := 0.0
	for step in steps:
		largest = maxf(largest, absf(step))
	return largest


func _largest_jump(steps: PackedFloat32Array) -> float:
	var largest := 0.0
	@warning_ignore("integer_division")
	var middle := 3 * (TurningSurface.NORMALS / 2)
	for n in range(3, steps.size() - 3):
		if absi(n - middle) > 12:
			largest = maxf(largest, absf(steps[n] - 0.5 * (steps[n - 3] + steps[n + 3])))
	return largest


func _spread(values: PackedFloat32Array) -> float:
	var least := 1.0
	var most := 0.0
	for value in values:
		least = minf(least, value)
		most = maxf(most, value)
	return most - least
