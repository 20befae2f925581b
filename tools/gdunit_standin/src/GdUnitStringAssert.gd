class_name GdUnitStringAssert
extends GdUnitAssert
## Assertions on a String or StringName.


func _init(record: Record, current: Variant) -> void:
	super(record, current)
	_require_type([TYPE_STRING, TYPE_STRING_NAME])


func is_empty() -> GdUnitStringAssert:
	return _check(_is_text() and _value().is_empty(), "expected an empty string")


func is_not_empty() -> GdUnitStringAssert:
	return _check(_is_text() and not _value().is_empty(), "expected a string with contents")


func contains(expected: String) -> GdUnitStringAssert:
	return _check(
		_is_text() and _value().contains(expected), "expected to contain %s" % _text(expected)
	)


func not_contains(expected: String) -> GdUnitStringAssert:
	return _check(
		_is_text() and not _value().contains(expected),
		"expected not to contain %s" % _text(expected)
	)


func contains_ignoring_case(expected: String) -> GdUnitStringAssert:
	return _check(
		_is_text() and _value().containsn(expected), "expected to contain %s" % _text(expected)
	)


func starts_with(expected: String) -> GdUnitStringAssert:
	return _check(
		_is_text() and _value().begins_with(expected), "expected to start with %s" % _text(expected)
	)


func ends_with(expected: String) -> GdUnitStringAssert:
	return _check(
		_is_text() and _value().ends_with(expected), "expected to end with %s" % _text(expected)
	)


func has_length(length: int) -> GdUnitStringAssert:
	return _check(_is_text() and _value().length() == length, "expected %d characters" % length)


func _is_text() -> bool:
	return _current is String or _current is StringName


func _value() -> String:
	return str(_current)
