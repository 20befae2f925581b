extends GdUnitAssert
## What assertions on int and float share. A comparison with NaN never holds.


func is_less(expected: float) -> GdUnitAssert:
	return _check(_is_number() and _current < expected, "expected less than %s" % expected)


func is_less_equal(expected: float) -> GdUnitAssert:
	return _check(_is_number() and _current <= expected, "expected at most %s" % expected)


func is_greater(expected: float) -> GdUnitAssert:
	return _check(_is_number() and _current > expected, "expected more than %s" % expected)


func is_greater_equal(expected: float) -> GdUnitAssert:
	return _check(_is_number() and _current >= expected, "expected at least %s" % expected)


## Both ends belong to the range.
func is_between(from: float, to: float) -> GdUnitAssert:
	return _check(
		_is_number() and _current >= from and _current <= to, "expected %s to %s" % [from, to]
	)


func is_negative() -> GdUnitAssert:
	return _check(_is_number() and _current < 0, "expected a negative number")


func is_not_negative() -> GdUnitAssert:
	return _check(_is_number() and _current >= 0, "expected zero or more")


func is_zero() -> GdUnitAssert:
	return _check(_is_number() and _current == 0, "expected 0")


func is_not_zero() -> GdUnitAssert:
	return _check(_is_number() and _current != 0, "expected other than 0")


func is_in(expected: Array) -> GdUnitAssert:
	return _check(expected.has(_current), "expected one of %s" % _text(expected))


func is_not_in(expected: Array) -> GdUnitAssert:
	return _check(not expected.has(_current), "expected none of %s" % _text(expected))


func _is_number() -> bool:
	return _current is int or (_current is float and not is_nan(_current))
