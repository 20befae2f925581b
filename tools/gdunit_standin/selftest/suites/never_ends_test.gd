extends GdUnitTestSuite

signal never


func test_waits(_timeout := 300) -> void:
	assert_bool(true).is_true()
	await never


func test_comes_back_late(_timeout := 100) -> void:
	assert_bool(true).is_true()
	await await_millis(400)
	fail("too late to count for another test")


func test_goes_on() -> void:
	await await_millis(600)
	assert_bool(true).is_true()
