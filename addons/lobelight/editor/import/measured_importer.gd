@tool
extends "native_importer.gd"
## Imports measured BRDFs, MERL's .binary and the RGB .bsdf of the RGL database, as [LobeTable]s:
## [code]material.table = load("res://gold.binary")[/code].

const Recipe := preload("../bake/bake_recipe.gd")
const TableState := preload("../bake/table_state.gd")

const NAME := "lobelight.measured"


func _get_importer_name() -> String:
	return NAME


func _get_visible_name() -> String:
	return "LobeTable"


func _get_recognized_extensions() -> PackedStringArray:
	return Recipe.MEASURED_EXTENSIONS


func _get_resource_type() -> String:
	return "Resource"


func _get_priority() -> float:
	return 1.0


func _get_import_options(_path: String, _preset: int) -> Array[Dictionary]:
	return [
		{
			"name": "lobes",
			"default_value": 8,
			"property_hint": PROPERTY_HINT_ENUM,
			"hint_string": "4:4,8:8,16:16,24:24,32:32,Automatic:0",
		},
		{
			"name": "target",
			"default_value": 30.0,
			"property_hint": PROPERTY_HINT_RANGE,
			"hint_string": "10,46,0.5,suffix:dB",
		},
	]


func _get_option_visibility(_path: String, option: StringName, options: Dictionary) -> bool:
	return option != &"target" or options["lobes"] == Recipe.AUTOMATIC


func _import(
	source: String,
	save_path: String,
	options: Dictionary,
	_platform_variants: Array[String],
	_generated: Array[String]
) -> Error:
	var recipe := Recipe.new()
	recipe.brdf = source
	recipe.lobes = options["lobes"]
	recipe.target = options["target"]
	var result := bake(recipe)
	if result.has("error"):
		push_error(result["error"])
		return ERR_FILE_CORRUPT
	if result["clamped"] > 0:
		print("%s: %d numbers were negative or not finite." % [source, result["clamped"]])
	var table := LobeTable.from_baked(result)
	TableState.describe(table, result, recipe)
	return ResourceSaver.save(table, "%s.%s" % [save_path, _get_save_extension()])


## A result of [method LobeBaker.bake]; its [code]"error"[/code] names the file by its path in the
## project.
static func bake(recipe: Recipe) -> Dictionary:
	var problem := NativeLibrary.get_problem()
	if problem:
		return {"error": "%s: %s" % [recipe.brdf, problem]}
	var baker := NativeLibrary.create(&"LobeBaker")
	var result: Dictionary = baker.call("bake", recipe.to_request())
	if result.has("error"):
		result["error"] = name_by_project(result["error"], recipe.brdf)
	return result
