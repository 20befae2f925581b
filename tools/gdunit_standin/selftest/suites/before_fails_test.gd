extends GdUnitTestSuite


func before() -> void:
	assert_bool(false).is_true()


func test_would_pass() -> void:
	assert_bool(true).is_true()
