class_name GdUnitBoolAssert
extends GdUnitAssert
## Assertions on a bool.


func _init(record: Record, current: Variant) -> void:
	super(record, current)
	_require_type([TYPE_BOOL])


func is_true() -> GdUnitBoolAssert:
	return _check(_current is bool and _current, "expected true")


func is_false() -> GdUnitBoolAssert:
	return _check(_current is bool and not _current, "expected false")
