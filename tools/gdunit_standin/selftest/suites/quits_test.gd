extends GdUnitTestSuite


func test_quits() -> void:
	assert_bool(true).is_true()
	get_tree().quit(0)
	await await_millis(1000)
