@tool
extends "native_importer.gd"
## Imports measured BRDFs, MERL's .binary and the RGB .bsdf of the RGL database, as [LobeTable]s:
## [code]material.table = load("res://gold.binary")[/code].

const Job := preload("../bake/bake_job.gd")
const Progress := preload("import_progress.gd")
const Recipe := preload("../bake/bake_recipe.gd")
const TableState := preload("../bake/table_state.gd")
const Wording := preload("../wording.gd")

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
		{
			"name": "environment",
			"default_value": "",
			"property_hint": PROPERTY_HINT_FILE,
			"hint_string": "*.exr,*.hdr",
		},
	]


func _get_option_visibility(_path: String, option: StringName, options: Dictionary) -> bool:
	return option == &"lobes" or options["lobes"] == Recipe.AUTOMATIC


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
	recipe.environment = options["environment"]
	var path := "%s.%s" % [save_path, _get_save_extension()]
	var job := Job.new(null, recipe)
	var result := bake(job, Progress.new("Fitting the lobes of %s" % source.get_file()))
	if result.is_empty():
		return _end_without_result(source, path, job.error)
	if result["clamped"] > 0:
		var count := Wording.count(result["clamped"], "number")
		print("%s: %s, negative or not finite, taken for 0." % [source, count])
	var table := LobeTable.from_baked(result)
	TableState.describe(table, result, recipe)
	return ResourceSaver.save(table, path)


## A result of [method LobeBaker.bake]; empty if it failed, which sets the job's error, or was
## cancelled.
static func bake(job: Job, progress: Progress) -> Dictionary:
	var result := {}
	if job.start():
		while job.is_running():
			progress.step(job.get_progress(), job.get_seconds_left())
			if progress.is_cancelled:
				job.cancel()
		result = job.take_result()
		progress.close()
	var source := job.recipe.brdf
	job.error = name_by_project(job.error, source)
	if not job.error.is_empty() and not job.error.contains(source):
		job.error = "%s: %s" % [source, job.error]
	return result


# A cancelled import keeps the table of the one before.
static func _end_without_result(source: String, path: String, problem: String) -> Error:
	if problem:
		push_error(problem)
		return ERR_FILE_CORRUPT
	if FileAccess.file_exists(path):
		print("%s: cancelled; the table is the one from before. Reimport fits it anew." % source)
		return OK
	print("%s: cancelled; Reimport in the Import dock makes the table." % source)
	return ERR_SKIP
