@tool
extends Node
## Bakes tables, one after the other, on the native library's own threads. What comes out replaces
## the table's contents by an action that can be undone; a failed or cancelled bake leaves them.

## Bakes have been added, or one has begun or ended.
signal changed
## A table has been baked.
signal baked(table: LobeTable)
## A table could not be baked; the message is a sentence.
signal failed(table: LobeTable, message: String)
## A bake has been cancelled.
signal cancelled(table: LobeTable)

const Job := preload("bake_job.gd")
const Recipe := preload("bake_recipe.gd")
const TableState := preload("table_state.gd")

var _undo_redo: EditorUndoRedoManager
var _waiting: Array[Job] = []
var _running: Job
var _is_cancelling := false


func _init(undo_redo: EditorUndoRedoManager = null) -> void:
	_undo_redo = undo_redo
	set_process(false)


## Bakes a table, after those that have been added before. A table that is being baked already is
## not baked twice.
func add(table: LobeTable, recipe: Recipe) -> void:
	if is_baking(table):
		return
	_waiting.append(Job.new(table, recipe))
	set_process(true)
	_start_next()


## Whether the table is being baked or waits for it.
func is_baking(table: LobeTable) -> bool:
	if _running != null and _running.table == table:
		return true
	return _waiting.any(func(job: Job) -> bool: return job.table == table)


## The bake under way, or [code]null[/code].
func get_running() -> Job:
	return _running


## How many tables wait for the bake under way.
func get_waiting_count() -> int:
	return _waiting.size()


## Cancels the bake under way, and all that wait.
func cancel_all() -> void:
	var waiting := _waiting.duplicate()
	_waiting.clear()
	for job in waiting:
		cancelled.emit(job.table)
	if _running != null:
		_is_cancelling = true
		_running.cancel()
	changed.emit()


## Cancels everything, without waiting for what becomes of it: the task stops when it is let go of.
func stop() -> void:
	_waiting.clear()
	_running = null
	set_process(false)


func _process(_delta: float) -> void:
	if _running != null and not _running.is_running():
		_finish()
	if _running == null:
		_start_next()
	set_process(_running != null)


func _start_next() -> void:
	while _running == null and not _waiting.is_empty():
		var job: Job = _waiting.pop_front()
		if job.start():
			_running = job
			_is_cancelling = false
		else:
			_fail(job)
	changed.emit()


func _finish() -> void:
	var job := _running
	var result := job.take_result()
	_running = null
	if not job.error.is_empty():
		_fail(job)
	elif result.is_empty() or _is_cancelling:
		cancelled.emit(job.table)
	else:
		_apply(job, result)
		baked.emit(job.table)
	_is_cancelling = false
	changed.emit()


func _fail(job: Job) -> void:
	failed.emit(job.table, job.error)


func _apply(job: Job, result: Dictionary) -> void:
	var after := TableState.of_result(result, job.recipe)
	var before := TableState.of_table(job.table)
	_undo_redo.create_action("Bake LobeTable", UndoRedo.MERGE_DISABLE, job.table)
	TableState.add_change(_undo_redo, job.table, before, after)
	_undo_redo.commit_action()
