@tool
extends HBoxContainer
## A path in a form, typed or chosen in the editor's dialog.

## Another file has been chosen; its path in the project, if it is there.
signal chosen(path: String)

var _line := LineEdit.new()
var _filters: Dictionary[String, String] = {}
var _dialog: EditorFileDialog


## [param filters] are patterns and what they are called.
static func make(placeholder: String, filters: Dictionary[String, String]) -> HBoxContainer:
	var field := new()
	field._filters = filters
	field._line.placeholder_text = placeholder
	return field


func _init() -> void:
	var browse := Button.new()
	browse.text = "…"
	browse.tooltip_text = "Chooses a file."
	browse.pressed.connect(_browse)
	_line.size_flags_horizontal = SIZE_EXPAND_FILL
	_line.text_submitted.connect(_choose)
	_line.focus_exited.connect(_on_focus_exited)
	add_child(_line)
	add_child(browse)


func show_path(path: String) -> void:
	_line.text = path
	_line.tooltip_text = path


func _browse() -> void:
	if _dialog == null:
		_dialog = EditorFileDialog.new()
		_dialog.file_mode = EditorFileDialog.FILE_MODE_OPEN_FILE
		_dialog.access = EditorFileDialog.ACCESS_FILESYSTEM
		for pattern in _filters:
			_dialog.add_filter(pattern, _filters[pattern])
		_dialog.file_selected.connect(_choose)
		add_child(_dialog)
	_dialog.popup_file_dialog()


# What was typed counts without Enter, too: Bake may be the next click.
func _on_focus_exited() -> void:
	if _line.text != _line.tooltip_text:
		_choose(_line.text)


func _choose(path: String) -> void:
	show_path(ProjectSettings.localize_path(path))
	chosen.emit(_line.text)
