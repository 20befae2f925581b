extends GdUnitTestSuite
## Where an export has left out what tells places, two worlds show one light, and one error says
## why.

const PROJECT := "user://without_probes"
const RUN_TIME := "res://addons/lobelight/runtime"
const SCRIPT_PATH := "res://tests/render/scripts/two_worlds.gd"
const CONFIG := 'config_version=5\n[application]\nconfig/name="without probes"\n'


func after_test() -> void:
	_remove(PROJECT)


func test_two_worlds_have_one_light() -> void:
	_make_project()
	var lines := _run_project()
	# That of the node that came last, for all.
	assert_array(JSON.parse_string(lines.get("shown", "[]"))).is_equal([1.0, 1.0, 0.5, 0.5])
	var errors: Array = JSON.parse_string(lines.get("errors", "[]"))
	assert_int(errors.size()).append_failure_message("%s" % [errors]).is_equal(1)
	assert_str(errors[0]).contains("This export leaves out probes and lights of several worlds")


func test_nothing_is_missing_otherwise() -> void:
	_make_project()
	_copy(RUN_TIME.path_join("probes"), PROJECT.path_join("addons/lobelight/runtime/probes"))
	var lines := _run_project()
	assert_array(JSON.parse_string(lines.get("errors", '["none"]'))).is_empty()
	var shown: Array = JSON.parse_string(lines.get("shown", "[]"))
	assert_array(shown.slice(0, 2)).is_equal([0.25, 1.0])


# With the run time, but for its probes.
func _make_project() -> void:
	DirAccess.make_dir_recursive_absolute(PROJECT.path_join(".godot"))
	var config := FileAccess.open(PROJECT.path_join("project.godot"), FileAccess.WRITE)
	config.store_string(CONFIG)
	config.close()
	_copy(RUN_TIME, PROJECT.path_join("addons/lobelight/runtime"), ["probes"])
	_copy("res://addons/lobelight/icons", PROJECT.path_join("addons/lobelight/icons"))
	_copy("res://addons/lobelight/tables", PROJECT.path_join("addons/lobelight/tables"))
	DirAccess.copy_absolute(SCRIPT_PATH, PROJECT.path_join("two_worlds.gd"))
	# The names of classes, without those of what is not there.
	var classes := ConfigFile.new()
	var path := ".godot/global_script_class_cache.cfg"
	classes.load("res://".path_join(path))
	var kept: Array[Dictionary] = []
	for entry: Dictionary in classes.get_value("", "list"):
		var file: String = entry.path
		if FileAccess.file_exists(PROJECT.path_join(file.trim_prefix("res://"))):
			kept.append(entry)
	classes.set_value("", "list", kept)
	classes.save(PROJECT.path_join(path))


# What the script prints, by its first words.
func _run_project() -> Dictionary[String, String]:
	var arguments := [
		"--path",
		ProjectSettings.globalize_path(PROJECT),
		"--audio-driver",
		"Dummy",
		"--rendering-method",
		RenderingServer.get_current_rendering_method(),
		"--script",
		"res://two_worlds.gd"
	]
	var output := []
	var status := OS.execute(OS.get_executable_path(), arguments, output, true)
	assert_int(status).append_failure_message("%s" % output).is_equal(0)
	var lines: Dictionary[String, String] = {}
	for line: String in (output[0] as String).split("\n"):
		var parts := line.split(": ", true, 1)
		if parts.size() == 2:
			lines[parts[0]] = parts[1]
	return lines


func _copy(from: String, to: String, without: PackedStringArray = []) -> void:
	DirAccess.make_dir_recursive_absolute(to)
	for file in DirAccess.get_files_at(from):
		DirAccess.copy_absolute(from.path_join(file), to.path_join(file))
	for folder in DirAccess.get_directories_at(from):
		if folder not in without:
			_copy(from.path_join(folder), to.path_join(folder))


func _remove(folder: String) -> void:
	var directory := DirAccess.open(folder)
	if directory == null:
		return
	directory.include_hidden = true
	for file in directory.get_files():
		directory.remove(file)
	for each in directory.get_directories():
		_remove(folder.path_join(each))
	DirAccess.remove_absolute(folder)
