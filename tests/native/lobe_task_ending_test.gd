extends GdUnitTestSuite
## LobeTask, by way of LobeBaker: work that is ended, by cancelling it, by letting go of the task or
## by quitting the engine.

## Work that is made of other work, each part of which takes minutes.
const NESTED := [
	[{"alpha": [0.01, 0.3], "lobes": "auto", "target": 46, "views": [64, 64]}],
	[{"widths": [0.01, 0.3], "lobes": 32, "views": [256, 256], "threads": 1}],
]
## Milliseconds that any step here may take: far more than it does on a busy machine.
const PATIENCE := 60_000


func test_nested_work_stops_within_a_part_of_it(
	recipe: Dictionary, _test_parameters := NESTED
) -> void:
	var baker := LobeBaker.new()
	assert_bool(baker.start(recipe)).is_true()
	while baker.is_running() and baker.get_progress() <= 0.0:
		await await_idle_frame()
	var start := Time.get_ticks_msec()
	baker.cancel()
	while baker.is_running():
		await await_idle_frame()
	@warning_ignore("integer_division")
	assert_int(Time.get_ticks_msec() - start).is_less(PATIENCE / 10)
	assert_dict(baker.get_result()).is_empty()
	assert_str(baker.get_error()).is_empty()


## The engine's memory is filled with rubbish as it is freed, so that a task that goes on after its
## own end is found out.
func test_handler_may_let_go_of_the_task_within_start() -> void:
	var text := _run_script("let_go_within_start.gd", [], {"MALLOC_PERTURB_": "165"})
	assert_str(text).contains("the task is gone")
	assert_str(text).not_contains("ERROR")
	assert_str(text).not_contains("leaked")


## The engine quits, and ends its process without a complaint, while a script's task is at work.
func test_quitting_ends_the_work_of_a_held_task() -> void:
	var text := _quit_while_baking("held")
	assert_str(text).not_contains("ERROR")
	assert_str(text).not_contains("leaked")


## The same where the script has made a cycle, so that the task itself is never freed.
func test_quitting_ends_the_work_of_a_leaked_task() -> void:
	assert_str(_quit_while_baking("leaked")).contains("ObjectDB instances leaked")


## Output of an engine that quits while a task is running; fails the test if it ends badly.
func _quit_while_baking(how: String) -> String:
	var start := Time.get_ticks_msec()
	var text := _run_script("quit_while_baking.gd", [how])
	assert_int(Time.get_ticks_msec() - start).is_less(PATIENCE)
	assert_str(text).contains("quitting while a task is running")
	return text


## Output of an engine that runs a script of this folder; fails the test if it ends badly.
func _run_script(
	script: String, arguments: PackedStringArray, environment: Dictionary[String, String] = {}
) -> String:
	for variable in environment:
		OS.set_environment(variable, environment[variable])
	var project := ProjectSettings.globalize_path("res://")
	var path := "res://tests/native/" + script
	var output: Array[String] = []
	var status := OS.execute(
		OS.get_executable_path(),
		PackedStringArray(["--headless", "--path", project, "-s", path, "--"]) + arguments,
		output,
		true
	)
	for variable in environment:
		OS.unset_environment(variable)
	assert_int(status).is_equal(0)
	return output[0]
