extends GdUnitTestSuite
## LobeLightEncoder's blocks, as the engine decodes them.

const LightFormats := preload("res://addons/lobelight/editor/light/light_formats.gd")
const SIZE := 32

const REFUSED := [
	["size", 12, "size is 12, but must be a power of two"],
	["size", 64, "faces must be an Array of six PackedByteArrays of 43688 bytes"],
	["faces", [], "faces must be an Array of six PackedByteArrays"],
	["faces", "six", "faces must be an Array of six PackedByteArrays"],
	["quality", 1, '"quality" is not a key of a light to encode'],
]


func test_the_engine_decodes_what_was_encoded() -> void:
	var face := _make_face()
	var result := LobeLightEncoder.new().encode(_make_request(face))
	assert_str(result.get("error", "")).is_empty()
	assert_int(result["size"]).is_equal(SIZE)
	var faces: Array = result["faces"]
	assert_int(faces.size()).is_equal(6)
	var image := Image.create_from_data(SIZE, SIZE, true, Image.FORMAT_BPTC_RGBFU, faces[4])
	assert_int(image.decompress()).is_equal(OK)
	image.convert(Image.FORMAT_RGBAH)
	var got := image.get_data()
	var expected := face.get_data()
	assert_int(got.size()).is_equal(expected.size())
	var squares := 0.0
	var all := 0.0
	for at in range(0, got.size(), 8):
		for channel in 3:
			var wanted := expected.decode_half(at + 2 * channel)
			squares += pow(got.decode_half(at + 2 * channel) - wanted, 2.0)
			all += wanted * wanted
	# Found is 0.08, at edges across blocks; bits in wrong places would give noise.
	assert_float(sqrt(squares / all)).is_less(0.12)


func test_refusals(
	key: String, value: Variant, sentence: String, _test_parameters := REFUSED
) -> void:
	var request := _make_request(_make_face())
	request[key] = value
	var error: String = LobeLightEncoder.new().encode(request).get("error", "")
	assert_str(error).contains(sentence)
	assert_bool("\n" in error).is_false()


# The coarse part is the light's levels from the second one on, within the rounding of shared
# exponents, and looks a lobe up at the same blur.
func test_a_light_in_blocks_has_a_coarse_part() -> void:
	var halves: Array[Image] = []
	for face in 6:
		var image := Image.create_empty(64, 64, false, Image.FORMAT_RGBAF)
		for at in 64 * 64:
			@warning_ignore("integer_division")
			var texel := Vector2i(at % 64, at / 64)
			image.set_pixelv(texel, Color(exp(0.05 * texel.x), 0.1 + 0.01 * texel.y, 1.0 + face))
		image.generate_mipmaps()
		image.convert(Image.FORMAT_RGBAH)
		halves.append(image)
	var light := LobeLight.new()
	light.faces = halves
	light.size = 64
	light.level_variance = 5.0 / 6.0
	light.base_variance = 5.0 / 12.0
	light.is_even = true
	assert_str(LightFormats.convert_light(light, LightFormats.Format.BPTC)).is_empty()
	var coarse := light.coarse
	assert_int(light.faces[0].get_format()).is_equal(Image.FORMAT_BPTC_RGBFU)
	assert_int(coarse.size).is_equal(16)
	assert_vector(coarse.get_sharpest()).is_equal_approx(light.get_sharpest(), Vector2.ONE * 1e-9)
	assert_float(light.get_level().x - coarse.get_level().x).is_equal_approx(2.0, 1e-6)
	for face in 6:
		var whole := halves[face].duplicate() as Image
		whole.shrink_x2()
		whole.shrink_x2()
		for texel: Vector2i in [Vector2i(0, 0), Vector2i(7, 3), Vector2i(15, 15)]:
			var wanted := whole.get_pixelv(texel)
			var got := coarse.faces[face].get_pixelv(texel)
			for channel in 3:
				var largest := maxf(wanted.r, maxf(wanted.g, wanted.b))
				assert_float(got[channel]).is_equal_approx(wanted[channel], largest / 256.0)
	light.seal()
	assert_str(light.get_problem()).is_empty()
	coarse.version = 99
	assert_str(light.get_problem()).contains("format 99")
	# Whoever has no blocks needs no coarse part.
	light.faces = halves
	assert_str(LightFormats.convert_light(light, LightFormats.Format.SHARED_EXPONENT)).is_empty()
	assert_object(light.coarse).is_null()


# Waves of three colours from 0.1 to 5, with edges between them.
func _make_face() -> Image:
	var image := Image.create_empty(SIZE, SIZE, false, Image.FORMAT_RGBAF)
	for y in SIZE:
		for x in SIZE:
			var value := exp(0.1 * x - 2.0) * (2.0 if (x + 2 * y) % 11 < 5 else 1.0)
			var tint := 0.5 + 0.4 * sin(0.7 * x + 0.4 * y)
			image.set_pixel(x, y, Color(value, value * tint, value * (1.0 - 0.5 * tint)))
	image.generate_mipmaps()
	image.convert(Image.FORMAT_RGBAH)
	return image


func _make_request(face: Image) -> Dictionary:
	var data := face.get_data()
	return {"faces": [data, data, data, data, data, data], "size": SIZE, "threads": 1}
