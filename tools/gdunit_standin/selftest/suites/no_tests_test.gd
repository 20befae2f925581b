extends GdUnitTestSuite


func helper() -> void:
	pass
