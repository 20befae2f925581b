extends GdUnitTestSuite


func test_push_error() -> void:
	assert_bool(true).is_true()
	push_error("not expected")


func test_engine_error() -> void:
	assert_object(Image.create_empty(0, 0, false, Image.FORMAT_L8)).is_not_null()


func test_error_on_a_thread() -> void:
	var thread := Thread.new()
	thread.start(func() -> void: push_error("from a thread"))
	thread.wait_to_finish()
	assert_bool(true).is_true()


func test_error_in_a_deferred_call() -> void:
	(func() -> void: push_error("late")).call_deferred()
	assert_bool(true).is_true()
