extends SceneTree
## `./dev bake`: fits one BRDF by lobes and saves the table as a resource.

const Wording := preload("res://addons/lobelight/editor/wording.gd")

const OPTIONS: PackedStringArray = [
	"recipe",
	"brdf",
	"alpha",
	"lobes",
	"views",
	"method",
	"refine",
	"placement",
	"reach",
	"seed",
	"threads",
	"out",
	"export",
	"json",
	"target",
]
## Where "lobes": "auto" measures a table, beside the library's synthetic environment.
const ENVIRONMENTS: PackedStringArray = [
	"res://demo/environments/hall.exr",
	"res://demo/environments/sunset.exr",
	"res://tests/data/forest.exr",
]

var _arguments := CommandLine.new("bake", OPTIONS)


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	var recipe := _recipe()
	var out := _arguments.path("out")
	if _arguments.error.is_empty():
		_check_outputs(out)
	_arguments.fail_if(NativeLibrary.error())
	if _arguments.error.is_empty():
		await _bake(recipe, out)
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
		quit(1)
		return
	quit(0)


## The recipe file, if one is named, under the options of the command line.
func _recipe() -> Dictionary:
	var recipe := {}
	if _arguments.has("recipe"):
		recipe = _read_recipe(_arguments.path("recipe"))
	if _arguments.has("method"):
		recipe["method"] = _arguments.text("method")
	if _arguments.has("placement"):
		recipe["placement"] = _arguments.text("placement")
	if _arguments.has("reach"):
		recipe["reach"] = _arguments.numbers("reach", 1, PackedFloat64Array([0]))[0]
	if _arguments.has("refine"):
		recipe["refine"] = _arguments.text("refine") == "yes"
		if _arguments.text("refine") not in ["yes", "no"]:
			_arguments.fail("--refine is yes or no, not %s." % _arguments.text("refine"))
	var measured: bool = recipe.get("brdf") is String and CommandLine.is_measured(recipe["brdf"])
	if measured and (recipe["brdf"] as String).is_relative_path():
		# A recipe's files lie where the recipe lies.
		recipe["brdf"] = _arguments.path("recipe").get_base_dir().path_join(recipe["brdf"])
	if _arguments.has("brdf"):
		recipe["brdf"] = _arguments.brdf("brdf")
		measured = CommandLine.is_measured(recipe["brdf"])
	if _arguments.text("lobes") == "auto":
		recipe["lobes"] = "auto"
	for option: String in ["lobes", "seed", "threads"]:
		if _arguments.has(option) and _arguments.text(option) != "auto":
			recipe[option] = _arguments.integer(option, 0, -(1 << 31), (1 << 31) - 1)
	for option: String in ["alpha", "views"]:
		if _arguments.has(option):
			recipe[option] = Array(_arguments.numbers(option, 2, PackedFloat64Array([0, 0])))
	if _arguments.has("target"):
		recipe["target"] = _arguments.numbers("target", 1, PackedFloat64Array([0]))[0]
	if recipe.get("lobes") is String and recipe["lobes"] == "auto":
		recipe.get_or_add("environments", Array(ENVIRONMENTS))
	for key: String in ["brdf", "alpha", "lobes"]:
		# The widths of measurements are estimated.
		if key not in recipe and not (key == "alpha" and measured):
			_arguments.fail("--%s is missing." % key)
	return recipe


func _read_recipe(path: String) -> Dictionary:
	var json := JSON.new()
	var file := FileAccess.open(path, FileAccess.READ)
	if file == null:
		_arguments.fail(
			"%s: cannot be read (%s)." % [path, error_string(FileAccess.get_open_error())]
		)
	elif json.parse(file.get_as_text()) != OK:
		_arguments.fail(
			(
				"%s: is not JSON (line %d: %s)."
				% [path, json.get_error_line(), json.get_error_message()]
			)
		)
	elif json.data is not Dictionary:
		_arguments.fail("%s: a recipe is a JSON object." % path)
	else:
		return json.data
	return {}


func _check_outputs(out: String) -> void:
	_arguments.required("out")
	if not out.is_empty() and out.get_extension() not in ["res", "tres"]:
		_arguments.fail("%s: a lobe table is saved as .res or .tres." % out)
	for option: String in ["out", "export", "json"]:
		var file := _arguments.path(option)
		if not file.is_empty() and not DirAccess.dir_exists_absolute(file.get_base_dir()):
			_arguments.fail("%s: its folder does not exist." % file)


func _bake(recipe: Dictionary, out: String) -> void:
	var result := await NativeLibrary.run(
		NativeLibrary.create(&"LobeBaker"), recipe, "baking %s" % out.get_file(), self
	)
	if result.has("error"):
		_arguments.fail(result["error"])
		return
	var table := LobeTable.from_baked(result)
	_arguments.fail_if(AtomicFile.save_resource(table, out))
	if _arguments.has("export"):
		_arguments.fail_if(
			AtomicFile.save_json(table.to_json_dictionary(), _arguments.path("export"))
		)
	var summary := _summary(result, out)
	if result.has("clamped"):
		print(
			(
				"%s: %s negative or not finite; mirror images averaged, %.2f %% off their mean"
				% [
					table.brdf,
					Wording.count(result["clamped"], "number"),
					100.0 * (result["asymmetry"] as float),
				]
			)
		)
	if result.has("predicted_psnr"):
		print(
			(
				"%d lobes are the fewest with %s dB: the table alone has %.1f dB"
				% [result["lobes"], String.num(result["target"], 3), result["predicted_psnr"]]
			)
		)
	if _arguments.has("json"):
		_arguments.fail_if(AtomicFile.save_json(summary, _arguments.path("json")))
	if _arguments.error.is_empty():
		print(
			(
				"%s: %s (%s, %s), %d lobes, %d x %d views, %d bytes, %.2f s, peak memory %.0f MB"
				% [
					out,
					table.brdf,
					String.num(table.alpha.x, 6),
					String.num(table.alpha.y, 6),
					table.lobe_count,
					table.views.x,
					table.views.y,
					summary["bytes"],
					summary["seconds"],
					summary["peak_memory_mb"],
				]
			)
		)


func _summary(result: Dictionary, out: String) -> Dictionary:
	var summary := {
		"out": out,
		"brdf": result["brdf"],
		"alpha": LobeTable.plain_numbers(result["alpha"]),
		"lobes": result["lobes"],
		"views": [result["views"].x, result["views"].y],
		"method": result["method"],
		"refine": result["refine"],
		"placement": result["placement"],
		"bytes": (result["data"] as PackedByteArray).size(),
		"seconds": result["seconds"],
		"iterations": Array(result["iterations"]),
		"log_likelihood": Array(result["log_likelihood"]),
		"peak_memory_mb": _peak_memory_mb(),
	}
	for key: String in ["reach", "clamped", "asymmetry", "target", "predicted_psnr"]:
		if result.has(key):
			summary[key] = result[key]
	return summary


## The process's largest resident size, the engine's own 100 MB or so included; 0 where unknown.
func _peak_memory_mb() -> float:
	var status := FileAccess.open("/proc/self/status", FileAccess.READ)
	while status != null and not status.eof_reached():
		var line := status.get_line()
		if line.begins_with("VmHWM:"):
			return line.trim_prefix("VmHWM:").strip_edges().to_int() / 1024.0
	return 0.0
