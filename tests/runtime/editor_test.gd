extends GdUnitTestSuite
## What the editor needs of the run time's scripts.

const FOLDER := "res://addons/lobelight/runtime"


func test_all_scripts_run_in_the_editor() -> void:
	# A script without @tool is not initialised there, and whoever calls it fails.
	var scripts := _find_scripts(FOLDER)
	for path in scripts:
		var script := load(path) as GDScript
		assert_bool(script.is_tool()).append_failure_message(path).is_true()
	assert_int(scripts.size()).is_greater(25)


func _find_scripts(folder: String) -> PackedStringArray:
	var found: PackedStringArray = []
	for file in DirAccess.get_files_at(folder):
		if file.ends_with(".gd"):
			found.append(folder.path_join(file))
	for name in DirAccess.get_directories_at(folder):
		found.append_array(_find_scripts(folder.path_join(name)))
	return found


func test_every_class_has_an_icon() -> void:
	var expected: Array[StringName] = [&"LobeTable", &"LobeMaterial3D", &"LobeEnvironment3D"]
	for entry in ProjectSettings.get_global_class_list():
		if entry["class"] in expected:
			var icon: String = entry["icon"]
			assert_bool(ResourceLoader.exists(icon)).append_failure_message(icon).is_true()
			expected.erase(entry["class"])
	assert_array(expected).is_empty()
