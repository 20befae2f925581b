@tool
extends "native_importer.gd"
## Imports environment maps through OpenEXR, for files that the engine's own importer refuses or
## misreads: every compression, halves, floats and whole numbers, some of R, G and B, luminance with
## or without chroma, other primaries, data and display windows, parts and layers, Radiance files of
## any orientation. The result is an [ImageTexture] of linear half floats, for
## [member LobeEnvironment3D.panorama] and [member PanoramaSkyMaterial.panorama]. What became of
## values that halves do not hold, and what the file's header asks for in vain, is said in the
## output.
## [br][br]
## It is chosen in the import dock; the engine's importer stays the one that files get by default.

const HeldPanoramas := preload("held_panoramas.gd")

const NAME := "lobelight.panorama"

var _held := HeldPanoramas.new()


func _get_importer_name() -> String:
	return NAME


func _get_visible_name() -> String:
	return "Panorama (Lobelight)"


func _get_recognized_extensions() -> PackedStringArray:
	return ["exr", "hdr"]


func _get_resource_type() -> String:
	return "ImageTexture"


# Below the engine's own.
func _get_priority() -> float:
	return 0.5


func _get_import_options(path: String, _preset: int) -> Array[Dictionary]:
	return [
		{
			"name": "layer",
			"default_value": "",
			"property_hint": PROPERTY_HINT_ENUM_SUGGESTION,
			"hint_string": ",".join(list_layers(path)),
		},
		{
			"name": "exposure",
			"default_value": 0.0,
			"property_hint": PROPERTY_HINT_RANGE,
			"hint_string": "-16,16,0.01,suffix:EV",
		},
		{"name": "mipmaps", "default_value": false},
	]


func _get_option_visibility(path: String, option: StringName, _options: Dictionary) -> bool:
	return option != &"layer" or path.is_empty() or not list_layers(path).is_empty()


func _import(
	source: String,
	save_path: String,
	options: Dictionary,
	_platform_variants: Array[String],
	_generated: Array[String]
) -> Error:
	_held.begin(source)
	var read := read_file(source, options)
	if read.has("error"):
		push_error(read["error"])
		return ERR_FILE_CORRUPT
	for note: String in read["notes"]:
		print("%s: %s." % [source, note])
	for warning: String in read["warnings"]:
		push_warning("%s: %s." % [source, warning])
	var width: int = read["width"]
	var height: int = read["height"]
	var data: PackedByteArray = read["data"]
	var image := Image.create_from_data(width, height, false, Image.FORMAT_RGBAH, data)
	if options["mipmaps"]:
		image.generate_mipmaps()
	_held.set_image(source, image)
	var texture := ImageTexture.create_from_image(image)
	return ResourceSaver.save(
		texture, "%s.%s" % [save_path, _get_save_extension()], ResourceSaver.FLAG_COMPRESS
	)


## To be called when the engine has reloaded what it imported anew.
func on_reimported(paths: PackedStringArray) -> void:
	_held.end(paths)


## What [method LobeImageFile.load_half_panorama] makes of a file, or its [code]"error"[/code], a
## sentence.
static func read_file(source: String, options: Dictionary) -> Dictionary:
	var problem := NativeLibrary.get_problem()
	if problem:
		return {"error": "%s: %s" % [source, problem]}
	var file := NativeLibrary.create(&"LobeImageFile")
	var read: Dictionary = file.call(
		"load_half_panorama", source, options["layer"], options["exposure"]
	)
	if read.has("error"):
		read["error"] = name_by_project(read["error"], source)
	return read


## The layers of a file that can be chosen; none where there is no choice, or no library.
static func list_layers(path: String) -> PackedStringArray:
	var file := NativeLibrary.create(&"LobeImageFile")
	if path.is_empty() or file == null or not FileAccess.file_exists(path):
		return []
	var listed: Dictionary = file.call("list_layers", path)
	var names: PackedStringArray = []
	for layer: String in listed.get("layers", []):
		# Commas part the names of a hint.
		if not layer.is_empty() and not layer.contains(","):
			names.append(layer)
	return names
