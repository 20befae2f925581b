extends GdUnitTestSuite
## The engine ends well and leaks nothing when it is closed while lights are being made.

const SCRIPT_PATH := "res://tests/render/scripts/left_running.gd"


func test_no_error_and_no_leak() -> void:
	var arguments := [
		"--verbose",
		"--path",
		ProjectSettings.globalize_path("res://"),
		"--audio-driver",
		"Dummy",
		"--rendering-method",
		RenderingServer.get_current_rendering_method(),
		"--script",
		SCRIPT_PATH
	]
	var output := []
	var status := OS.execute(OS.get_executable_path(), arguments, output, true)
	assert_int(status).append_failure_message("%s" % output).is_equal(0)
	for line: String in (output[0] as String).split("\n"):
		for word: String in ["ERROR", "leaked", "still in use", "Orphan"]:
			assert_str(line).not_contains(word)
