class_name GdUnitGodotErrorAssert
extends GdUnitAssert
## Assertions on what a Callable reports to the engine's log. To be awaited.
##
## An expected error is taken out of the log, so that it does not fail the test; one that was not
## expected stays and does.

const ErrorWatch := preload("res://addons/gdUnit4/src/standin/error_watch.gd")

var _watch: ErrorWatch


func _init(record: Record, watch: ErrorWatch, callable: Callable) -> void:
	super(record, callable)
	_line = Record.line_in_suite()
	_watch = watch


## Nothing at all is reported, not even a warning.
func is_success() -> GdUnitGodotErrorAssert:
	var reports := await _reports_of_call()
	return _check_reports(reports.is_empty(), "expected no report", reports)


func is_push_error(expected: String) -> GdUnitGodotErrorAssert:
	return await _is_reported(Logger.ERROR_TYPE_ERROR, expected)


func is_push_warning(expected: String) -> GdUnitGodotErrorAssert:
	return await _is_reported(Logger.ERROR_TYPE_WARNING, expected)


func is_runtime_error(expected: String) -> GdUnitGodotErrorAssert:
	return await _is_reported(Logger.ERROR_TYPE_SCRIPT, expected)


func _is_reported(type: Logger.ErrorType, expected: String) -> GdUnitGodotErrorAssert:
	var reports := await _reports_of_call()
	for report: ErrorWatch.Report in reports:
		if report.type == type and report.message == expected:
			_watch.forgive(report)
			return _check(true, "")
	return _check_reports(false, "expected the report '%s'" % expected, reports)


func _reports_of_call() -> Array[ErrorWatch.Report]:
	var before := _watch.count()
	var callable: Callable = _current
	if callable.is_valid():
		await callable.call()
	else:
		_report("the callable is not valid")
	await (Engine.get_main_loop() as SceneTree).process_frame
	return _watch.since(before)


func _check_reports(
	holds: bool, expectation: String, reports: Array[ErrorWatch.Report]
) -> GdUnitGodotErrorAssert:
	_current = reports.map(func(report: ErrorWatch.Report) -> String: return report.message)
	return _check(holds, expectation)
