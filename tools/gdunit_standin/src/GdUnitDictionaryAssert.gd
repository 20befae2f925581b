class_name GdUnitDictionaryAssert
extends GdUnitAssert
## Assertions on a Dictionary.


func _init(record: Record, current: Variant) -> void:
	super(record, current)
	_require_type([TYPE_DICTIONARY])


func is_empty() -> GdUnitDictionaryAssert:
	return _check(_current is Dictionary and _value().is_empty(), "expected an empty dictionary")


func is_not_empty() -> GdUnitDictionaryAssert:
	return _check(_current is Dictionary and not _value().is_empty(), "expected entries")


func has_size(size: int) -> GdUnitDictionaryAssert:
	return _check(_current is Dictionary and _value().size() == size, "expected %d entries" % size)


func contains_keys(...expected: Array) -> GdUnitDictionaryAssert:
	var keys := _spread(expected)
	return _check(
		_current is Dictionary and _value().has_all(keys), "expected the keys %s" % _text(keys)
	)


func not_contains_keys(...expected: Array) -> GdUnitDictionaryAssert:
	var keys := _spread(expected)
	return _check(
		_current is Dictionary and not keys.any(_value().has),
		"expected none of the keys %s" % _text(keys)
	)


func contains_key_value(key: Variant, value: Variant) -> GdUnitDictionaryAssert:
	return _check(
		_current is Dictionary and _value().has(key) and Equality.equal(_value()[key], value),
		"expected %s: %s" % [_text(key), _text(value)]
	)


func _value() -> Dictionary:
	return _current if _current is Dictionary else {}


static func _spread(values: Array) -> Array:
	return values[0] if values.size() == 1 and values[0] is Array else values
