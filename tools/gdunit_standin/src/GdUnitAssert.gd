class_name GdUnitAssert
extends RefCounted
## What all assertions share. Each check counts as one assertion of the running test.

const Record := preload("res://addons/gdUnit4/src/standin/test_record.gd")
const Equality := preload("res://addons/gdUnit4/src/standin/equality.gd")

const _LONGEST_VALUE := 400

var _record: Record
var _current: Variant
var _override := ""
var _appendix := ""
## The line that made the assertion, for checks that end after an await.
var _line := 0


func _init(record: Record, current: Variant) -> void:
	_record = record
	_current = current


## Replaces the message of the checks that follow.
func override_failure_message(message: String) -> GdUnitAssert:
	_override = message
	return self


## Adds a line to the message of the checks that follow.
func append_failure_message(message: String) -> GdUnitAssert:
	_appendix = message
	return self


func is_null() -> GdUnitAssert:
	return _check(_current == null, "expected null")


func is_not_null() -> GdUnitAssert:
	return _check(_current != null, "expected a value")


## Same type and same value; arrays, dictionaries and objects are compared by their contents.
func is_equal(expected: Variant) -> GdUnitAssert:
	return _check(Equality.equal(_current, expected), "expected %s" % _text(expected))


func is_not_equal(expected: Variant) -> GdUnitAssert:
	return _check(
		not Equality.equal(_current, expected), "expected other than %s" % _text(expected)
	)


func _check(holds: bool, expectation: String) -> GdUnitAssert:
	if holds:
		_record.count_assertion()
	else:
		_report(_override if _override else "%s, got %s" % [expectation, _text(_current)])
	return self


func _report(message: String) -> void:
	_record.count_assertion()
	_record.fail("%s\n%s" % [message, _appendix] if _appendix else message, _line)


func _require_type(allowed: Array) -> void:
	if _current != null and not typeof(_current) in allowed:
		_report("%s cannot check a %s" % [_class_name(), type_string(typeof(_current))])


func _class_name() -> String:
	return str((get_script() as Script).get_global_name())


static func _text(value: Variant) -> String:
	var text := var_to_str(value) if value is String else str(value)
	return text if text.length() <= _LONGEST_VALUE else text.left(_LONGEST_VALUE) + " …"
