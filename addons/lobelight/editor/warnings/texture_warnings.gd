@tool
extends Object
## Textures of directions in formats that bend these, and what to set in the Import dock.
##
## Formats of blocks (BC, ETC, ASTC) and lossy pictures keep what eyes see of colours. Of a flow map
## they change the directions; of a normal map too, unless it is imported as one.

## Of ResourceImporterTexture: values of compress/mode and compress/normal_map.
enum Mode { LOSSLESS, LOSSY, VRAM_COMPRESSED, VRAM_UNCOMPRESSED, BASIS_UNIVERSAL }
const NORMAL_MAP_ENABLE := 1

# Properties with directions, and what turns them on.
const _NORMAL_MAPS: Dictionary[String, String] = {
	"normal_texture": "normal_enabled",
	"bent_normal_texture": "bent_normal_enabled",
	"detail_normal": "detail_enabled",
}
# Of blocks that keep two channels apart, as normal maps are stored.
const _TWO_CHANNELS: Array[Image.Format] = [
	Image.FORMAT_RGTC_RG,
	Image.FORMAT_ETC2_RG11,
	Image.FORMAT_ETC2_RG11S,
	Image.FORMAT_ETC2_RA_AS_RG,
	Image.FORMAT_DXT5_RA_AS_RG,
]

# By file: when it was changed, compress/mode, compress/normal_map. Warnings ask over and over.
static var _imports: Dictionary[String, Array] = {}


## Of a material's flow map and normal maps.
static func of(material: LobeMaterial3D) -> PackedStringArray:
	var warnings: PackedStringArray = []
	if material.get_shown_anisotropy() != 0.0:
		_append(warnings, of_flow_map(material.anisotropy_flowmap))
	for property in _NORMAL_MAPS:
		if material.get(_NORMAL_MAPS[property]):
			_append(warnings, of_normal_map(material.get(property) as Texture2D))
	return warnings


## What is wrong with a texture as a flow map; empty if nothing is.
static func of_flow_map(texture: Texture2D) -> String:
	texture = _get_whole(texture)
	if texture == null:
		return ""
	var import := _get_import(texture)
	var how := ""
	if not import.is_empty():
		how = _name_of(import[1])
	elif is_of_blocks(_get_format(texture)):
		how = "VRAM-compressed"
	if how.is_empty():
		return ""
	if import.is_empty():
		return "The flow map is %s, which bends its directions: take one that is not." % how
	return (
		(
			"The flow map %s is imported as %s, which bends its directions: in the Import dock, set "
			+ "Compress > Mode to Lossless and Detect 3D > Compress To to Disabled, and press Reimport."
		)
		% [texture.resource_path.get_file(), how]
	)


## What is wrong with a texture as a normal map; empty if nothing is.
static func of_normal_map(texture: Texture2D) -> String:
	texture = _get_whole(texture)
	if texture == null:
		return ""
	var import := _get_import(texture)
	if import.is_empty():
		var format := _get_format(texture)
		if is_of_blocks(format) and format not in _TWO_CHANNELS:
			return "A normal map is compressed as colours, which bends its normals: take another."
		return ""
	var how := _name_of(import[1])
	var is_normal_map: bool = import[2] == NORMAL_MAP_ENABLE
	if how.is_empty() or (is_normal_map and import[1] != Mode.LOSSY):
		return ""
	var cure := "set Compress > Normal Map to Enable"
	if import[1] == Mode.LOSSY:
		cure = "set Compress > Mode to VRAM Compressed and Normal Map to Enable"
	return (
		(
			"The normal map %s is imported as %s colours, which bends its normals: in the Import dock, "
			+ "%s, and press Reimport."
		)
		% [texture.resource_path.get_file(), how, cure]
	)


## Whether a format stores blocks of texels.
static func is_of_blocks(format: Image.Format) -> bool:
	return format >= Image.FORMAT_DXT1 and format <= Image.FORMAT_ASTC_8x8_HDR


static func _append(warnings: PackedStringArray, warning: String) -> void:
	if warning and warning not in warnings:
		warnings.append(warning)


static func _name_of(mode: int) -> String:
	match mode:
		Mode.LOSSY:
			return "lossy"
		Mode.VRAM_COMPRESSED:
			return "VRAM-compressed"
		Mode.BASIS_UNIVERSAL:
			return "Basis Universal"
	return ""


static func _get_whole(texture: Texture2D) -> Texture2D:
	while texture is AtlasTexture:
		texture = (texture as AtlasTexture).atlas
	return texture


# The format of a texture that was not imported. To ask for its picture would fetch all of it.
static func _get_format(texture: Texture2D) -> Image.Format:
	if texture is ImageTexture:
		return (texture as ImageTexture).get_format()
	if texture is PortableCompressedTexture2D:
		return (texture as PortableCompressedTexture2D).get_format()
	return Image.FORMAT_MAX


# When it was changed, mode and normal map of a texture's import; empty if it was not imported.
static func _get_import(texture: Texture2D) -> Array:
	var path := texture.resource_path + ".import"
	if not texture.resource_path.begins_with("res://") or not FileAccess.file_exists(path):
		return []
	var time := FileAccess.get_modified_time(path)
	if not _imports.has(path) or _imports[path][0] != time:
		var file := ConfigFile.new()
		file.load(path)
		_imports[path] = [
			time,
			file.get_value("params", "compress/mode", Mode.LOSSLESS),
			file.get_value("params", "compress/normal_map", 0),
		]
	return _imports[path]
