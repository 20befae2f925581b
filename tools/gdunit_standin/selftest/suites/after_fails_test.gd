extends GdUnitTestSuite


func after() -> void:
	push_error("not expected")


func test_passes() -> void:
	assert_bool(true).is_true()
