extends GdUnitTestSuite
## What Bake Light makes of an environment is what the environment shows live.

const EnvironmentBake := preload("res://addons/lobelight/editor/light/environment_bake.gd")
const Kit := preload("support/render_kit.gd")
const SkyKit := preload("support/sky_kit.gd")

const PATH := "user://environment_bake_test.res"
const SIDE := 32
const TEXELS := 32
const TURN := Vector3(0.3, 1.1, 0.0)
# Half floats, and a frame buffer of them.
const NEAR := 1.0 / 255.0
const _FRAMES := 24
const SKIES := [["panorama"], ["procedural"], ["shader"], ["colour"]]

var _view: LinearViewport
var _environment: LobeEnvironment3D


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_view.add_child(SkyKit.make_mirror())
	_environment = LobeEnvironment3D.new()
	_environment.size = TEXELS
	_environment.energy = 0.5
	_environment.rotation = TURN


func after_test() -> void:
	_view.free()
	if FileAccess.file_exists(PATH):
		DirAccess.remove_absolute(PATH)
	for frame in 4:
		await RenderingServer.frame_post_draw


# Shows it live, bakes it, saves it, and shows it loaded again: the pictures' largest difference.
func _compare() -> float:
	_view.add_child(_environment)
	assert_bool(await _environment.rebuild()).is_true()
	# Until live light has its sources taken out.
	for frame in _FRAMES:
		await RenderingServer.frame_post_draw
	var live := await _view.capture()
	assert_float(_largest_difference(live, _black())).is_greater(0.05)
	var made: Variant = await EnvironmentBake.new().make(_environment)
	assert_bool(made is LobeLight).append_failure_message(str(made)).is_true()
	if made is not LobeLight:
		return INF
	assert_str((made as LobeLight).get_problem()).is_empty()
	# The node is as it was.
	assert_array(Array((await _view.capture()).get_data())).is_equal(Array(live.get_data()))
	assert_int(ResourceSaver.save(made as LobeLight, PATH)).is_equal(OK)
	_environment.light = ResourceLoader.load(PATH, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP)
	var difference := _largest_difference(await _view.capture(), live)
	# It can be baked again, from the same source.
	var again: Variant = await EnvironmentBake.new().make(_environment)
	for face in 6:
		var data := (again as LobeLight).faces[face].get_data()
		assert_bool(data == (made as LobeLight).faces[face].get_data()).is_true()
	return difference


func test_skies(kind: String, _test_parameters := SKIES) -> void:
	var surroundings := _view.camera.environment
	SkyKit.set_sky(surroundings, kind)
	surroundings.sky_rotation = Vector3(0.2, 0.7, 0.0)
	surroundings.background_energy_multiplier = 0.75
	_view.add_child(SkyKit.make_sun())
	_environment.source = LobeEnvironment3D.Source.SKY
	assert_float(await _compare()).is_less(NEAR)
	assert_bool(_environment.light.is_of_world).is_true()
	# Nor does turning the node turn a sky that was baked.
	var before := await _view.capture()
	_environment.rotation = Vector3.ZERO
	assert_float(_largest_difference(await _view.capture(), before)).is_less(NEAR)


# By the GPU, as the library knows round filters only.
func test_a_sun_is_taken_out() -> void:
	var sun := Vector3(0.5, 0.4, -0.7).normalized()
	_environment.panorama = Kit.make_panorama(
		128,
		func(d: Vector3) -> Color:
			return Color.WHITE * (1e4 if d.normalized().dot(sun) > cos(0.02) else 0.5)
	)
	_environment.filter = LobeEnvironment3D.Filter.BINOMIAL
	assert_float(await _compare()).is_less(NEAR)
	assert_int(_environment.light.count_sources()).is_equal(1)


func test_panoramas() -> void:
	_environment.panorama = Kit.make_panorama(16, SkyKit.radiance)
	for filter: LobeEnvironment3D.Filter in [
		LobeEnvironment3D.Filter.DISC, LobeEnvironment3D.Filter.BINOMIAL
	]:
		_environment.light = null
		_environment.filter = filter
		if _environment.get_parent() != null:
			_view.remove_child(_environment)
		assert_float(await _compare()).is_less(NEAR)
		assert_bool(_environment.light.is_of_world).is_false()


func test_captures() -> void:
	var wall := MeshInstance3D.new()
	wall.mesh = BoxMesh.new()
	var paint := StandardMaterial3D.new()
	paint.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	paint.albedo_color = Color(1.0, 0.5, 0.25)
	(wall.mesh as BoxMesh).material = paint
	wall.position = Vector3(0.0, 0.0, 6.0)
	wall.scale = Vector3(6.0, 6.0, 1.0)
	wall.layers = 2
	_view.add_child(wall)
	_environment.source = LobeEnvironment3D.Source.CAPTURE
	_environment.capture_cull_mask = 2
	assert_float(await _compare()).is_less(NEAR)


func test_what_cannot_be_baked_is_told_in_a_sentence() -> void:
	_environment.source = LobeEnvironment3D.Source.PANORAMA
	_view.add_child(_environment)
	var made: Variant = await EnvironmentBake.new().make(_environment)
	assert_str(str(made)).is_equal("There is no panorama.")


func _largest_difference(a: Image, b: Image) -> float:
	var first := a.get_data().to_float32_array()
	var second := b.get_data().to_float32_array()
	var largest := 0.0
	for i in first.size():
		largest = maxf(largest, absf(first[i] - second[i]))
	return largest


func _black() -> Image:
	return Image.create_empty(SIDE, SIDE, false, Image.FORMAT_RGBAF)
