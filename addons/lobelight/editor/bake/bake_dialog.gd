@tool
extends AcceptDialog
## Shows how far the bakes are, how long they may still take, and cancels them. The editor stays
## usable meanwhile; closing the dialog lets the bakes go on.

const BakeQueue := preload("bake_queue.gd")

# Most bakes are over sooner.
const _DELAY_SECONDS := 0.3

var _queue: BakeQueue
var _what := Label.new()
var _bar := ProgressBar.new()
var _time := Label.new()
var _waited := 0.0
var _was_closed := false


func _init(queue: BakeQueue = null) -> void:
	_queue = queue
	if queue != null:
		queue.changed.connect(set_process.bind(true))
	title = "Bake LobeTable"
	exclusive = false
	ok_button_text = "Hide"
	add_button("Cancel Bake", true, "cancel_bake")
	custom_action.connect(_on_action)
	visibility_changed.connect(_on_visibility_changed)
	var box := VBoxContainer.new()
	_bar.max_value = 1.0
	_bar.step = 0.001
	for control: Control in [_what, _bar, _time]:
		box.add_child(control)
	add_child(box)
	visible = false


func _ready() -> void:
	_bar.custom_minimum_size.x = 360.0 * EditorInterface.get_editor_scale()


func _process(delta: float) -> void:
	var job := _queue.get_running() if _queue != null else null
	if job == null:
		_waited = 0.0
		_was_closed = false
		hide()
		set_process(false)
		return
	_waited += delta
	var waiting := _queue.get_waiting_count()
	_what.text = "Fitting the lobes of %s" % job.get_title()
	if waiting > 0:
		_what.text += ", %d more to go" % waiting
	_bar.value = job.get_progress()
	_time.text = describe_seconds(job.get_seconds_left())
	if not visible and not _was_closed and _waited > _DELAY_SECONDS:
		popup_centered()


## Seconds left, as a person would say it.
static func describe_seconds(seconds: float) -> String:
	if seconds < 0.0:
		return "Estimating the time left …"
	if seconds < 2.0:
		return "About a second left"
	if seconds < 90.0:
		return "About %d seconds left" % ceili(seconds)
	return "About %d minutes left" % ceili(seconds / 60.0)


func _on_action(action: StringName) -> void:
	if action == &"cancel_bake":
		_queue.cancel_all()


func _on_visibility_changed() -> void:
	_was_closed = not visible and _queue != null and _queue.get_running() != null
