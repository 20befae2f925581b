extends GdUnitTestSuite
## What the editor needs of the run time's scripts.

const FOLDER := "res://addons/lobelight/runtime"


func test_all_scripts_run_in_the_editor() -> void:
	# A script without @tool is not initialised there, and whoever calls it fails.
	var count := 0
	for file in DirAccess.get_files_at(FOLDER):
		if file.ends_with(".gd"):
			var script := load(FOLDER.path_join(file)) as GDScript
			assert_bool(script.is_tool()).append_failure_message(file).is_true()
			count += 1
	assert_int(count).is_greater(5)


func test_every_class_has_an_icon() -> void:
	var expected: Array[StringName] = [&"LobeTable", &"LobeMaterial3D", &"LobeEnvironment3D"]
	for entry in ProjectSettings.get_global_class_list():
		if entry["class"] in expected:
			var icon: String = entry["icon"]
			assert_bool(ResourceLoader.exists(icon)).append_failure_message(icon).is_true()
			expected.erase(entry["class"])
	assert_array(expected).is_empty()
