extends GdUnitTestSuite
## Panoramas are exported as fine as cube maps show them, if nothing else shows them.

const Diet := preload("res://addons/lobelight/editor/export/diet.gd")
const PanoramaFit := preload("res://addons/lobelight/editor/export/panorama_fit.gd")
const ProjectFiles := preload("res://addons/lobelight/editor/export/project_files.gd")

const SCENE := "res://tests/diet/scenes/panorama.tscn"
const SUNSET := "res://demo/environments/sunset.exr"

## Texels in a row of an image and in those that are wanted, and how many are left.
const WIDTHS := [
	[64, 16, 16],
	[64, 17, 32],
	[64, 32, 32],
	[64, 33, 64],
	[64, 128, 64],
	# Of these nothing can be halved without a remainder.
	[60, 4, 30],
]
## Lines of a script, and whether the panorama stays as it is for them.
const LINES := [
	["position = Vector3.ZERO", false],
	["$Button.size = Vector2(3.0, 4.0)", false],
	["if points.size() == 3:", false],
	['print($Light.get(&"size"))', false],
	["$Light.size = 512", true],
	["$Light.panorama = null", true],
	['tween.tween_property($Light, "size", 512, 1.0)', true],
	["$Light.set(property, 512)", true],
	['var picture := load("res://demo/environments/sunset.exr")', true],
	['var name := "sunset"', true],
]


func _image(width: int, colour: Callable) -> Image:
	@warning_ignore("integer_division")
	var image := Image.create_empty(width, width / 2, false, Image.FORMAT_RGBAF)
	for y in image.get_height():
		for x in width:
			image.set_pixel(x, y, colour.call(x, y))
	return image


func test_images_are_halved_while_they_have_enough_and_never_enlarged(
	width: int, wanted: int, left: int, _test_parameters := WIDTHS
) -> void:
	var image := _image(width, func(x: int, y: int) -> Color: return Color(x % 4, y % 4, 0.25))
	var fitted := PanoramaFit.shrink(image, wanted)
	assert_int(fitted.get_width()).is_equal(left)
	@warning_ignore("integer_division")
	assert_int(fitted.get_height()).is_equal(left / 2)


func test_means_are_of_linear_light() -> void:
	# A lamp of a single texel, and a slope.
	var image := _image(
		32,
		func(x: int, y: int) -> Color:
			return Color(1000.0 if x == 5 and y == 9 else 0.0, 0.5 * x, 0.25)
	)
	var fitted := PanoramaFit.shrink(image, 8)
	assert_float(fitted.get_pixel(1, 2).r).is_equal_approx(1000.0 / 16.0, 0.25)
	assert_float(fitted.get_pixel(2, 2).r).is_equal(0.0)
	for x in 8:
		assert_float(fitted.get_pixel(x, 1).g).is_equal_approx(2.0 * x + 0.75, 0.04)
		assert_float(fitted.get_pixel(x, 3).b).is_equal_approx(0.25, 0.01)


func test_what_is_no_light_is_dark() -> void:
	var broken: Array[Color] = [
		Color(NAN, 4.0, -8.0), Color(INF, 4.0, -INF), Color(1e6, 4.0, 0.0), Color(4.0, 4.0, 4.0)
	]
	var image := _image(8, func(x: int, _y: int) -> Color: return broken[x / 2])
	var fitted := PanoramaFit.shrink(image, 4)
	var expected: Array[Vector3] = [
		Vector3(0.0, 4.0, 0.0),
		Vector3(0.0, 4.0, 0.0),
		Vector3(65408.0, 0.0, 0.0),
		4.0 * Vector3.ONE
	]
	for x in 4:
		var found := fitted.get_pixel(x, 0)
		# One exponent for three numbers.
		var step := maxf(expected[x].x, 4.0) / 256.0
		assert_float(found.r).is_equal_approx(expected[x].x, step)
		assert_float(found.g).is_equal_approx(expected[x].y, step)
		assert_float(found.b).is_equal_approx(expected[x].z, step)


func test_a_panorama_for_environments_alone_gets_smaller() -> void:
	var diet := Diet.of_files(ProjectFiles.of_scene(SCENE))
	var share: PanoramaFit.Share = diet.panoramas.shares[SUNSET]
	assert_int(diet.fit.size).is_between(32, 128)
	assert_vector(share.extent_before).is_equal(Vector2i(1024, 512))
	assert_int(share.extent_after.x).is_equal(4 * diet.fit.size)
	assert_int(share.after).is_less(share.before / 4)
	assert_str("\n".join(diet.describe())).contains("sunset.exr: 1024 x 512 texels in")
	var report: Array = diet.to_dictionary()["panoramas"]
	assert_int(report[0]["after"]).is_equal(share.after)
	var config := ConfigFile.new()
	config.parse(share.make_import("res://other.ctex").get_string_from_utf8())
	assert_array(Array(config.get_sections())).is_equal(["remap"])
	assert_str(config.get_value("remap", "path")).is_equal("res://other.ctex")
	assert_str(config.get_value("remap", "uid")).is_equal(
		ResourceUID.id_to_text(ResourceLoader.get_resource_uid(SUNSET))
	)
	# What is exported is a texture of these texels.
	var file := "user://diet_panorama.ctex"
	var written := FileAccess.open(file, FileAccess.WRITE)
	written.store_buffer(share.bytes)
	written.close()
	var texture: CompressedTexture2D = load(file)
	DirAccess.remove_absolute(file)
	var expected := PanoramaFit.shrink(
		(load(SUNSET) as Texture2D).get_image(), share.extent_after.x
	)
	assert_vector(Vector2i(texture.get_size())).is_equal(share.extent_after)
	assert_int(texture.get_image().get_format()).is_equal(Image.FORMAT_RGBE9995)
	assert_bool(texture.get_image().get_data() == expected.get_data()).is_true()


