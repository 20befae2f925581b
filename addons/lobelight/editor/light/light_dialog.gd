@tool
extends AcceptDialog
## Shows how many lights of a scene have been baked, and cancels the rest. What cannot be baked is
## said in the editor's notes.

const LightBakes := preload("light_bakes.gd")

# Most bakes of a single light are over sooner.
const _DELAY_SECONDS := 0.3

var _bakes: LightBakes
var _what := Label.new()
var _bar := ProgressBar.new()
var _waited := 0.0
var _was_closed := false


func _init(bakes: LightBakes = null) -> void:
	_bakes = bakes
	if bakes != null:
		bakes.changed.connect(set_process.bind(true))
		bakes.failed.connect(_on_failed)
	title = "Bake Light"
	exclusive = false
	ok_button_text = "Hide"
	add_button("Cancel Bake", true, "cancel_bake")
	custom_action.connect(_on_action)
	visibility_changed.connect(_on_visibility_changed)
	var box := VBoxContainer.new()
	box.add_child(_what)
	box.add_child(_bar)
	add_child(box)
	visible = false


func _ready() -> void:
	_bar.step = 0.01
	_bar.custom_minimum_size.x = 360.0 * EditorInterface.get_editor_scale()


func _process(delta: float) -> void:
	var node := _bakes.get_running() if _bakes != null else null
	if node == null:
		_waited = 0.0
		_was_closed = false
		hide()
		set_process(false)
		return
	_waited += delta
	var progress := _bakes.get_progress()
	var verb := "Capturing" if node is LobeProbe3D else "Filtering the light of"
	_what.text = "%s %s, %d of %d" % [verb, node.name, progress.x + 1, progress.y]
	_bar.max_value = progress.y
	_bar.value = progress.x + _bakes.get_fraction()
	if not visible and not _was_closed and _waited > _DELAY_SECONDS:
		popup_centered()


func _on_action(action: StringName) -> void:
	if action == &"cancel_bake":
		_bakes.cancel_all()


func _on_failed(node: Node3D, message: String) -> void:
	var toaster := EditorInterface.get_editor_toaster()
	toaster.push_toast("%s: %s" % [node.name, message], EditorToaster.SEVERITY_ERROR)


func _on_visibility_changed() -> void:
	_was_closed = not visible and _bakes != null and _bakes.get_running() != null
