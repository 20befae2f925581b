extends SceneTree
## Many comparisons in one run of the engine, for `./dev accuracy` and `./dev report`.
##
## `--list FILE` is JSON: {"env", "brdf", "alpha", "methods", "size", "samples", "timing_rounds",
## "out"} for each [Comparison], paths absolute, with "room" instead of "env" in a [CompareRoom],
## and where wanted "timing_size", "tolerant" and
## "stage", the properties of [ComparisonStage] that differ from the usual: {"filter",
## "pyramid_size", "table_views", "toral_coverage", "toral_views", "fis_bias", "light_form",
## "max_sources", "fis_form"}. Those of one map and
## stage follow one another best, since a map's pyramid is kept while the next comparison needs it;
## tables are kept throughout. After each, a line "compared INDEX" goes to standard output.

var _arguments := CommandLine.new("accuracy", ["list"])
var _stage: ComparisonStage
var _stage_key := ""
var _tables: Dictionary[String, LobeTable] = {}


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	_arguments.required("list")
	_arguments.fail_if(NativeLibrary.error())
	var list: Variant = null
	if _arguments.error.is_empty():
		list = JSON.parse_string(FileAccess.get_file_as_string(_arguments.path("list")))
	if list is Array:
		var entries: Array = list
		for index in entries.size():
			await _compare(entries[index])
			if not _arguments.error.is_empty():
				break
			print("compared %d" % index)
	else:
		_arguments.fail("%s: not a list of comparisons." % _arguments.text("list"))
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
	_stage = null
	quit(0 if _arguments.error.is_empty() else 1)


func _compare(entry: Dictionary) -> void:
	var comparison := Comparison.new()
	var is_room := entry.has("room")
	comparison.environment_path = entry["room" if is_room else "env"]
	comparison.brdf = entry["brdf"]
	comparison.alpha = PackedFloat64Array(entry["alpha"] as Array)
	comparison.names = PackedStringArray(entry["methods"] as Array)
	comparison.size = int(entry["size"] as float)
	comparison.samples = int(entry["samples"] as float)
	comparison.timing_rounds = int(entry["timing_rounds"] as float)
	comparison.timing_size = entry.get("timing_size", Comparison.TIMING_SIZE)
	comparison.out = entry["out"]
	comparison.tolerant = entry.get("tolerant", false)
	if not comparison.tolerant:
		for method in comparison.names:
			_arguments.fail_if(CompareMethods.error(method, is_room))
	await _light(comparison.environment_path, is_room, entry.get("stage", {}))
	comparison.stage = _stage
	if _arguments.error.is_empty():
		_arguments.fail_if(await comparison.run())


func _light(path: String, is_room: bool, properties: Dictionary) -> void:
	var key := "%s %s" % [path, properties]
	if key == _stage_key:
		return
	_stage = null
	# This may be called at the end of the comparison before, which still holds its stage; two lights
	# cannot share the world.
	await process_frame
	_stage = ComparisonStage.new(self)
	if is_room:
		_stage.room = CompareRoom.read(path)
		_arguments.fail_if(_stage.room.get_error())
	else:
		var panorama := Comparison.load_panorama(path)
		_arguments.fail_if(panorama.get("error", ""))
		_stage.panorama = panorama.get("texture")
	_stage.tables = _tables
	for property: String in properties:
		var value: Variant = properties[property]
		if value is Array:
			value = Vector2i(int(value[0] as float), int(value[1] as float))
		_stage.set(property, value)
	_stage_key = key
