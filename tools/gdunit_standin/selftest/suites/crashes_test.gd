extends GdUnitTestSuite


func test_crashes() -> void:
	assert_bool(true).is_true()
	OS.crash("on purpose")
