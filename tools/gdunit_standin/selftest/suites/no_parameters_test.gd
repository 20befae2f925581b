extends GdUnitTestSuite

const NONE := []


func test_no_case(value: int, _test_parameters := NONE) -> void:
	assert_int(value).is_zero()
