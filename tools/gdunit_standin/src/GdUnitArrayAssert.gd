class_name GdUnitArrayAssert
extends GdUnitAssert
## Assertions on an Array or a packed array. Expected elements are given one by one or as an array.


func _init(record: Record, current: Variant) -> void:
	super(record, current)
	if current != null and not _is_array(current):
		_report("%s cannot check a %s" % [_class_name(), type_string(typeof(current))])


## Same elements in the same order; a packed array equals an Array of the same elements.
func is_equal(expected: Variant) -> GdUnitArrayAssert:
	return _check(_is_array(expected) and _same_as(expected), "expected %s" % _text(expected))


func is_not_equal(expected: Variant) -> GdUnitArrayAssert:
	return _check(
		_is_array(expected) and not _same_as(expected), "expected other than %s" % _text(expected)
	)


func is_empty() -> GdUnitArrayAssert:
	return _check(_is_array(_current) and _elements().is_empty(), "expected an empty array")


func is_not_empty() -> GdUnitArrayAssert:
	return _check(_is_array(_current) and not _elements().is_empty(), "expected elements")


func has_size(size: int) -> GdUnitArrayAssert:
	return _check(_is_array(_current) and _elements().size() == size, "expected %d elements" % size)


func contains(...expected: Array) -> GdUnitArrayAssert:
	var wanted := _spread(expected)
	return _check(
		_is_array(_current) and wanted.all(_has), "expected to contain %s" % _text(wanted)
	)


func not_contains(...expected: Array) -> GdUnitArrayAssert:
	var unwanted := _spread(expected)
	return _check(
		_is_array(_current) and not unwanted.any(_has),
		"expected to contain none of %s" % _text(unwanted)
	)


func contains_exactly(...expected: Array) -> GdUnitArrayAssert:
	var wanted := _spread(expected)
	return _check(_same_as(wanted), "expected exactly %s" % _text(wanted))


func contains_exactly_in_any_order(...expected: Array) -> GdUnitArrayAssert:
	var wanted := _spread(expected)
	return _check(
		_is_array(_current) and _same_elements(wanted), "expected in any order %s" % _text(wanted)
	)


func _elements() -> Array:
	return Array(_current) if _is_array(_current) else []


func _same_as(expected: Variant) -> bool:
	return _is_array(_current) and Equality.equal(_elements(), Array(expected))


func _same_elements(wanted: Array) -> bool:
	var rest := _elements().duplicate()
	for element: Variant in wanted:
		var index := rest.find_custom(Equality.equal.bind(element))
		if index < 0:
			return false
		rest.remove_at(index)
	return rest.is_empty()


func _has(element: Variant) -> bool:
	return _elements().any(Equality.equal.bind(element))


static func _is_array(value: Variant) -> bool:
	return typeof(value) >= TYPE_ARRAY


static func _spread(values: Array) -> Array:
	return Array(values[0]) if values.size() == 1 and _is_array(values[0]) else values
