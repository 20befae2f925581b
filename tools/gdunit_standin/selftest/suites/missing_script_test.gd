extends GdUnitTestSuite

const Missing := preload("res://tests/no_such_file.gd")


func test_nothing() -> void:
	assert_object(Missing.new()).is_not_null()
