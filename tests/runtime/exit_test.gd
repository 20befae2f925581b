extends GdUnitTestSuite
## The engine ends well, whatever has been left with the run time.

const SCRIPT := "res://tests/runtime/scripts/forgotten_material.gd"


func test_with_a_material_that_nobody_took_back() -> void:
	var output := []
	var arguments := ["--headless", "--path", ProjectSettings.globalize_path("res://")]
	var status := OS.execute(
		OS.get_executable_path(), arguments + ["--script", SCRIPT], output, true
	)
	assert_int(status).append_failure_message("%s" % output).is_equal(0)
	assert_str(output[0]).not_contains("ERROR")
