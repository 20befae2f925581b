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
