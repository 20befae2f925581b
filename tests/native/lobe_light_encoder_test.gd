extends GdUnitTestSuite
## LobeLightEncoder's blocks, as the engine decodes them.

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
