extends GdUnitTestSuite
## LobeTask, by way of LobeBaker: work in the background, its signals, and what ends it.

const QUICK := {"alpha": 0.1, "lobes": 2, "views": [4, 1]}
## Takes minutes unless it is cancelled.
const LONG := {"alpha": [0.01, 0.3], "lobes": 32, "views": [64, 64]}
## Milliseconds that any step here may take: far more than it does on a busy machine.
const PATIENCE := 60_000


## Writes down a task's signals, and whether they came on the main thread.
class Witness:
	var signals: Array[String] = []
	var results: Array[Dictionary] = []
	var messages: Array[String] = []
	var on_main_thread := true

	func _init(task: LobeTask) -> void:
		task.finished.connect(_on_finished)
		task.failed.connect(_on_failed)
		task.cancelled.connect(_on_cancelled)

	func _on_finished(result: Dictionary) -> void:
		_add("finished")
		results.append(result)

	func _on_failed(message: String) -> void:
		_add("failed")
		messages.append(message)

	func _on_cancelled() -> void:
		_add("cancelled")

	func _add(signal_name: String) -> void:
		signals.append(signal_name)
		on_main_thread = (on_main_thread and OS.get_thread_caller_id() == OS.get_main_thread_id())


func test_nothing_has_happened_at_first() -> void:
	var baker := LobeBaker.new()
	assert_bool(baker.is_running()).is_false()
	assert_float(baker.get_progress()).is_equal(0.0)
	assert_str(baker.get_error()).is_empty()
	assert_dict(baker.get_result()).is_empty()


func test_base_class_is_abstract() -> void:
	assert_bool(ClassDB.class_exists("LobeTask")).is_true()
	assert_bool(ClassDB.can_instantiate("LobeTask")).is_false()


func test_finished_work_emits_once_on_the_main_thread() -> void:
	var baker := LobeBaker.new()
	var witness := Witness.new(baker)
	assert_bool(baker.start(QUICK)).is_true()
	assert_bool(baker.is_running()).is_true()
	await _until(func() -> bool: return not witness.signals.is_empty())
	await await_millis(50)
	assert_array(witness.signals).contains_exactly("finished")
	assert_bool(witness.on_main_thread).is_true()
	assert_bool(baker.is_running()).is_false()
	assert_float(baker.get_progress()).is_equal(1.0)
	assert_str(baker.get_error()).is_empty()
	var expected := LobeBaker.new().bake(QUICK)
	assert_bool(witness.results[0].data == expected.data).is_true()
	assert_bool(baker.get_result().data == expected.data).is_true()


func test_result_can_be_waited_for_without_frames() -> void:
	var baker := LobeBaker.new()
	var witness := Witness.new(baker)
	assert_bool(baker.start(QUICK)).is_true()
	var end := Time.get_ticks_msec() + PATIENCE
	while baker.is_running() and Time.get_ticks_msec() < end:
		OS.delay_msec(1)
	assert_bool(baker.is_running()).is_false()
	assert_int(baker.get_result().get("lobes", 0)).is_equal(2)
	assert_array(witness.signals).is_empty()
	await _until(func() -> bool: return not witness.signals.is_empty())
	assert_array(witness.signals).contains_exactly("finished")


func test_next_start_delivers_the_signal_before() -> void:
	var baker := LobeBaker.new()
	var witness := Witness.new(baker)
	baker.start(QUICK)
	while baker.is_running():
		OS.delay_msec(1)
	assert_bool(baker.start(QUICK.merged({"lobes": 3}, true))).is_true()
	assert_array(witness.signals).contains_exactly("finished")
	await _until(func() -> bool: return witness.signals.size() > 1)
	assert_array(witness.signals).contains_exactly("finished", "finished")
	assert_int(witness.results[0].lobes).is_equal(2)
	assert_int(witness.results[1].lobes).is_equal(3)


func test_second_start_is_refused() -> void:
	var baker := LobeBaker.new()
	var witness := Witness.new(baker)
	assert_bool(baker.start(LONG)).is_true()
	assert_bool(baker.start(QUICK)).is_false()
	assert_str(baker.get_error()).contains("running already")
	assert_bool(baker.is_running()).is_true()
	baker.cancel()
	await _until(func() -> bool: return not witness.signals.is_empty())
	assert_str(baker.get_error()).is_empty()


func test_cancelled_work_has_no_result() -> void:
	var baker := LobeBaker.new()
	var witness := Witness.new(baker)
	baker.start(LONG)
	await await_millis(20)
	baker.cancel()
	await _until(func() -> bool: return not witness.signals.is_empty())
	assert_array(witness.signals).contains_exactly("cancelled")
	assert_bool(witness.on_main_thread).is_true()
	assert_bool(baker.is_running()).is_false()
	assert_dict(baker.get_result()).is_empty()
	assert_str(baker.get_error()).is_empty()
	assert_float(baker.get_progress()).is_less(1.0)


func test_cancel_wins_over_work_that_was_just_done() -> void:
	# Whatever the worker's state was when cancel() was called on a running task.
	for delay in [0, 200, 1000, 3000, 10000]:
		var baker := LobeBaker.new()
		baker.start(QUICK)
		OS.delay_usec(delay)
		var was_running := baker.is_running()
		baker.cancel()
		await _until(func() -> bool: return not baker.is_running())
		assert_bool(baker.get_result().is_empty()).is_equal(was_running)


