@tool
extends "native_importer.gd"
## Imports environment maps as baked lights, [LobeLight]s for [member LobeEnvironment3D.light]:
## [code]environment.light = load("res://hall.exr")[/code]. The files are those that
## panorama_importer.gd reads; the library filters them as the environment would when the game runs.
## [br][br]
## It is chosen in the import dock; the engine's importer stays the one that files get by default.

const LightFormats := preload("../light/light_formats.gd")
const PanoramaFilter := preload("../light/panorama_filter.gd")
const PanoramaImporter := preload("panorama_importer.gd")
const Progress := preload("import_progress.gd")
const Pyramid := preload("../../runtime/pyramid/pyramid.gd")

const NAME := "lobelight.light"
## Texels along a side of what graphics cards take as a texture.
const LARGEST_SIDE := 16384


func _get_importer_name() -> String:
	return NAME


func _get_visible_name() -> String:
	return "Light (Lobelight)"


func _get_recognized_extensions() -> PackedStringArray:
	return ["exr", "hdr"]


func _get_resource_type() -> String:
	return "Resource"


# Below the engine's own, and below that of panoramas.
func _get_priority() -> float:
	return 0.4


func _get_import_options(path: String, _preset: int) -> Array[Dictionary]:
	var layers := ",".join(PanoramaImporter.list_layers(path))
	return [
		{
			"name": "size",
			"default_value": 0,
			"property_hint": PROPERTY_HINT_ENUM,
			"hint_string": "Automatic:0,32:32,64:64,128:128,256:256,512:512,1024:1024,2048:2048",
		},
		{
			"name": "filter",
			"default_value": Pyramid.Filter.DISC,
			"property_hint": PROPERTY_HINT_ENUM,
			"hint_string": "Gaussian:%d,Disc:%d" % [Pyramid.Filter.GAUSSIAN, Pyramid.Filter.DISC],
		},
		{
			"name": "format",
			"default_value": LightFormats.Format.BPTC,
			"property_hint": PROPERTY_HINT_ENUM,
			"hint_string": "Half Floats,Shared Exponents,Blocks for Desktops,Blocks for Phones",
		},
		{
			"name": "layer",
			"default_value": "",
			"property_hint": PROPERTY_HINT_ENUM_SUGGESTION,
			"hint_string": layers,
		},
		{
			"name": "exposure",
			"default_value": 0.0,
			"property_hint": PROPERTY_HINT_RANGE,
			"hint_string": "-16,16,0.01,suffix:EV",
		},
		{
			"name": "max_sources",
			"default_value": 4,
			"property_hint": PROPERTY_HINT_RANGE,
			"hint_string": "0,4",
		},
	]


func _get_option_visibility(path: String, option: StringName, _options: Dictionary) -> bool:
	if option != &"layer" or path.is_empty():
		return true
	return not PanoramaImporter.list_layers(path).is_empty()


func _import(
	source: String,
	save_path: String,
	options: Dictionary,
	_platform_variants: Array[String],
	_generated: Array[String]
) -> Error:
	var path := "%s.%s" % [save_path, _get_save_extension()]
	var read := read_file(source, options)
	if read.has("error"):
		push_error(read["error"])
		return ERR_FILE_CORRUPT
	for note: String in read["notes"]:
		print("%s: %s." % [source, note])
	var progress := Progress.new(
		"Filtering the light of %s" % source.get_file(), "Import LobeLight"
	)
	var made: Variant = filter(read, options, progress)
	for warning: String in read["warnings"]:
		push_warning("%s: %s." % [source, warning])
	if made is LobeLight:
		var light := made as LobeLight
		light.seal()
		return ResourceSaver.save(light, path, ResourceSaver.FLAG_COMPRESS)
	if not progress.is_cancelled:
		push_error("%s: %s" % [source, made])
		return ERR_FILE_CORRUPT
	# A cancelled import keeps the light of the one before.
	if FileAccess.file_exists(path):
		print("%s: cancelled; the light is the one from before. Reimport filters it." % source)
		return OK
	print("%s: cancelled; Reimport in the Import dock makes the light." % source)
	return ERR_SKIP


## What [method LobeImageFile.load_panorama] makes of a file, or its [code]"error"[/code], a
## sentence.
static func read_file(source: String, options: Dictionary) -> Dictionary:
	var problem := NativeLibrary.get_problem()
	if problem:
		return {"error": "%s: %s" % [source, problem]}
	var read: Dictionary = NativeLibrary.create(&"LobeImageFile").call(
		"load_panorama", source, options["layer"], LARGEST_SIDE
	)
	if read.has("error"):
		read["error"] = name_by_project(read["error"], source)
	return read


## The light of a panorama as [method read_file] gives it, or a sentence that says
## why there is none. What there is to say of light that is lost is added to its warnings.
static func filter(read: Dictionary, options: Dictionary, progress: Progress) -> Variant:
	var kernel: Pyramid.Filter = options["filter"]
	var extent := Vector2i(read["width"] as int, read["height"] as int)
	var request := PanoramaFilter.make_linear_request(
		read["pixels"] as PackedFloat32Array, extent, options["size"] as int, kernel
	)
	request["exposure"] = options["exposure"]
	request["max_sources"] = options["max_sources"]
	var task := NativeLibrary.create(&"LobeLightFilter")
	if task.call(&"start", request):
		while task.call(&"is_running"):
			progress.step(task.call(&"get_progress") as float, -1.0)
			if progress.is_cancelled:
				task.call(&"cancel")
		progress.close()
	var result: Dictionary = task.call(&"get_result")
	if result.is_empty():
		var error: String = task.call(&"get_error")
		return error if error else "The import was cancelled."
	(read["warnings"] as Array).append_array(result["warnings"] as Array)
	var light: LobeLight = PanoramaFilter.make_light(request, result)
	var problem := LightFormats.convert_light(light, options["format"] as int)
	return problem if problem else light
