@tool
extends ConfirmationDialog
## Asks how materials are to be converted, and shows what comes of it; afterwards, the report.

const Report := preload("conversion_report.gd")
const SceneConversion := preload("scene_conversion.gd")

const _SIZE := Vector2(640, 320)

## Converts to [LobeMaterial3D] or to Godot's materials.
var direction := OptionButton.new()
## Whether instances of scenes are converted in their own files.
var in_files := CheckBox.new()

var _commit: Callable
var _preview := TextEdit.new()
var _result := AcceptDialog.new()
var _report := TextEdit.new()
var _nodes: Array[Node] = []
var _root: Node
var _conversion: SceneConversion


func _init(commit := Callable()) -> void:
	_commit = commit
	title = "Convert Materials"
	ok_button_text = "Convert"
	direction.add_item("To LobeMaterial3D")
	direction.add_item("To StandardMaterial3D")
	direction.item_selected.connect(_update.unbind(1))
	in_files.text = "Convert instanced scenes in their own files"
	in_files.tooltip_text = (
		"Changes the .tscn and .scn files, and all other scenes with them. Otherwise the instances "
		+ "are made editable in this scene. Undo brings the files back."
	)
	in_files.toggled.connect(_update.unbind(1))
	var column := VBoxContainer.new()
	column.add_child(direction)
	column.add_child(in_files)
	_prepare(_preview)
	column.add_child(_preview)
	add_child(column)
	_prepare(_report)
	_result.title = "Materials Converted"
	_result.add_child(_report)
	_result.add_button("Copy", true, "copy")
	_result.custom_action.connect(copy.unbind(1))
	add_child(_result)
	confirmed.connect(_convert)


## Asks about the materials of nodes and of those below them.
func ask(nodes: Array[Node], root: Node) -> void:
	_nodes = nodes
	_root = root
	_update()
	popup_centered(_SIZE * EditorInterface.get_editor_scale())


## What the dialog says it will do, or the report of what was done.
func get_shown_text() -> String:
	return _report.text if _result.visible else _preview.text


## Takes the report to the clipboard.
func copy() -> void:
	DisplayServer.clipboard_set(_report.text)


func _update() -> void:
	var to_lobes := direction.selected == 0
	_conversion = SceneConversion.of(_nodes, _root, to_lobes, in_files.button_pressed)
	_preview.text = Report.describe(_conversion)
	get_ok_button().disabled = _conversion.plan.is_empty()


func _convert() -> void:
	# The scene may have changed since.
	_update()
	_report.text = _commit.call(_conversion)
	_conversion = null
	_nodes = []
	_result.popup_centered(_SIZE * EditorInterface.get_editor_scale())


static func _prepare(text: TextEdit) -> void:
	text.editable = false
	text.size_flags_vertical = Control.SIZE_EXPAND_FILL
	text.wrap_mode = TextEdit.LINE_WRAPPING_BOUNDARY
	text.custom_minimum_size = _SIZE * EditorInterface.get_editor_scale()
