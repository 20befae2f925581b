class_name GdUnitFileAssert
extends GdUnitAssert
## Assertions on a file, given by its path.


func _init(record: Record, current: Variant) -> void:
	super(record, current)
	_require_type([TYPE_STRING, TYPE_STRING_NAME])


func exists() -> GdUnitFileAssert:
	return _check(_current != null and FileAccess.file_exists(str(_current)), "expected a file")


func is_file() -> GdUnitFileAssert:
	return exists()
