extends GdUnitTestSuite
## Lights in blocks for desktops are exported in those of phones where only these are sampled.

const LightVariant := preload("res://addons/lobelight/editor/export/light_variant.gd")
const PATH := "user://light_variant_test.res"
const PHONE := "user://light_variant_test_phone.res"

## Features of exports, and whether lights are to be encoded anew.
const EXPORTS := [
	[["android", "mobile", "etc2", "astc"], true],
	[["linuxbsd", "pc", "s3tc", "bptc"], false],
	[["macos", "pc", "s3tc", "bptc", "etc2", "astc"], false],
	[["web"], false],
]


func after_test() -> void:
	for path: String in [PATH, PHONE]:
		if FileAccess.file_exists(path):
			DirAccess.remove_absolute(path)


func test_phones_take_other_blocks(
	features: Array, expected: bool, _test_parameters := EXPORTS
) -> void:
	assert_bool(LightVariant.is_asked_for(PackedStringArray(features))).is_equal(expected)


func test_a_light_is_encoded_anew() -> void:
	var light := _make(Image.FORMAT_BPTC_RGBFU)
	light.coarse = _make(Image.FORMAT_RGBE9995)
	light.seal()
	assert_int(ResourceSaver.save(light, PATH)).is_equal(OK)
	var bytes := LightVariant.of(PATH, "Resource")
	var file := FileAccess.open(PHONE, FileAccess.WRITE)
	file.store_buffer(bytes)
	file.close()
	var phone: LobeLight = load(PHONE)
	assert_str(phone.get_problem()).is_empty()
	assert_int(phone.faces[0].get_format()).is_equal(Image.FORMAT_ASTC_4x4_HDR)
	assert_int(phone.coarse.faces[0].get_format()).is_equal(Image.FORMAT_RGBE9995)
	for face in 6:
		var image := phone.faces[face].duplicate() as Image
		image.decompress()
		var texel := image.get_pixel(5, 9)
		assert_float(texel.r).is_equal_approx(1.0 + face, 0.05 * (1.0 + face))
		assert_float(texel.g).is_equal_approx(0.5, 0.05)
	# The one in the project stays as it is.
	assert_int(light.faces[0].get_format()).is_equal(Image.FORMAT_BPTC_RGBFU)


func test_others_stay_as_they_are() -> void:
	ResourceSaver.save(_make(Image.FORMAT_RGBE9995), PATH)
	assert_int(LightVariant.of(PATH, "Resource").size()).is_equal(0)
	ResourceSaver.save(Curve.new(), PATH)
	assert_int(LightVariant.of(PATH, "Curve").size()).is_equal(0)


func _make(format: Image.Format) -> LobeLight:
	var faces: Array[Image] = []
	for face in 6:
		var image := Image.create_empty(16, 16, true, Image.FORMAT_RGBH)
		image.fill(Color(1.0 + face, 0.5, 0.25))
		image.generate_mipmaps()
		if format == Image.FORMAT_BPTC_RGBFU:
			image.compress_from_channels(Image.COMPRESS_BPTC, Image.USED_CHANNELS_RGB)
		else:
			image.convert(format)
		faces.append(image)
	var light := LobeLight.new()
	light.faces = faces
	light.size = 16
	light.is_even = true
	return light
