extends Node


func test_nothing() -> void:
	pass
