extends GdUnitTestSuite
## The engine goes on to a good end, whatever has been left with the run time or done with it.

const SCRIPTS := [
	["forgotten_material"],
	["shared_material"],
]


func test_no_signal_and_no_error(name: String, _test_parameters := SCRIPTS) -> void:
	var output := []
	var script := "res://tests/runtime/scripts/%s.gd" % name
	var project := ProjectSettings.globalize_path("res://")
	var arguments := ["--headless", "--path", project, "--script", script]
	var status := OS.execute(OS.get_executable_path(), arguments, output, true)
	assert_int(status).append_failure_message("%s" % output).is_equal(0)
	assert_str(output[0]).not_contains("ERROR")
