@tool
extends RefCounted
## How far an import or an export is, in a window with Cancel, or in the output where there is none.
##
## The engine imports and exports on its main thread and lets no frame go by meanwhile
## (EditorFileSystem::reimport_files; even threaded importers get a single file there), and its own
## progress dialog is not for scripts. So this lets the system's events in and draws by itself.

const BakeDialog := preload("../bake/bake_dialog.gd")
const ProgressPanel := preload("progress_panel.gd")

# Most imports are over sooner.
const _DELAY_MSEC := 300
const _PERIOD_MSEC := 30
# Between lines of the output, in parts of the work.
const _PART := 0.25

## Whether the user does not want it any more.
var is_cancelled := false

var _title := ""
var _window_title := ""
var _began := Time.get_ticks_msec()
var _said := 0.0
var _window: Window
var _panel: ProgressPanel


func _init(title: String, window_title := "Import LobeTable") -> void:
	_title = title
	_window_title = window_title


## Waits for a moment, shows what is given, and takes clicks: to be called over and over.
func step(fraction: float, seconds_left: float) -> void:
	OS.delay_msec(_PERIOD_MSEC)
	if Time.get_ticks_msec() - _began < _DELAY_MSEC:
		return
	var time := BakeDialog.describe_seconds(seconds_left)
	if DisplayServer.get_name() == "headless":
		if fraction >= _said + _PART:
			_said = fraction
			print("%s: %d %%. %s." % [_title, roundi(100.0 * fraction), time])
		return
	if _window == null:
		_open()
	_panel.draw_now(fraction, time)
	DisplayServer.process_events()
	RenderingServer.force_draw()


## The work has ended.
func close() -> void:
	if _window != null:
		_window.hide()
		_window.queue_free()
		_window = null


func _open() -> void:
	_panel = ProgressPanel.new()
	_panel.title = _title
	_window = Window.new()
	_window.title = _window_title
	_window.transient = true
	_window.exclusive = true
	_window.unresizable = true
	# The engine disables what its own dialog covers.
	_window.process_mode = Node.PROCESS_MODE_ALWAYS
	_window.add_child(_panel)
	_window.window_input.connect(_on_input)
	_window.close_requested.connect(_cancel)
	EditorInterface.popup_dialog_centered(_window, Vector2i(_panel.find_size()))
	_panel.size = _window.size


func _on_input(event: InputEvent) -> void:
	if event.is_action_pressed(&"ui_cancel") or _panel.is_cancelled_by(event):
		_cancel()


func _cancel() -> void:
	is_cancelled = true
