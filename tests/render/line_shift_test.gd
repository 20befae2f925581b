extends GdUnitTestSuite
## Lobes without a table that are shifted from frame to frame: nearer to what twice as many draw
## where the antialiasing takes the mean of frames, and nothing else anywhere else.

const Kit := preload("support/render_kit.gd")
const TAA := "rendering/anti_aliasing/quality/use_taa"
const DEFINE := "LINE_SHIFTED"
const SIDE := 64
# TAA's mean reaches back about as far.
const FRAMES := 48
# Until a light is all there.
const FRAMES_BEFORE := 8
# Of the error that lobes have that stay where they are.
const MOST_LEFT := 0.85

var _used_taa := false
var _view: LinearViewport


func before_test() -> void:
	_used_taa = ProjectSettings.get_setting(TAA, false)
	_view = LinearViewport.new(SIDE)
	add_child(_view)


func after_test() -> void:
	ProjectSettings.set_setting(TAA, _used_taa)
	_view.free()


func test_only_where_frames_are_kept() -> void:
	(
		assert_bool(DEFINE in _make(LobeBaseMaterial3D.Quality.LOBES_16, false).get_shader_code())
		. is_false()
	)
	var code := _make(LobeBaseMaterial3D.Quality.LOBES_16, true).get_shader_code()
	assert_bool(DEFINE in code).is_equal(_is_forward_plus())
	ProjectSettings.set_setting(TAA, true)
	var round_widths := LobeMaterial3D.new()
	assert_bool(DEFINE in round_widths.get_shader_code()).is_false()


func test_the_mean_of_frames_is_nearer_to_more_lobes() -> void:
	if not _is_forward_plus():
		_assert_nothing_is_shifted()
		return
	await _light()
	var sphere := Kit.make_sphere(_make(LobeBaseMaterial3D.Quality.LOBES_32, false))
	_view.add_child(sphere)
	var expected := await _drawn(false)
	var errors: Array[float] = []
	for shifted: bool in [false, true]:
		var material := _make(LobeBaseMaterial3D.Quality.LOBES_16, shifted)
		(sphere.mesh as PrimitiveMesh).material = material
		errors.append(_difference(await _drawn(true), expected))
	assert_float(errors[1]).append_failure_message(str(errors)).is_less(MOST_LEFT * errors[0])


func test_nothing_moves_without_the_antialiasing() -> void:
	if not _is_forward_plus():
		_assert_nothing_is_shifted()
		return
	await _light()
	var sphere := Kit.make_sphere(null)
	_view.add_child(sphere)
	var pictures: Array[Image] = []
	for shifted: bool in [false, true]:
		var material := _make(LobeBaseMaterial3D.Quality.LOBES_16, shifted)
		(sphere.mesh as PrimitiveMesh).material = material
		pictures.append(await _drawn(false))
	assert_float(_difference(pictures[0], pictures[1])).is_less(1e-4)
	# A frustum off its axis is not taken for the antialiasing's work.
	_view.camera.set_frustum(1.0, Vector2(0.02, 0.01), 2.0, 10.0)
	pictures.clear()
	for shifted: bool in [false, true]:
		var material := _make(LobeBaseMaterial3D.Quality.LOBES_16, shifted)
		(sphere.mesh as PrimitiveMesh).material = material
		pictures.append(await _drawn(false))
	assert_float(_difference(pictures[0], pictures[1])).is_less(1e-4)


# Where there is no such antialiasing, whatever the settings say.
func _assert_nothing_is_shifted() -> void:
	var code := _make(LobeBaseMaterial3D.Quality.LOBES_16, true).get_shader_code()
	assert_bool(DEFINE in code).is_false()


func _is_forward_plus() -> bool:
	return RenderingServer.get_current_rendering_method() == "forward_plus"


# Of widths 1:18.
func _make(quality: LobeBaseMaterial3D.Quality, shifted: bool) -> LobeMaterial3D:
	ProjectSettings.set_setting(TAA, shifted)
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.25
	material.anisotropy_enabled = true
	material.anisotropy = 1.05
	material.quality = quality
	# The shader is made when it is asked for.
	material.get_shader_code()
	return material


func _light() -> void:
	var environment := LobeEnvironment3D.new()
	_view.add_child(environment)
	var path := ProjectSettings.globalize_path("res://demo/environments/hall.exr")
	environment.panorama = Comparison.load_panorama(path)["texture"]
	await environment.rebuild()


func _drawn(antialiased: bool) -> Image:
	_view.use_taa = antialiased
	_view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	for frame in FRAMES if antialiased else FRAMES_BEFORE:
		await RenderingServer.frame_post_draw
	var image := _view.get_texture().get_image()
	_view.render_target_update_mode = SubViewport.UPDATE_DISABLED
	image.convert(Image.FORMAT_RGBAF)
	return image


# The root of the mean square, as screens show it, off the sphere's edge.
func _difference(a: Image, b: Image) -> float:
	var sum := 0.0
	var count := 0
	for y in SIDE:
		for x in SIDE:
			var p := Vector2(2 * x + 1, 2 * y + 1) / SIDE - Vector2.ONE
			if p.length_squared() > 0.8:
				continue
			for channel in 3:
				var first: float = a.get_pixel(x, y)[channel]
				var second: float = b.get_pixel(x, y)[channel]
				sum += pow(
					pow(clampf(first, 0.0, 1.0), 0.4545) - pow(clampf(second, 0.0, 1.0), 0.4545),
					2.0
				)
				count += 1
	return sqrt(sum / count)
