@tool
extends EditorPlugin
## Runs suites in the running editor, as the stand-in's command-line tool does in a game, and ends
## the editor with its exit codes. The suites are named after "++ --editor-tests". With
## "++ --quit-while-baking" it ends the editor in the middle of a bake. Otherwise nothing happens.

const ErrorWatch := preload("res://addons/gdUnit4/src/standin/error_watch.gd")
const JUnitReport := preload("res://addons/gdUnit4/src/standin/junit_report.gd")
const Record := preload("res://addons/gdUnit4/src/standin/test_record.gd")
const TestRunner := preload("res://addons/gdUnit4/src/standin/test_runner.gd")

const OPTION := "--editor-tests"
const CLOSING_OPTION := "--quit-while-baking"
const REPORT := "res://report/results.xml"

var _watch := ErrorWatch.new()
var _is_watching := false


func _enter_tree() -> void:
	if OPTION in OS.get_cmdline_user_args():
		OS.add_logger(_watch)
		_is_watching = true
		_run.call_deferred()
	elif CLOSING_OPTION in OS.get_cmdline_user_args():
		_quit_while_baking.call_deferred()


func _exit_tree() -> void:
	if _is_watching:
		OS.remove_logger(_watch)


# Scripts of suites name classes, and files have to be imported.
func _wait_for_files() -> void:
	while EditorInterface.get_resource_filesystem().is_scanning():
		await get_tree().process_frame


func _quit_while_baking() -> void:
	await _wait_for_files()
	# Not preloaded: it needs the classes too.
	var kit: GDScript = load("res://tests/editor/editor_kit.gd")
	var recipe: RefCounted = load("res://addons/lobelight/editor/bake/bake_recipe.gd").new()
	recipe.set("alpha", Vector2(0.01, 0.3))
	recipe.set("lobes", 32)
	var bakes: Node = kit.call("get_plugin", get_tree()).call("get_bakes")
	bakes.call("add", LobeTable.new(), recipe)
	await get_tree().create_timer(0.2).timeout
	var is_baking: bool = bakes.call("get_running") != null
	print("closing: %d passed, %d failed" % [int(is_baking), int(not is_baking)])
	get_tree().quit()


func _run() -> void:
	await _wait_for_files()
	var paths: PackedStringArray = []
	for argument in OS.get_cmdline_user_args():
		if argument.begins_with("res://"):
			paths.append(argument)
	var runner := TestRunner.new(get_tree(), _watch)
	print("stand-in: begin")
	await runner.run(paths, [])
	for error in _watch.collect_errors():
		runner.add_error("after the last suite", error)
	if JUnitReport.write(REPORT, runner.results) != OK:
		runner.add_error(REPORT, "cannot be written")
	# The engine warns of a scan that it has to break off.
	await _wait_for_files()
	_end(runner)


func _end(runner: TestRunner) -> void:
	var failed := runner.count(func(record: Record) -> bool: return record.has_failed())
	var skipped := runner.count(func(record: Record) -> bool: return record.skipped)
	var passed := runner.count(func(_record: Record) -> bool: return true) - failed - skipped
	print(
		(
			"stand-in: end, %d passed, %d failed, %d skipped, nodes left behind: %d, exit code %d"
			% [passed, failed, skipped, runner.count_orphans(), mini(failed, 1)]
		)
	)
	get_tree().quit(mini(failed, 1) if passed > 0 else 1)
