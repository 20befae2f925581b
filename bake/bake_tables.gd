extends SceneTree
## `./dev bake-tables`: fits the ready sets of tables over all widths, or checks those that exist.

const OPTIONS: PackedStringArray = [
	"brdf",
	"lobes",
	"views",
	"widths",
	"out",
	"check",
	"threads",
	"seed",
	"json",
]
const FOLDER := "res://addons/lobelight/tables"
const SHIPPED: PackedStringArray = ["ward", "ggx", "charlie", "coat"]
const ALL: PackedStringArray = ["ward", "ward_bounded", "ggx", "charlie", "coat"]
const FIRST_WIDTH := 0.005
const LAST_WIDTH := 1.0
## Lobes of layers over a material. Each layer has one width, and is smooth or reflects little: few
## lobes and tables do. By the sets' names: [code][BRDF, first width, last width, count][/code].
const LAYERS: Dictionary[String, Array] = {
	"charlie": ["charlie", 0.04, LAST_WIDTH, 10],
	# The widths of Godot's clear coats, as far as pyramids tell them apart.
	"coat": ["ggx", FIRST_WIDTH, 0.1, 13],
}
const LAYER_LOBES := 4
## Of how many tables a check fits one again.
const CHECK_STRIDE := 12
const SavedForm := preload("res://addons/lobelight/runtime/table/saved_form.gd")

var _arguments := CommandLine.new("bake-tables", OPTIONS)


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	_recipe(SHIPPED[0])
	var folder := _folder()
	var summaries: Array[Dictionary] = []
	_arguments.fail_if(NativeLibrary.error())
	for brdf in _brdfs():
		if not _arguments.error.is_empty():
			break
		var recipe := _recipe(brdf)
		var path := folder.path_join("%s_%d.res" % [brdf, recipe["lobes"]])
		if _arguments.has("check"):
			summaries.append(_check(path))
		else:
			summaries.append(await _bake(recipe, path))
	if _arguments.error.is_empty() and _arguments.has("json"):
		_arguments.fail_if(AtomicFile.save_json(summaries, _arguments.path("json")))
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
		quit(1)
		return
	quit(0)


func _brdfs() -> PackedStringArray:
	var brdf := _arguments.text("brdf")
	if brdf.is_empty():
		return SHIPPED
	if brdf == "all":
		return ALL
	if brdf not in ALL:
		_arguments.fail("--brdf must be all or one of %s, not %s." % [", ".join(ALL), brdf])
	return [brdf]


func _recipe(name: String) -> Dictionary:
	var is_layer := LAYERS.has(name)
	var usual: Array = LAYERS.get(name, [name, FIRST_WIDTH, LAST_WIDTH, 21])
	var first: float = usual[1]
	var last: float = usual[2]
	var usual_views := PackedFloat64Array([16, 1] if is_layer else [16, 8])
	var count := _arguments.integer("widths", usual[3], 2, LobeTableSet.MAX_WIDTHS)
	var widths := []
	for i in count:
		var width := first * pow(last / first, i / (count - 1.0))
		# A few digits, so that the last bit of an engine's pow() does not matter.
		widths.append(String.num(width, 7).to_float())
	return {
		"brdf": usual[0],
		"widths": widths,
		"lobes":
		_arguments.integer("lobes", LAYER_LOBES if is_layer else 8, 1, LobeTable.MAX_LOBES),
		"views": Array(_arguments.numbers("views", 2, usual_views)),
		"seed": _arguments.integer("seed", 0, 0, (1 << 31) - 1),
		"threads": _arguments.integer("threads", 0, 0, 1024),
	}


func _folder() -> String:
	var folder := _arguments.path("out")
	if folder.is_empty():
		folder = ProjectSettings.globalize_path(FOLDER)
		DirAccess.make_dir_recursive_absolute(folder)
	elif not DirAccess.dir_exists_absolute(folder):
		_arguments.fail("%s: is not a folder." % folder)
	var json := _arguments.path("json")
	if not json.is_empty() and not DirAccess.dir_exists_absolute(json.get_base_dir()):
		_arguments.fail("%s: its folder does not exist." % json)
	return folder


func _bake(recipe: Dictionary, path: String) -> Dictionary:
	var result := await NativeLibrary.run(
		NativeLibrary.create(&"LobeBaker"), recipe, "fitting %s" % path.get_file(), self
	)
	if result.has("error"):
		_arguments.fail(result["error"])
		return {}
	var tables := LobeTableSet.from_baked(result)
	_arguments.fail_if(AtomicFile.save_resource(tables, path))
	if not _arguments.error.is_empty():
		return {}
	var bytes := FileAccess.get_file_as_bytes(path).size()
	print(
		(
			"%s: %s, %d lobes, %d widths, %d tables of %d x %d views, %d bytes, %.0f s"
			% [
				path,
				tables.brdf,
				tables.lobe_count,
				tables.widths.size(),
				tables.get_table_count(),
				tables.views.x,
				tables.views.y,
				bytes,
				result["seconds"],
			]
		)
	)
	return {"file": path, "bytes": bytes, "seconds": result["seconds"]}


func _check(path: String) -> Dictionary:
	var tables: LobeTableSet = null
	SavedForm.checks_all = true
	if FileAccess.file_exists(path):
		tables = ResourceLoader.load(path) as LobeTableSet
	if tables == null:
		_arguments.fail("%s: is not a set of tables." % path)
		return {}
	if not tables.get_problem().is_empty():
		_arguments.fail("%s: %s" % [path, tables.get_problem()])
		return {}
	var recipe := {
		"brdf": tables.brdf,
		"widths": Array(tables.widths),
		"lobes": tables.lobe_count,
		"views": tables.views,
		"seed": tables.seed,
		"threads": _arguments.integer("threads", 0, 0, 1024),
	}
	var baker := NativeLibrary.create(&"LobeBaker")
	var data := tables.image.get_data()
	var line := ProgressLine.new("checking %s" % path.get_file())
	var numbers := range(0, tables.get_table_count(), CHECK_STRIDE)
	var different: Array[int] = []
	for index: int in numbers.size():
		var table: int = numbers[index]
		var again: Dictionary = baker.call("refit", recipe, data, table)
		if again.has("error"):
			_arguments.fail("%s: %s" % [path, again["error"]])
			return {}
		var fitted: PackedByteArray = again["data"]
		if fitted != tables.get_table_data(table):
			different.append(table)
		line.show((index + 1.0) / numbers.size())
	line.finish()
	if not different.is_empty():
		_arguments.fail(
			(
				"%s: %d of the %d tables that were fitted again differ, the first is number %d."
				% [path, different.size(), numbers.size(), different[0]]
			)
		)
	else:
		print("%s: %d tables fitted again, all equal" % [path, numbers.size()])
	return {"file": path, "fitted": numbers.size(), "different": different}
