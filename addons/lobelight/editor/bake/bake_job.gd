@tool
extends RefCounted
## One bake: a table, what it is baked from, and the native task once it runs.

const NativeLibrary := preload("native_library.gd")
const Recipe := preload("bake_recipe.gd")

# Until then an estimate of the time left would be a guess.
const _LEAST_PROGRESS := 0.02
const _LEAST_SECONDS := 0.5

var table: LobeTable
var recipe: Recipe
## What went wrong, in a sentence.
var error := ""

var _task: RefCounted
var _started := 0


func _init(for_table: LobeTable, from_recipe: Recipe) -> void:
	table = for_table
	recipe = from_recipe


## Whether the work has begun; if not, [member error] says why.
func start() -> bool:
	error = NativeLibrary.get_problem()
	if error.is_empty():
		error = recipe.get_problem()
	if error:
		return false
	_task = NativeLibrary.create(&"LobeBaker")
	_started = Time.get_ticks_msec()
	if not _task.call("start", recipe.to_request()):
		error = _task.call("get_error")
		return false
	return true


func is_running() -> bool:
	return _task != null and _task.call("is_running")


func cancel() -> void:
	if _task != null:
		_task.call("cancel")


## From 0 to 1.
func get_progress() -> float:
	return _task.call("get_progress") if _task != null else 0.0


## Seconds that the work may still take, if it goes on as until now; negative as long as nobody
## knows.
func get_seconds_left() -> float:
	var progress := get_progress()
	var elapsed := 0.001 * (Time.get_ticks_msec() - _started)
	if progress < _LEAST_PROGRESS or elapsed < _LEAST_SECONDS:
		return -1.0
	return elapsed * (1.0 - progress) / progress


## What the work has made; empty if it failed, which sets [member error], or was cancelled.
func take_result() -> Dictionary:
	error = _task.call("get_error")
	var result: Dictionary = _task.call("get_result")
	_task = null
	return result


## How users know the table.
func get_title() -> String:
	if not table.resource_name.is_empty():
		return table.resource_name
	if not table.resource_path.is_empty() and not table.resource_path.contains("::"):
		return table.resource_path.get_file()
	return "the table"
