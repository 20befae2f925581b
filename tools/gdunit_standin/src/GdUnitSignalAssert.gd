class_name GdUnitSignalAssert
extends GdUnitAssert
## Assertions on a signal of an object, from the moment of the check on. To be awaited.

var _milliseconds := 2000
var _emissions: Array[Array] = []


func _init(record: Record, emitter: Object) -> void:
	super(record, emitter)
	_line = Record.line_in_suite()


## How long to wait, in milliseconds.
func wait_until(timeout: int) -> GdUnitSignalAssert:
	_milliseconds = timeout
	return self


func is_emitted(signal_name: String, args: Array = []) -> GdUnitSignalAssert:
	var seen := await _wait_for(signal_name, args)
	return _check(seen, "expected the signal %s%s" % [signal_name, args])


func is_not_emitted(signal_name: String, args: Array = []) -> GdUnitSignalAssert:
	var seen := await _wait_for(signal_name, args)
	return _check(not seen, "expected no signal %s%s" % [signal_name, args])


func is_signal_exists(signal_name: String) -> GdUnitSignalAssert:
	return _check(_emitter().has_signal(signal_name), "expected a signal named %s" % signal_name)


func _emitter() -> Object:
	return _current


func _wait_for(signal_name: String, args: Array) -> bool:
	if not is_instance_valid(_current) or not _emitter().has_signal(signal_name):
		_report("there is no signal %s" % signal_name)
		return false
	var collect := func(...values: Array) -> void: _emissions.append(values)
	_emitter().connect(signal_name, collect)
	var deadline := Time.get_ticks_msec() + _milliseconds
	while not _is_matched(args) and Time.get_ticks_msec() < deadline:
		await (Engine.get_main_loop() as SceneTree).process_frame
	if is_instance_valid(_current):
		_emitter().disconnect(signal_name, collect)
	return _is_matched(args)


func _is_matched(args: Array) -> bool:
	return _emissions.any(Equality.equal.bind(args))
