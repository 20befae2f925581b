@tool
extends RefCounted
## What Lobelight adds to scenes, as items of the menu in the 3D view's toolbar and of
## [i]Project > Tools > Lobelight > Create[/i]. Each is one step of the undo history.

enum Item { SPHERE, ENVIRONMENT, PROBE }

const IconFile := preload("../icon_file.gd")
const RoomFit := preload("room_fit.gd")
const SceneParts := preload("scene_parts.gd")
const SceneStep := preload("scene_step.gd")
const View3D := preload("view_3d.gd")

const _TITLES: Dictionary[Item, String] = {
	Item.SPHERE: "Create Brushed Sphere",
	Item.ENVIRONMENT: "Create Environment",
	Item.PROBE: "Create Room Probe Around Selection",
}
const _TOOLTIPS: Dictionary[Item, String] = {
	Item.SPHERE:
	(
		"Adds a sphere of brushed metal, and what the scene does not have yet of a sky, a sun and\n"
		+ "a LobeEnvironment3D. Where no scene is open, it makes a new one."
	),
	Item.ENVIRONMENT:
	(
		"Adds what the scene does not have yet of a sky, a sun and a LobeEnvironment3D.\n"
		+ "Where no scene is open, it makes a new one."
	),
	Item.PROBE: "Adds a LobeProbe3D whose box ends at the selected walls, for Bake Light.",
}
const _ICONS: Dictionary[Item, String] = {
	Item.SPHERE: "lobe_material_3d",
	Item.ENVIRONMENT: "lobe_environment_3d",
	Item.PROBE: "lobe_probe_3d",
}

var _history: EditorUndoRedoManager
var _shown: Resource


func _init(history: EditorUndoRedoManager = null) -> void:
	_history = history


## Gives a menu the items.
func fill(menu: PopupMenu) -> void:
	var scale := EditorInterface.get_editor_scale()
	for item: Item in _TITLES:
		menu.add_icon_item(IconFile.draw(_ICONS[item], scale), _TITLES[item], item)
	menu.about_to_popup.connect(show_problems.bind(menu))
	menu.id_pressed.connect(choose)


## Disables the items that can do nothing; their tooltips say why.
func show_problems(menu: PopupMenu) -> void:
	for item: Item in _TITLES:
		var problem := find_problem(item)
		var index := menu.get_item_index(item)
		menu.set_item_disabled(index, not problem.is_empty())
		menu.set_item_tooltip(index, problem if problem else _TOOLTIPS[item])


## Does what an item says.
func choose(item: Item) -> void:
	if find_problem(item):
		return
	var root := EditorInterface.get_edited_scene_root()
	var step := SceneStep.new(_TITLES[item])
	var made: Node
	if item == Item.PROBE:
		made = RoomFit.make_probe(EditorInterface.get_selection().get_selected_nodes(), root)
		step.add(made)
	else:
		for name in SceneParts.find_missing_light(root):
			made = SceneParts.make_light(name)
			step.add_first(made)
	if item == Item.SPHERE:
		made = SceneParts.make_sphere(root)
		step.add(made)
	EditorInterface.set_main_screen_editor("3D")
	step.commit(_history, made)
	if item != Item.ENVIRONMENT:
		View3D.focus_selection()
	if item == Item.SPHERE:
		_inspect((made as MeshInstance3D).material_override)


## Why an item can do nothing, in a sentence; empty if it can.
static func find_problem(item: Item) -> String:
	var root := EditorInterface.get_edited_scene_root()
	if item == Item.ENVIRONMENT and SceneParts.find_missing_light(root).is_empty():
		return "The scene has an environment, a light and a LobeEnvironment3D already."
	var selected := EditorInterface.get_selection().get_selected_nodes()
	if item == Item.PROBE and not RoomFit.has_walls(selected):
		return "Select the meshes of a room first: the probe's box is fitted to them."
	return ""


# The editor shows the selected node when it takes notice of the selection; this comes after.
func _inspect(resource: Resource) -> void:
	_shown = resource
	var selection := EditorInterface.get_selection()
	if not selection.selection_changed.is_connected(_show):
		selection.selection_changed.connect(_show, CONNECT_ONE_SHOT | CONNECT_DEFERRED)


func _show() -> void:
	EditorInterface.edit_resource(_shown)
	_shown = null
