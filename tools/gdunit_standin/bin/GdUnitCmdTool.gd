extends SceneTree
## Stand-in for gdUnit4's command-line tool: runs suites and ends with gdUnit4's exit codes.

enum ExitCode { OK = 0, FAILED = 100, ORPHANS = 101, HEADLESS = 103 }

const Arguments := preload("res://addons/gdUnit4/src/standin/arguments.gd")
const ErrorWatch := preload("res://addons/gdUnit4/src/standin/error_watch.gd")
const JUnitReport := preload("res://addons/gdUnit4/src/standin/junit_report.gd")
const Record := preload("res://addons/gdUnit4/src/standin/test_record.gd")
const TestRunner := preload("res://addons/gdUnit4/src/standin/test_runner.gd")

## The runner works in every frame; when it has not for this many, an error has ended it.
const _LONGEST_PAUSE_FRAMES := 100

var _runner: TestRunner
var _watch := ErrorWatch.new()
var _ended := false


func _initialize() -> void:
	print("gdUnit4 stand-in (the real gdUnit4 is not installed in addons/gdUnit4)")
	var arguments := Arguments.new(OS.get_cmdline_args(), "GdUnitCmdTool.gd")
	if arguments.defect:
		_end_early(arguments.defect, ExitCode.FAILED)
	elif DisplayServer.get_name() == "headless" and not arguments.accepts_headless:
		_end_early("headless mode needs --ignoreHeadlessMode", ExitCode.HEADLESS)
	else:
		_run(arguments)


func _process(_delta: float) -> bool:
	var last_frame := _runner.last_frame if _runner != null else 0
	if not _ended and Engine.get_process_frames() - last_frame > _LONGEST_PAUSE_FRAMES:
		_end_early("the runner stopped", ExitCode.FAILED)
	return false


func _finalize() -> void:
	OS.remove_logger(_watch)
	if not _ended:
		printerr("stand-in: the program was ended by a test")
		quit(ExitCode.FAILED)


func _run(arguments: Arguments) -> void:
	OS.add_logger(_watch)
	_runner = TestRunner.new(self, _watch)
	_runner.stops_at_failure = not arguments.continues
	_runner.last_frame = Engine.get_process_frames()
	await process_frame
	print("stand-in: begin")
	await _runner.run(arguments.paths, arguments.ignored)
	for error in _watch.collect_errors():
		_runner.add_error("after the last suite", error)
	var report := arguments.report_directory.path_join("report_1/results.xml")
	var error := JUnitReport.write(report, _runner.results)
	if error != OK:
		_runner.add_error(report, "cannot be written: " + error_string(error))
	_end()


func _end() -> void:
	var failed := _runner.count(func(record: Record) -> bool: return record.has_failed())
	var skipped := _runner.count(func(record: Record) -> bool: return record.skipped)
	var passed := _runner.count(func(_record: Record) -> bool: return true) - failed - skipped
	var orphans := _runner.count_orphans()
	var code := ExitCode.OK
	if failed > 0 or passed == 0:
		code = ExitCode.FAILED
	elif orphans > 0:
		code = ExitCode.ORPHANS
	_ended = true
	print(
		(
			"stand-in: end, %d passed, %d failed, %d skipped, nodes left behind: %d, exit code %d"
			% [passed, failed, skipped, orphans, code]
		)
	)
	quit(code)


func _end_early(reason: String, code: ExitCode) -> void:
	_ended = true
	printerr("stand-in: " + reason)
	quit(code)
