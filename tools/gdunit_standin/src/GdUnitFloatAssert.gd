class_name GdUnitFloatAssert
extends "res://addons/gdUnit4/src/standin/number_assert.gd"
## Assertions on a float.


func _init(record: Record, current: Variant) -> void:
	super(record, current)
	_require_type([TYPE_FLOAT])


## Within [param approx] of [param expected], the ends included.
func is_equal_approx(expected: float, approx: float) -> GdUnitFloatAssert:
	return _check(
		_is_number() and _current >= expected - approx and _current <= expected + approx,
		"expected %s ± %s" % [expected, approx]
	)
