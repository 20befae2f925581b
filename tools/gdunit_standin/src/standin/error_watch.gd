extends Logger
## Collects what the engine, the scripts and the shaders report. Any thread may report.


## One report.
class Report:
	extends RefCounted
	var type: Logger.ErrorType
	var message: String
	var place: String

	func describe() -> String:
		const NAMES: Dictionary[Logger.ErrorType, String] = {
			Logger.ERROR_TYPE_ERROR: "error",
			Logger.ERROR_TYPE_WARNING: "warning",
			Logger.ERROR_TYPE_SCRIPT: "script error",
			Logger.ERROR_TYPE_SHADER: "shader error",
		}
		return "%s: %s (%s)" % [NAMES[type], message, place]


var _mutex := Mutex.new()
var _reports: Array[Report] = []
var _collected := 0


func _log_error(
	function: String,
	file: String,
	line: int,
	code: String,
	rationale: String,
	_editor_notify: bool,
	error_type: int,
	_script_backtraces: Array[ScriptBacktrace]
) -> void:
	var report := Report.new()
	report.type = error_type as Logger.ErrorType
	report.message = rationale if rationale else code
	report.place = "%s:%d in %s" % [file, line, function]
	_mutex.lock()
	_reports.append(report)
	_mutex.unlock()


## How many reports there have been.
func count() -> int:
	_mutex.lock()
	var size := _reports.size()
	_mutex.unlock()
	return size


## The reports from number [param first] on.
func since(first: int) -> Array[Report]:
	_mutex.lock()
	var reports := _reports.slice(first)
	_mutex.unlock()
	return reports


## Takes back an expected report: it becomes a warning, so that the numbers of the others stay.
func forgive(report: Report) -> void:
	report.type = Logger.ERROR_TYPE_WARNING


## The errors since the last call, in words. Warnings are no errors.
func collect_errors() -> PackedStringArray:
	var errors: PackedStringArray = []
	var reports := since(_collected)
	_collected += reports.size()
	for report in reports:
		if report.type != Logger.ERROR_TYPE_WARNING:
			errors.append(report.describe())
	return errors
