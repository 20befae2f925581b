extends GdUnitTestSuite


func test_nothing() -> void:
	var number: int = "text"
	assert_int(number).is_zero()
