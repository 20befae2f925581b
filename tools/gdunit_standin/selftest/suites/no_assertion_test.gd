extends GdUnitTestSuite


func test_nothing() -> void:
	var sum := 1 + 1
	sum += 1


func test_nothing_after_await() -> void:
	await await_idle_frame()
