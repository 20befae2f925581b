extends GdUnitTestSuite

var _nothing: Node


func test_error() -> void:
	assert_bool(true).is_true()
	_nothing.queue_free()


func test_error_after_await() -> void:
	assert_bool(true).is_true()
	await await_idle_frame()
	_nothing.queue_free()
	await await_idle_frame()
