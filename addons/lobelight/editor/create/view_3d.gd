@tool
extends Object
## The editor's 3D view: what it shows of sun and sky where a scene has none, and where it looks.

const _EDITOR := "Node3DEditor"
const _FOCUS := "spatial_editor/focus_selection"
const _VIEWS := 4


## The sun that the view shows by itself; [code]null[/code] where it shows none.
static func find_preview_sun() -> DirectionalLight3D:
	return _find_part("DirectionalLight3D") as DirectionalLight3D


## The sky that the view shows by itself; [code]null[/code] where it shows none.
static func find_preview_environment() -> WorldEnvironment:
	return _find_part("WorldEnvironment") as WorldEnvironment


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


# What the view adds to a scene lies right below its editor.
static func _find_part(type: String) -> Node:
	var editor: Node = EditorInterface.get_editor_viewport_3d(0)
	while editor != null and not editor.is_class(_EDITOR):
		editor = editor.get_parent()
	for node in editor.get_children() if editor != null else []:
		if node.is_class(type):
			return node
	return null
