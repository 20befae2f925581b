@tool
extends Object
## Lights in blocks for desktops (BC6H), encoded anew for systems that sample those of phones (ASTC)
## and not these: the engine would make eight times as many bytes of them when the game loads them.

const FileBytes := preload("file_bytes.gd")
const LightFormats := preload("../light/light_formats.gd")


## Whether an export of these features takes other blocks than desktops do.
static func is_asked_for(features: PackedStringArray) -> bool:
	return "astc" in features and "bptc" not in features


## What is exported in place of a file; empty if it is exported as it is.
static func of(path: String, type: String) -> PackedByteArray:
	if type != "Resource" and type != "LobeLight":
		return PackedByteArray()
	var light := load(path) as LobeLight
	if light == null or light.get_problem():
		return PackedByteArray()
	if light.faces[0].get_format() != Image.FORMAT_BPTC_RGBFU:
		return PackedByteArray()
	var variant := light.duplicate() as LobeLight
	var error := encode(variant)
	if error:
		push_warning("%s: exported in blocks for desktops: %s" % [path, error])
		return PackedByteArray()
	return FileBytes.of(variant, "res")


## Encodes a light's faces in the blocks of phones; why that cannot be done, in a sentence.
static func encode(light: LobeLight) -> String:
	var halves: Array[Image] = []
	for face in light.faces:
		var image: Image = face.duplicate()
		if image.decompress() != OK:
			return "The engine cannot read its faces."
		image.convert(Image.FORMAT_RGBAH)
		halves.append(image)
	var converted := LightFormats.convert_faces(halves, LightFormats.Format.ASTC)
	if converted.has("error"):
		return converted["error"]
	light.faces = converted["faces"]
	light.seal()
	return ""
