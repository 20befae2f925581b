extends GdUnitTestSuite


func test_forgets_a_node() -> void:
	assert_object(Node.new()).is_not_null()
