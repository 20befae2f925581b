class_name GdUnitIntAssert
extends "res://addons/gdUnit4/src/standin/number_assert.gd"
## Assertions on an int.


func _init(record: Record, current: Variant) -> void:
	super(record, current)
	_require_type([TYPE_INT])


func is_even() -> GdUnitIntAssert:
	return _check(_current is int and _current % 2 == 0, "expected an even number")


func is_odd() -> GdUnitIntAssert:
	return _check(_current is int and _current % 2 != 0, "expected an odd number")
