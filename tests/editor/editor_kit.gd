@tool
extends Object
## What the suites in the running editor share.

const ADDON := "lobelight"
const PLUGIN := preload("res://addons/lobelight/editor/plugin.gd")


## The addon's plugin; enabled first where it is not.
static func get_plugin(tree: SceneTree) -> EditorPlugin:
	if not EditorInterface.is_plugin_enabled(ADDON):
		EditorInterface.set_plugin_enabled(ADDON, true)
	for node in tree.root.find_children("*", "EditorPlugin", true, false):
		if node.get_script() == PLUGIN and not node.is_queued_for_deletion():
			return node
	return null


## Waits until the condition holds, at most for some seconds; whether it does.
static func wait_until(tree: SceneTree, condition: Callable, seconds := 20.0) -> bool:
	var end := Time.get_ticks_msec() + 1000.0 * seconds
	while not condition.call():
		if Time.get_ticks_msec() > end:
			return false
		await tree.process_frame
	return true


## Waits for the end of a scan of the project's files, one that is about to begin included.
static func wait_for_scan(tree: SceneTree) -> bool:
	for frame in 2:
		await tree.process_frame
	var files := EditorInterface.get_resource_filesystem()
	return await wait_until(tree, func() -> bool: return not files.is_scanning())


## All nodes below one that are made from a script.
static func find_all(root: Node, script: Script) -> Array[Node]:
	var found: Array[Node] = []
	if root.get_script() == script:
		found.append(root)
	for child in root.get_children(true):
		found.append_array(find_all(child, script))
	return found


## The history that holds an object's actions.
static func get_history(object: Object) -> UndoRedo:
	var manager := EditorInterface.get_editor_undo_redo()
	return manager.get_history_undo_redo(manager.get_object_history_id(object))
