@tool
extends RefCounted
## Nodes that come into the edited scene as one step of the undo history, below its root. Where no
## scene is edited, the step makes a new 3D scene.

const _ROOT := "Node3D"
# The engine's own method, by which its Scene dock makes the root of a new scene.
const _SET_SCENE := &"set_edited_scene"

var _title: String
var _first: Array[Node] = []
var _last: Array[Node] = []


## [param title] is what the history calls the step.
func _init(title: String) -> void:
	_title = title


## Adds a node that concerns the whole scene: it comes before all others, where the engine also puts
## suns and environments.
func add_first(node: Node) -> void:
	node.name = _adjust_casing(node.name)
	_first.append(node)


## Adds a node after all others.
func add(node: Node) -> void:
	node.name = _adjust_casing(node.name)
	_last.append(node)


## Does the step, and selects one of its nodes.
func commit(history: EditorUndoRedoManager, selected: Node) -> void:
	var root := EditorInterface.get_edited_scene_root()
	var editor := EditorInterface.get_base_control().get_parent()
	if root == null and editor.has_method(_SET_SCENE):
		_start_scene(editor, history)
	else:
		if root == null:
			root = _make_root()
			EditorInterface.add_root_node(root)
		_extend_scene(root, history)
	var selection := EditorInterface.get_selection()
	history.add_do_method(selection, &"clear")
	history.add_do_method(selection, &"add_node", selected)
	history.commit_action()


func _start_scene(editor: Node, history: EditorUndoRedoManager) -> void:
	var root := _make_root()
	for node in _first + _last:
		root.add_child(node, true)
		node.owner = root
	# The history of a scene without nodes is found by a resource that has no file.
	history.create_action(_title, UndoRedo.MERGE_DISABLE, Resource.new())
	history.add_do_method(editor, _SET_SCENE, root)
	history.add_do_reference(root)
	history.add_undo_method(editor, _SET_SCENE, null)


func _extend_scene(root: Node, history: EditorUndoRedoManager) -> void:
	history.create_action(_title, UndoRedo.MERGE_DISABLE, root)
	for node in _first + _last:
		history.add_do_method(root, &"add_child", node, true)
		history.add_do_method(node, &"set_owner", root)
		history.add_do_reference(node)
		history.add_undo_method(root, &"remove_child", node)
	for place in _first.size():
		history.add_do_method(root, &"move_child", _first[place], place)


static func _make_root() -> Node3D:
	var root := Node3D.new()
	root.name = _adjust_casing(_ROOT)
	return root


# As the project wants names of new nodes.
static func _adjust_casing(name: String) -> String:
	match ProjectSettings.get_setting("editor/naming/node_name_casing"):
		1:
			return name.to_camel_case()
		2:
			return name.to_snake_case()
		3:
			return name.to_kebab_case()
	return name
