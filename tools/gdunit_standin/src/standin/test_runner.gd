## Runs suites one after the other and keeps the records of their tests.

const ErrorWatch := preload("res://addons/gdUnit4/src/standin/error_watch.gd")
const Record := preload("res://addons/gdUnit4/src/standin/test_record.gd")
const SuitePlan := preload("res://addons/gdUnit4/src/standin/suite_plan.gd")

const _SUITE_TIMEOUT_MS := 300_000

## Stop at the first test that fails.
var stops_at_failure := false
## Suite path to its records.
var results: Dictionary[String, Array] = {}
## The frame in which the runner was last at work; a watchdog compares it with the present one.
var last_frame := 0

var _tree: SceneTree
var _watch: ErrorWatch


func _init(tree: SceneTree, watch: ErrorWatch) -> void:
	_tree = tree
	_watch = watch


## Runs every suite below [param paths], except those that [param ignored] names, and of those only
## the tests that it does not name, as res://suite.gd:test.
func run(paths: PackedStringArray, ignored: PackedStringArray) -> void:
	for path in paths:
		var files := _scripts_below(path)
		if files.is_empty():
			add_error(path, "there is no script at this path")
		for file in files:
			if not _is_ignored(file, ignored) and not _must_stop():
				await _run_file(file, ignored)


## Number of records for which [param condition] (Record to bool) holds.
func count(condition: Callable) -> int:
	var sum := 0
	for suite in results:
		sum += results[suite].filter(condition).size()
	return sum


## Nodes that tests left behind.
func count_orphans() -> int:
	var sum := 0
	for suite in results:
		for record: Record in results[suite]:
			sum += record.orphans
	return sum


## Notes something that went wrong outside any test.
func add_error(suite: String, message: String) -> void:
	var record := Record.new("outside the tests")
	record.error(message)
	_keep(suite, record)


func _must_stop() -> bool:
	return stops_at_failure and count(func(record: Record) -> bool: return record.has_failed()) > 0


static func _scripts_below(path: String) -> PackedStringArray:
	if FileAccess.file_exists(path):
		return [path]
	var files: PackedStringArray = []
	if not DirAccess.dir_exists_absolute(path) or FileAccess.file_exists(path + "/.gdignore"):
		return files
	for file in DirAccess.get_files_at(path):
		if file.ends_with(".gd"):
			files.append(path.path_join(file))
	for directory in DirAccess.get_directories_at(path):
		files.append_array(_scripts_below(path.path_join(directory)))
	return files


static func _is_ignored(file: String, ignored: PackedStringArray) -> bool:
	for name in ignored:
		if file == name or file.get_file().get_basename() == name:
			return true
	return false


func _run_file(file: String, ignored: PackedStringArray) -> void:
	var plan: SuitePlan = SuitePlan.read(file)
	var load_errors := _watch.collect_errors()
	if plan == null and load_errors.is_empty():
		return
	print(file)
	if plan != null and not plan.defect:
		plan.leave_out(ignored)
	if plan != null and plan.defect:
		add_error(file, "\n".join(PackedStringArray([plan.defect]) + load_errors))
	elif not load_errors.is_empty():
		add_error(file, "\n".join(load_errors))
	else:
		await _run_suite(plan)


func _run_suite(plan: SuitePlan) -> void:
	var suite := _enter(plan)
	if not plan.cases.all(func(case: SuitePlan.Case) -> bool: return case.skipped):
		var failed := await _run_hook(plan, suite, "before")
		for case in plan.cases:
			if _must_stop():
				break
			if failed:
				_keep(plan.path, _refused(case, "not run, because before() failed"))
			elif await _run_case(plan, suite, case):
				# The test's coroutine may still be waiting somewhere: it keeps the old suite.
				suite = _enter(plan)
				failed = await _run_hook(plan, suite, "before")
		await _run_hook(plan, suite, "after")
	else:
		for case in plan.cases:
			_keep(plan.path, _skipped(case))
	suite.queue_free()
	await _frame()


func _enter(plan: SuitePlan) -> GdUnitTestSuite:
	var suite: GdUnitTestSuite = plan.suite_script.new()
	suite.standin_watch = _watch
	_tree.root.add_child(suite)
	return suite


## Runs before() or after(). Keeps a record only if it fails; returns whether it did.
func _run_hook(plan: SuitePlan, suite: GdUnitTestSuite, method: String) -> bool:
	var record := Record.new(method + "()")
	suite.standin_record = record
	if not await _ends_in_time(suite, [Callable(suite, method)], _SUITE_TIMEOUT_MS):
		record.error("%s() did not end" % method)
	if method == "after":
		suite.standin_free_objects()
	for error in _watch.collect_errors():
		record.error(error)
	if record.has_failed():
		_keep(plan.path, record)
	return record.has_failed()


## Runs one test. Returns whether it timed out, and its suite must not be used any more.
func _run_case(plan: SuitePlan, suite: GdUnitTestSuite, case: SuitePlan.Case) -> bool:
	if case.skipped:
		_keep(plan.path, _skipped(case))
		return false
	if case.defect:
		_keep(plan.path, _refused(case, case.defect))
		return false
	var record := Record.new(case.label)
	suite.standin_record = record
	var orphans := _orphans()
	var start := Time.get_ticks_usec()
	var steps: Array[Callable] = [
		suite.before_test, Callable(suite, case.method).bindv(case.arguments), suite.after_test
	]
	var in_time := await _ends_in_time(suite, steps, case.timeout_ms)
	record.seconds = (Time.get_ticks_usec() - start) / 1e6
	suite.standin_free_objects()
	await _frame()
	record.orphans = maxi(_orphans() - orphans, 0)
	for error in _watch.collect_errors():
		record.error(error)
	if not in_time:
		record.error("the test did not end within %d ms" % case.timeout_ms)
	elif record.assertions == 0 and not record.has_failed():
		record.error("the test made no assertion")
	_keep(plan.path, record)
	return not in_time


## Calls [param steps] one after the other, awaiting each. False if they take too long.
func _ends_in_time(suite: GdUnitTestSuite, steps: Array[Callable], timeout_ms: int) -> bool:
	var progress := {"done": false}
	_call_in_turn(steps, progress)
	var deadline := Time.get_ticks_msec() + timeout_ms
	while not progress.done:
		if Time.get_ticks_msec() > deadline:
			suite.standin_record = Record.new("abandoned")
			return false
		await _frame()
	return true


func _call_in_turn(steps: Array[Callable], progress: Dictionary) -> void:
	for step in steps:
		await step.call()
	progress.done = true


func _frame() -> void:
	last_frame = Engine.get_process_frames()
	await _tree.process_frame
	last_frame = Engine.get_process_frames()


func _keep(suite: String, record: Record) -> void:
	results.get_or_add(suite, []).append(record)
	var verdict := "passed"
	if record.skipped:
		verdict = "skipped: " + record.skip_reason
	elif record.has_failed():
		verdict = "FAILED\n" + record.describe().indent("      ")
	elif record.orphans:
		verdict = "passed, nodes left behind: %d" % record.orphans
	print("  %s (%.3f s) %s" % [record.name, record.seconds, verdict])


static func _orphans() -> int:
	return int(Performance.get_monitor(Performance.OBJECT_ORPHAN_NODE_COUNT))


static func _refused(case: SuitePlan.Case, reason: String) -> Record:
	var record := Record.new(case.label)
	record.error(reason)
	return record


static func _skipped(case: SuitePlan.Case) -> Record:
	var record := Record.new(case.label)
	record.skipped = true
	record.skip_reason = case.skip_reason
	return record
