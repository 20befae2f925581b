@tool
extends EditorContextMenuPlugin
## "Convert Materials …" in the menu of the scene tree: what the selected nodes and those below them
## draw with Godot's own materials, they draw with [LobeMaterial3D]s, or the other way. One step of
## the history undoes it, and the output says where each material went.

const ConversionDialog := preload("conversion_dialog.gd")
const Report := preload("conversion_report.gd")
const SceneConversion := preload("scene_conversion.gd")
const Wording := preload("../wording.gd")

var _undo_redo: EditorUndoRedoManager
var _dialog: ConversionDialog


func _init(undo_redo: EditorUndoRedoManager = null) -> void:
	_undo_redo = undo_redo


func _popup_menu(_paths: PackedStringArray) -> void:
	add_context_menu_item(SceneConversion.title_of(true), convert_nodes)
	add_context_menu_item(SceneConversion.title_of(false), convert_back)
	add_context_menu_item("Convert Materials …", ask)


## Converts the materials of nodes and of those below them; the report.
func convert_nodes(nodes: Array, to_lobes := true, in_files := false) -> String:
	var roots: Array[Node] = []
	roots.assign(nodes)
	var root := EditorInterface.get_edited_scene_root()
	var conversion: SceneConversion = SceneConversion.of(roots, root, to_lobes, in_files)
	return commit(conversion)


## Converts back to Godot's materials.
func convert_back(nodes: Array) -> String:
	return convert_nodes(nodes, false)


## Does a conversion and says what it did; the report.
func commit(conversion: SceneConversion) -> String:
	var toaster := EditorInterface.get_editor_toaster()
	var summary := Report.summarise(conversion)
	var report := Report.describe(conversion)
	var problem := conversion.commit(_undo_redo)
	if problem:
		toaster.push_toast(problem, EditorToaster.SEVERITY_ERROR)
		push_error("Nothing was converted: " + problem)
		return problem
	toaster.push_toast(summary)
	if not conversion.plan.instances.is_empty():
		var instances := Wording.count(conversion.plan.instances.size(), "instance")
		toaster.push_toast("Editable Children is now on for %s." % instances)
	if not conversion.files.files.is_empty():
		var files := Wording.count(conversion.files.files.size(), "file")
		toaster.push_toast("%s of scenes changed." % files)
	if not conversion.plan.is_empty() or not conversion.plan.left.is_empty():
		print("%s: %s" % [conversion.get_title(), report])
	return report


## Shows what would be done, and lets the user choose how.
func ask(nodes: Array) -> void:
	var root := EditorInterface.get_edited_scene_root()
	if root == null:
		return
	if _dialog == null:
		_dialog = ConversionDialog.new(commit)
		EditorInterface.get_base_control().add_child(_dialog)
	var roots: Array[Node] = []
	roots.assign(nodes)
	_dialog.ask(roots, root)


## The dialog; null as long as it has not been needed.
func get_dialog() -> ConversionDialog:
	return _dialog


## Takes the dialog away.
func close() -> void:
	if _dialog != null:
		_dialog.queue_free()
		_dialog = null
