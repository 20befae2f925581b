class_name GdUnitObjectAssert
extends GdUnitAssert
## Assertions on an object.


func _init(record: Record, current: Variant) -> void:
	super(record, current)
	if current is bool or current is int or current is float or current is String:
		_report("%s cannot check a %s" % [_class_name(), type_string(typeof(current))])


func is_same(expected: Variant) -> GdUnitObjectAssert:
	return _check(is_same(_current, expected), "expected the same object as %s" % _text(expected))


func is_not_same(expected: Variant) -> GdUnitObjectAssert:
	return _check(
		not is_same(_current, expected), "expected another object than %s" % _text(expected)
	)


func is_instanceof(type: Variant) -> GdUnitObjectAssert:
	return _check(
		_current != null and is_instance_of(_current, type), "expected an instance of %s" % type
	)


func is_not_instanceof(type: Variant) -> GdUnitObjectAssert:
	return _check(not is_instance_of(_current, type), "expected no instance of %s" % type)
