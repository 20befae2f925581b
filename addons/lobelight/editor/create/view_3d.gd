@tool
extends Object
## The editor's 3D view: what it shows of sun and sky where a scene has none, and where it looks.

const _EDITOR := "Node3DEditor"
const _FOCUS := "spatial_editor/focus_selection"
const _VIEWS := 4


## The sun that the view shows by itself; [code]null[/code] where it shows none.
static func find_preview_sun() -> DirectionalLight3D:
	for node in _find_editor().get_children():
		if node is DirectionalLight3D:
			return node
	return null


## The sky that the view shows by itself; [code]null[/code] where it shows none.
static func find_preview_environment() -> WorldEnvironment:
	for node in _find_editor().get_children():
		if node is WorldEnvironment:
			return node
	return null


## Has all parts of the view look at what is selected, as its key (F) does.
static func focus_selection() -> void:
	var shortcut := EditorInterface.get_editor_settings().get_shortcut(_FOCUS)
	for index in _VIEWS:
		# The engine offers it in the view's menu only.
		var view := EditorInterface.get_editor_viewport_3d(index).get_parent().get_parent()
		for menu: PopupMenu in view.find_children("*", "PopupMenu", true, false):
			for item in menu.item_count:
				if shortcut != null and menu.get_item_shortcut(item) == shortcut:
					menu.id_pressed.emit(menu.get_item_id(item))


static func _find_editor() -> Node:
	var node: Node = EditorInterface.get_editor_viewport_3d(0)
	while not node.is_class(_EDITOR):
		node = node.get_parent()
	return node
