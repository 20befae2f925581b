@tool
extends MenuButton
## The menu [i]Lobelight[/i] in the 3D view's toolbar.

const CreateMenu := preload("create_menu.gd")
const IconFile := preload("../icon_file.gd")

# As the engine's own menus beside it.
const _THEME := &"FlatMenuButton"
# The file's icon is eight times as large as a toolbar's.
const _ICON_SCALE := 0.125


func _init(menu: CreateMenu = null) -> void:
	if menu == null:
		return
	text = "Lobelight"
	tooltip_text = "Create a brushed sphere, the light of a scene, or the probe of a room."
	flat = false
	theme_type_variation = _THEME
	switch_on_hover = true
	icon = IconFile.draw("lobelight", _ICON_SCALE * EditorInterface.get_editor_scale())
	menu.fill(get_popup())
