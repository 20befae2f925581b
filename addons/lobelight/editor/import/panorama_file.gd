@tool
extends Object
## The files of panoramas that panorama_importer.gd has imported, as they are: their textures end at
## 65504.

const NativeLibrary := preload("../bake/native_library.gd")
const PanoramaFilter := preload("../light/panorama_filter.gd")
const PanoramaImporter := preload("panorama_importer.gd")
const Pyramid := preload("../../runtime/pyramid/pyramid.gd")

const _KEYS: PackedStringArray = ["layer", "exposure"]


## What the light of a texture's file is filtered by, see [method PanoramaFilter.make_request];
## empty if the texture is no such panorama, or its file cannot be read.
static func make_request(texture: Texture2D, size: int, filter: Pyramid.Filter) -> Dictionary:
	var options := find_options(texture.resource_path)
	if options.is_empty() or not NativeLibrary.is_loaded():
		return {}
	var read: Dictionary = NativeLibrary.create(&"LobeImageFile").call(
		"load_panorama", texture.resource_path, options["layer"]
	)
	var extent := Vector2i(read.get("width", 0) as int, read.get("height", 0) as int)
	# It may have changed since it was imported.
	if read.has("error") or extent != Vector2i(texture.get_size()):
		return {}
	var pixels: PackedFloat32Array = read["pixels"]
	var request := PanoramaFilter.make_linear_request(pixels, extent, size, filter)
	request["exposure"] = options["exposure"]
	return request


## What a file has been imported with; empty if that was another importer's work.
static func find_options(path: String) -> Dictionary:
	var config := ConfigFile.new()
	if not FileAccess.file_exists(path + ".import") or config.load(path + ".import") != OK:
		return {}
	if config.get_value("remap", "importer", "") != PanoramaImporter.NAME:
		return {}
	var options := {}
	for key in _KEYS:
		if not config.has_section_key("params", key):
			return {}
		options[key] = config.get_value("params", key)
	return options
