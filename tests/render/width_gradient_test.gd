extends GdUnitTestSuite
## Roughness from pixel to pixel over its whole range: the light of a photographed hall against the
## reference integrator, and no band or jump on the way.

const Kit := preload("support/render_kit.gd")
const HALL := "res://demo/environments/hall.exr"
const SIDE := 16
const FINE_SIDE := 160
# A row of pixels on the upper half of the sphere, and the part of it that looks at the viewer.
const ROW := 5
const COLUMNS := [2, 13]
# Roughness along the texture's first half, which runs across the visible side.
const ROUGHNESS := [0.08, 1.0]
# How far a pixel may be from the reference, and the root of the mean square over all of them: eight
# lobes, from tables between a set's widths, in light with a contrast of thousands.
const WORST := 0.15
const MEAN := 0.06

# The largest second difference between neighbouring pixels, as a share of their light: what an eye
# might see.
const MOST_BEND := 3.0 / 255.0
const OF_PHOTOGRAPHS := [[0.0], [0.6]]
const OF_SMOOTH_LIGHT := [[0.0], [0.6], [1.1]]

var _view: LinearViewport
var _material := LobeMaterial3D.new()


func before_test() -> void:
	# A metal that reflects all the light it takes.
	_material.metallic = 1.0
	_material.albedo_color = Color.WHITE
	_material.roughness = 1.0
	_material.texture_filter = BaseMaterial3D.TEXTURE_FILTER_LINEAR
	# The visible side of a sphere mesh has u from -1/4 to 1/4.
	_material.uv1_offset = Vector3(0.25, 0.0, 0.0)


func after_test() -> void:
	_view.free()
	_material.roughness_texture = null


func after() -> void:
	_material = null
	clean_temp_dir()


func test_against_the_reference(anisotropy: float, _test_parameters := OF_PHOTOGRAPHS) -> void:
	var image := await _draw(SIDE, anisotropy, Comparison.load_panorama(_path(HALL))["texture"])
	var white := create_temp_dir("widths").path_join("white.exr")
	var ones := PackedFloat32Array()
	ones.resize(3 * 8 * 4)
	ones.fill(1.0)
	assert_str(NativeLibrary.save_exr(white, 8, 4, ones)).is_empty()
	var worst := 0.0
	var squares := 0.0
	for x in range(COLUMNS[0], COLUMNS[1] + 1):
		var widths := LobeMaterial3D.widths_of(_roughness_at(x, SIDE), anisotropy)
		# What is lost between microfacets is given back, so that a white sphere is white.
		var expected := _reference(_path(HALL), widths, x) / _reference(white, widths, x)
		var off := absf(image.get_pixel(x, ROW).g / expected - 1.0)
		worst = maxf(worst, off)
		squares += off * off
	var mean := sqrt(squares / (COLUMNS[1] - COLUMNS[0] + 1))
	assert_float(worst).is_less(WORST)
	assert_float(mean).is_less(MEAN)


func test_no_band_and_no_jump(anisotropy: float, _test_parameters := OF_SMOOTH_LIGHT) -> void:
	# Light that is linear in the direction, so that all that bends in the picture is the surface's.
	var light := func(direction: Vector3) -> Color:
		var value := 0.5 + 0.3 * direction.x + 0.2 * direction.y
		return Color(value, value, value)
	var image := await _draw(FINE_SIDE, anisotropy, Kit.make_panorama(64, light))
	@warning_ignore("integer_division")
	var row := ROW * FINE_SIDE / SIDE
	var worst := 0.0
	var darkest := INF
	var brightest := 0.0
	for x in range(25, FINE_SIDE - 25):
		var middle := image.get_pixel(x, row).g
		darkest = minf(darkest, middle)
		brightest = maxf(brightest, middle)
		var bend := image.get_pixel(x - 1, row).g - 2.0 * middle + image.get_pixel(x + 1, row).g
		worst = maxf(worst, absf(bend) / middle)
	assert_float(worst).is_less(MOST_BEND)
	# What is black or flat would have no bands either.
	assert_float(darkest).is_greater(0.1)
	assert_float(brightest).is_greater(1.2 * darkest)


# A sphere whose roughness rises from left to right. To be awaited.
func _draw(side: int, anisotropy: float, panorama: Texture2D) -> Image:
	_view = LinearViewport.new(side)
	add_child(_view)
	var environment := LobeEnvironment3D.new()
	environment.panorama = panorama
	_view.add_child(environment)
	await environment.rebuild()
	_material.anisotropy = anisotropy
	_material.anisotropy_enabled = true
	var texture := Image.create_empty(512, 1, false, Image.FORMAT_RGBAF)
	for x in 512:
		var share := minf((x + 0.5) / 256.0, 1.0)
		texture.set_pixel(x, 0, Color(lerpf(ROUGHNESS[0], ROUGHNESS[1], share), 0.0, 0.0))
	_material.roughness_texture = ImageTexture.create_from_image(texture)
	_view.add_child(Kit.make_sphere(_material, 160))
	return await _view.capture()


func _roughness_at(x: int, side: int) -> float:
	var normal := Kit.sphere_normal(x, ROW, side)
	var u := 0.25 + atan2(normal.x, normal.z) / TAU
	return lerpf(ROUGHNESS[0], ROUGHNESS[1], 2.0 * u)


func _reference(path: String, widths: Vector2, x: int) -> float:
	var options := {
		"env": path, "brdf": "ggx", "alpha": [widths.x, widths.y], "size": SIDE, "samples": 384
	}
	var picture: Dictionary = NativeLibrary.create(&"LobeReference").call("render_sphere", options)
	var pixels: PackedFloat32Array = picture["pixels"]
	return pixels[3 * (SIDE * ROW + x) + 1]


func _path(path: String) -> String:
	return ProjectSettings.globalize_path(path)
