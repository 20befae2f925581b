@tool
extends RefCounted
## A conversion of the materials of nodes in the open scene: what it would do, and how it is done,
## in one step that can be undone.

const Plan := preload("conversion_plan.gd")
const SceneFiles := preload("scene_files.gd")

var plan: Plan
var files: SceneFiles


## Looks at the nodes and all below them, and changes nothing.
static func of(nodes: Array[Node], root: Node, to_lobes: bool, in_files: bool) -> RefCounted:
	var conversion := new()
	var locked := find_locked()
	conversion.plan = Plan.make(nodes, root, to_lobes, in_files, locked)
	conversion.files = SceneFiles.open(conversion.plan.files, to_lobes, locked)
	return conversion


## Scenes that are open would not notice that their files change, and write over them.
static func find_locked() -> Dictionary[String, String]:
	var locked: Dictionary[String, String] = {}
	for path in EditorInterface.get_open_scenes():
		locked[path] = "it is open, and was left alone: convert it there, or close it"
	return locked


## Does it; a sentence if files cannot be written, and nothing is changed.
func commit(undo_redo: EditorUndoRedoManager) -> String:
	var problem := files.save()
	if problem or plan.is_empty():
		return problem
	var root := plan.root
	undo_redo.create_action(get_title(), UndoRedo.MERGE_DISABLE, root)
	if not files.files.is_empty():
		undo_redo.add_do_method(files, "switch", true)
		undo_redo.add_undo_method(files, "switch", false)
	for instance in plan.instances:
		undo_redo.add_do_method(root, "set_editable_instance", instance, true)
		undo_redo.add_undo_method(root, "set_editable_instance", instance, false)
	for change in plan.changes:
		undo_redo.add_do_property(change.node, change.property, change.after)
		undo_redo.add_undo_property(change.node, change.property, change.before)
	undo_redo.commit_action()
	return ""


## What it is called, in menus and in the history.
func get_title() -> String:
	return title_of(plan.converter.to_lobes)


## What a conversion is called.
static func title_of(to_lobes: bool) -> String:
	return "Convert Materials to " + ("LobeMaterial3D" if to_lobes else "StandardMaterial3D")
