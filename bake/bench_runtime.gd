extends SceneTree
## `./dev bench runtime`: what the addon costs in a running game, in parts that `--what` names, each
## beside something ordinary of the same run. `--scale N` divides the sides of pictures and maps;
## `--rounds N`; `--json FILE`. Without `--what` it is updates, see runtime/updates.gd.

const PARTS: Dictionary[String, Script] = {
	"first-light": preload("runtime/first_light.gd"),
	"updates": preload("runtime/updates.gd"),
	"idle": preload("runtime/idle.gd"),
	"properties": preload("runtime/properties.gd"),
	"memory": preload("runtime/memory.gd"),
	"shaders": preload("runtime/shaders.gd"),
}
const _MOST_SCALE := 16
const _MOST_ROUNDS := 100

var _arguments := CommandLine.new("bench runtime", ["scale", "rounds", "what", "json"])


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	var scale := _arguments.integer("scale", 1, 1, _MOST_SCALE)
	var rounds := _arguments.integer("rounds", 8, 1, _MOST_ROUNDS)
	var parts := _arguments.text("what", "updates").split(",")
	for part in parts:
		if part not in PARTS:
			_arguments.fail(
				(
					"--what is made of %s, not '%s'."
					% [", ".join(PackedStringArray(PARTS.keys())), part]
				)
			)
	var json := _arguments.path("json") if _arguments.has("json") else ""
	if _arguments.error.is_empty() and DisplayServer.get_name() == "headless":
		_arguments.fail("the engine runs without a renderer.")
	if _arguments.error.is_empty():
		root.size = Vector2i(64, 64)
		var results: Array[Dictionary] = []
		for part in parts:
			if _arguments.error.is_empty():
				results.append_array(await _measure(part, scale, rounds))
		if _arguments.error.is_empty() and not json.is_empty():
			_arguments.fail_if(AtomicFile.save_json(results, json))
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
	quit(0 if _arguments.error.is_empty() else 1)


func _measure(part: String, scale: int, rounds: int) -> Array[Dictionary]:
	var measured: RefCounted = PARTS[part].new()
	var rows: Array[Dictionary] = await measured.measure(self, scale, rounds)
	_arguments.fail_if(measured.error)
	if _arguments.has("what"):
		for row in rows:
			row["what"] = part
	return rows