func test_a_preset_may_ask_for_narrow_panoramas_whatever_shows_them() -> void:
	var share := PanoramaFit.narrow(SUNSET, 512)
	assert_vector(share.extent_before).is_equal(Vector2i(1024, 512))
	assert_vector(share.extent_after).is_equal(Vector2i(512, 256))
	# Four bytes a texel, and a header.
	assert_int(share.after).is_between(512 * 256 * 4, 512 * 256 * 4 + 64)
	assert_int(share.bytes.size()).is_equal(share.after)
	# Texels are not halved, but may take fewer bytes.
	assert_vector(PanoramaFit.narrow(SUNSET, 1000).extent_after).is_equal(Vector2i(1024, 512))
	for other: String in ["res://addons/lobelight/icons/lobelight.svg", SCENE, "res://missing.exr"]:
		assert_object(PanoramaFit.narrow(other, 16)).is_null()


func test_without_the_option_nothing_is_resized() -> void:
	var diet := Diet.of_files(ProjectFiles.of_scene(SCENE), 0.0, false, false)
	assert_int(diet.fit.size).is_equal(0)
	assert_bool(diet.panoramas.shares.is_empty()).is_true()
	assert_int(diet.edit(SCENE).size()).is_equal(0)


func test_panoramas_stay_for_what_else_may_show_them(
	line: String, stays: bool, _test_parameters := LINES
) -> void:
	var file := "user://diet_panorama.gd"
	var written := FileAccess.open(file, FileAccess.WRITE)
	written.store_string("extends Node\n\n\nfunc _ready() -> void:\n\t%s\n" % line)
	written.close()
	_expect_stay(file, stays)
	DirAccess.remove_absolute(file)


func test_panoramas_stay_that_a_sky_or_a_resource_shows() -> void:
	var sky := PanoramaSkyMaterial.new()
	sky.panorama = load(SUNSET)
	ResourceSaver.save(sky, "user://diet_sky.tres")
	_expect_stay("user://diet_sky.tres", true)
	DirAccess.remove_absolute("user://diet_sky.tres")
	# In a scene that has an environment with it, too.
	var scene: Node = (load(SCENE) as PackedScene).instantiate()
	var surroundings: WorldEnvironment = scene.get_node("Surroundings")
	surroundings.environment.sky = Sky.new()
	surroundings.environment.sky.sky_material = sky
	var packed := PackedScene.new()
	packed.pack(scene)
	scene.free()
	ResourceSaver.save(packed, "user://diet_sky.tscn")
	_expect_stay("user://diet_sky.tscn", true)
	DirAccess.remove_absolute("user://diet_sky.tscn")


func test_panoramas_stay_out_where_the_light_baked_of_them_is_shown() -> void:
	var scene: Node = (load(SCENE) as PackedScene).instantiate()
	var environment: LobeEnvironment3D = scene.get_node("Light")
	environment.light = LobeLight.make_constant(Color.GRAY, true)
	var packed := PackedScene.new()
	packed.pack(scene)
	scene.free()
	var file := "user://diet_baked.tscn"
	ResourceSaver.save(packed, file)
	var diet := Diet.of_files(PackedStringArray([file]))
	var share: PanoramaFit.Share = diet.panoramas.shares[SUNSET]
	assert_bool(share.is_left_out).is_true()
	assert_int(share.after).is_equal(0)
	var written := FileAccess.open("user://diet_edited.scn", FileAccess.WRITE)
	written.store_buffer(diet.edit(file))
	written.close()
	var edited := load("user://diet_edited.scn") as PackedScene
	assert_array(ResourceLoader.get_dependencies("user://diet_edited.scn")).is_not_empty()
	scene = edited.instantiate()
	environment = scene.get_node("Light")
	assert_object(environment.panorama).is_null()
	assert_object(environment.light).is_not_null()
	scene.free()
	# Where another scene draws light of it, and where a script may, it stays.
	for other: String in [SCENE, "user://diet_panorama.gd"]:
		if other.ends_with(".gd"):
			written = FileAccess.open(other, FileAccess.WRITE)
			written.store_string("func f(n):\n\tn.panorama = null\n")
			written.close()
		var both := Diet.of_files(PackedStringArray([file, other]))
		assert_bool(both.panoramas.shares[SUNSET].is_left_out).is_false()
	for path: String in [file, "user://diet_edited.scn", "user://diet_panorama.gd"]:
		DirAccess.remove_absolute(path)


func _expect_stay(file: String, stays: bool) -> void:
	var diet := Diet.of_files(PackedStringArray([SCENE, file]))
	var share: PanoramaFit.Share = diet.panoramas.shares[SUNSET]
	assert_bool(share.bytes.is_empty()).is_equal(stays)
	assert_bool(share.after == share.before).is_equal(stays)
	assert_str(share.why).is_not_empty()