func test_cancel_without_work_does_nothing() -> void:
	var baker := LobeBaker.new()
	var witness := Witness.new(baker)
	baker.cancel()
	baker.start(QUICK)
	await _until(func() -> bool: return not witness.signals.is_empty())
	baker.cancel()
	await await_millis(20)
	assert_array(witness.signals).contains_exactly("finished")
	assert_int(baker.get_result().lobes).is_equal(2)


func test_task_can_be_used_again_after_cancel() -> void:
	var baker := LobeBaker.new()
	baker.start(LONG)
	baker.cancel()
	await _until(func() -> bool: return not baker.is_running())
	assert_bool(baker.start(QUICK)).is_true()
	await _until(func() -> bool: return not baker.is_running())
	assert_int(baker.get_result().get("lobes", 0)).is_equal(2)


func test_handler_may_start_the_next_run() -> void:
	var baker := LobeBaker.new()
	var reference: WeakRef = weakref(baker)
	var lobes: Array[int] = []
	baker.finished.connect(
		func(table: Dictionary) -> void:
			lobes.append(table.lobes)
			# By way of a weak reference: a task that its own signal's handler holds is never freed.
			if lobes.size() < 3:
				reference.get_ref().start(QUICK.merged({"lobes": table.lobes + 1}, true))
	)
	baker.start(QUICK)
	await _until(func() -> bool: return lobes.size() == 3)
	assert_array(lobes).contains_exactly(2, 3, 4)


func test_handler_may_let_go_of_the_task() -> void:
	var holder := {"baker": LobeBaker.new()}
	var reference: WeakRef = weakref(holder.baker)
	var finished := [false]
	holder.baker.finished.connect(
		func(_table: Dictionary) -> void:
			holder.clear()
			finished[0] = true
	)
	holder.baker.start(QUICK)
	await _until(func() -> bool: return finished[0])
	await await_idle_frame()
	assert_object(reference.get_ref()).is_null()


func test_progress_never_falls() -> void:
	var baker := LobeBaker.new()
	var seen: Array[float] = []
	baker.start({"alpha": [0.05, 0.2], "lobes": 8, "views": [16, 4]})
	while baker.is_running():
		seen.append(baker.get_progress())
		OS.delay_msec(1)
	seen.append(baker.get_progress())
	assert_int(seen.size()).is_greater(10)
	var between := 0
	for i in range(1, seen.size()):
		assert_float(seen[i]).is_between(seen[i - 1], 1.0)
		between += int(seen[i] > 0.0 and seen[i] < 1.0)
	assert_float(seen[-1]).is_equal(1.0)
	assert_int(between).is_greater(0)


func test_freeing_a_running_task_ends_its_work_silently() -> void:
	var baker := LobeBaker.new()
	var witness := Witness.new(baker)
	baker.start(LONG)
	await await_millis(20)
	var reference: WeakRef = weakref(baker)
	var start := Time.get_ticks_msec()
	baker = null
	assert_object(reference.get_ref()).is_null()
	assert_int(Time.get_ticks_msec() - start).is_less(PATIENCE)
	await await_millis(50)
	assert_array(witness.signals).is_empty()


func test_files_are_read_by_the_worker() -> void:
	# Were it not so, start() would know at once that there is no such file.
	for task: LobeTask in [LobeBaker.new(), LobeReference.new()]:
		var witness := Witness.new(task)
		var request := {"brdf": "user://no_such_file.binary"}
		if task is LobeReference:
			request["env"] = "res://tests/data/forest.exr"
		assert_bool(task.start(request)).is_true()
		await _until(func() -> bool: return not witness.signals.is_empty())
		assert_array(witness.signals).contains_exactly("failed")
		assert_str(witness.messages[0]).contains("no_such_file.binary: no such file")


func test_failing_work_says_why() -> void:
	var reference := LobeReference.new()
	var witness := Witness.new(reference)
	assert_bool(reference.start({"env": "res://tests/data/nothing.exr"})).is_true()
	await _until(func() -> bool: return not witness.signals.is_empty())
	assert_array(witness.signals).contains_exactly("failed")
	assert_bool(witness.on_main_thread).is_true()
	assert_str(witness.messages[0]).contains("nothing.exr")
	assert_str(reference.get_error()).is_equal(witness.messages[0])
	assert_dict(reference.get_result()).is_empty()
	assert_bool(reference.is_running()).is_false()


func test_refused_start_forgets_the_last_result() -> void:
	var baker := LobeBaker.new()
	baker.start(QUICK)
	await _until(func() -> bool: return not baker.is_running())
	assert_dict(baker.get_result()).is_not_empty()
	assert_bool(baker.start({"lobes": 0})).is_false()
	assert_dict(baker.get_result()).is_empty()
	assert_str(baker.get_error()).contains("lobes is 0")


func test_many_tasks_at_once() -> void:
	var bakers: Array[LobeBaker] = []
	for lobes in range(1, 9):
		var baker := LobeBaker.new()
		bakers.append(baker)
		assert_bool(baker.start({"lobes": lobes, "views": [2, 1], "threads": 1})).is_true()
	for baker in bakers:
		await _until(func() -> bool: return not baker.is_running())
	for i in bakers.size():
		assert_int(bakers[i].get_result().lobes).is_equal(i + 1)


## Waits, frame by frame, until `condition` holds; fails the test when it takes too long.
func _until(condition: Callable) -> void:
	var end := Time.get_ticks_msec() + PATIENCE
	while not condition.call():
		if Time.get_ticks_msec() > end:
			fail("waited too long")
			return
		await await_idle_frame()
