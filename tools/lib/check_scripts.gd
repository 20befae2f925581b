extends SceneTree
## Loads every script of the project and ends with 1 if one does not compile.
##
## Prints one line for each error. Run after an import, as
## [code]godot --headless --path PROJECT --script check_scripts.gd[/code].

const TEST_SUITE := "GdUnitTestSuite"
## Third-party code, or the stand-in for it, that is copied here for the tests.
const FOREIGN := "res://addons/gdUnit4"


## Collects what the engine says about scripts; the engine may call it from any thread.
class ErrorLog:
	extends Logger

	var lines: PackedStringArray = []
	var _mutex := Mutex.new()

	func _log_error(
		_function: String,
		file: String,
		line: int,
		code: String,
		rationale: String,
		_editor_notify: bool,
		error_type: int,
		_script_backtraces: Array[ScriptBacktrace]
	) -> void:
		if error_type != ERROR_TYPE_SCRIPT:
			return
		_mutex.lock()
		lines.append("%s:%d: %s" % [file, line, code if rationale.is_empty() else rationale])
		_mutex.unlock()


func _initialize() -> void:
	var log := ErrorLog.new()
	OS.add_logger(log)
	var checked := 0
	var broken: PackedStringArray = []
	var has_suites := _global_class_exists(TEST_SUITE)
	for path in _scripts_below("res://"):
		if not has_suites and _is_suite(path):
			continue
		checked += 1
		var script := load(path) as Script
		if script == null or not script.can_instantiate():
			broken.append(path)
	OS.remove_logger(log)
	for line in log.lines:
		print(line)
	print("%d scripts checked, %d broken: %s" % [checked, broken.size(), ", ".join(broken)])
	quit(0 if broken.is_empty() and log.lines.is_empty() else 1)


## All .gd files below a folder, in order. Folders with .gdignore and hidden ones are left out, as
## the engine does.
func _scripts_below(folder: String) -> PackedStringArray:
	var found: PackedStringArray = []
	if folder == FOREIGN or FileAccess.file_exists(folder.path_join(".gdignore")):
		return found
	for file in DirAccess.get_files_at(folder):
		if file.get_extension() == "gd":
			found.append(folder.path_join(file))
	for child in DirAccess.get_directories_at(folder):
		if not child.begins_with("."):
			found.append_array(_scripts_below(folder.path_join(child)))
	return found


## Suites compile only where the test framework is installed.
func _is_suite(path: String) -> bool:
	return FileAccess.get_file_as_string(path).contains("extends " + TEST_SUITE)


func _global_class_exists(wanted: String) -> bool:
	for entry in ProjectSettings.get_global_class_list():
		if entry["class"] == wanted:
			return true
	return false
