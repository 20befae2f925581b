@tool
extends Object
## The formats that the faces of a [LobeLight] are saved in, and their encoders.

## Half floats, 8 bytes a texel; shared exponents (RGB9E5), 4; blocks for desktops (BC6H) and for
## phones (ASTC HDR), 1.
enum Format { HALF, SHARED_EXPONENT, BPTC, ASTC }

const NativeLibrary := preload("../bake/native_library.gd")

const IMAGE_FORMATS: Dictionary[Format, Image.Format] = {
	Format.HALF: Image.FORMAT_RGBAH,
	Format.SHARED_EXPONENT: Image.FORMAT_RGBE9995,
	Format.BPTC: Image.FORMAT_BPTC_RGBFU,
	Format.ASTC: Image.FORMAT_ASTC_4x4_HDR,
}
# Texels along the side of a block.
const _BLOCK := 4
# The level that the coarse part of a light in blocks begins with, and the least side of it.
const _COARSE_LEVEL := 2
const _LEAST_COARSE := 16


## Puts a light of half floats into another format; why it could not be done, in a sentence, and
## empty if it was.
static func convert_light(light: LobeLight, format: Format) -> String:
	var halves := light.faces
	var converted := convert_faces(halves, format)
	if converted.has("error"):
		return converted["error"]
	light.faces = converted["faces"]
	light.coarse = null
	var is_in_blocks := format == Format.BPTC or format == Format.ASTC
	if is_in_blocks and light.size >> _COARSE_LEVEL >= _LEAST_COARSE:
		light.coarse = _make_coarse(light, halves)
	return ""


# Levels 2 and coarser, as a light of their own. Where level 0 of a light blurs by t^2 (b + 1/6), t
# being the side of its texels (shaders/environment.gdshaderinc), that of this one, whose texels are
# four times as wide, is to blur by t^2 (b - c + 16 (c + 1/6)): b' = c + (b - c) / 16.
static func _make_coarse(light: LobeLight, halves: Array[Image]) -> LobeLight:
	var coarse := LobeLight.new()
	coarse.size = light.size >> _COARSE_LEVEL
	coarse.level_variance = light.level_variance
	var sharper := light.base_variance - light.level_variance
	coarse.base_variance = light.level_variance + sharper / pow(4.0, _COARSE_LEVEL)
	coarse.is_even = light.is_even
	var faces: Array[Image] = []
	for face in halves:
		var data := face.get_data().slice(face.get_mipmap_offset(_COARSE_LEVEL))
		var image := Image.create_from_data(
			coarse.size, coarse.size, true, Image.FORMAT_RGBAH, data
		)
		image.convert(Image.FORMAT_RGBE9995)
		faces.append(image)
	coarse.faces = faces
	return coarse


## Faces of half floats with all their levels in another format: {"faces"} or {"error"}, a sentence.
## Faces smaller than a block stay half floats.
static func convert_faces(faces: Array[Image], format: Format) -> Dictionary:
	var size := faces[0].get_width()
	if format == Format.HALF or size < _BLOCK and format != Format.SHARED_EXPONENT:
		return {"faces": faces}
	if format == Format.BPTC:
		return _encode_bptc(faces, size)
	var converted: Array[Image] = []
	for face in faces:
		var image: Image = face.duplicate()
		if format == Format.SHARED_EXPONENT:
			image.convert(Image.FORMAT_RGBE9995)
		elif image.compress_from_channels(Image.COMPRESS_ASTC, Image.USED_CHANNELS_RGB) != OK:
			return {"error": "This build of the engine has no encoder for ASTC."}
		converted.append(image)
	return {"faces": converted}


static func _encode_bptc(faces: Array[Image], size: int) -> Dictionary:
	var encoder := NativeLibrary.create(&"LobeLightEncoder")
	if encoder == null:
		return {"error": NativeLibrary.MISSING}
	var halves := faces.map(func(face: Image) -> PackedByteArray: return face.get_data())
	var result: Dictionary = encoder.call(&"encode", {"faces": halves, "size": size})
	if result.has("error"):
		return result
	var converted: Array[Image] = []
	for data: PackedByteArray in result["faces"]:
		converted.append(Image.create_from_data(size, size, true, Image.FORMAT_BPTC_RGBFU, data))
	return {"faces": converted}
