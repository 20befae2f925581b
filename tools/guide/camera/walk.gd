@tool
extends RefCounted
## Base of the walks through the guide: a hand, a camera, and the ways that are gone more than once.

const Finder := preload("finder.gd")
const Mouse := preload("mouse.gd")

const ADDON := "lobelight"

var _mouse: Mouse
var _take: Callable
var _root: Window = EditorInterface.get_base_control().get_window()


## [param take] takes a picture under a name.
func _init(mouse: Mouse, take: Callable) -> void:
	_mouse = mouse
	_take = take


func _expect(is_there: bool, what: String) -> void:
	if not is_there:
		_mouse.fail("there is no " + what)


# A menu of the editor's bar.
func _open_menu(title: String) -> void:
	var bar: MenuBar = Finder.of_class(EditorInterface.get_base_control(), "MenuBar")
	var place := _mouse.find_rect(bar).position + Finder.menu_title(bar, title)
	await _mouse.click_at(place, bar, title)


# A new node below the selected one.
func _add_node(type: String) -> void:
	await _mouse.click(Finder.button(_root, "Add/Create a New Node"), "+")
	await _mouse.wait(0.5)
	await _mouse.type(type)
	await _mouse.click(Finder.button(_root, "Create"), "Create " + type)
	await _mouse.wait(1.0)


# A new resource for a property in the inspector.
func _choose_resource(property: StringName, type: String) -> void:
	var editor := Finder.property(property)
	await _mouse.scroll_to(EditorInterface.get_inspector(), editor)
	await _mouse.click(Finder.button(editor, "<empty>"), property)
	await _mouse.choose(editor.get_window(), type)
	await _mouse.wait(1.0)


# A section of the inspector, by its header.
func _unfold(title: String) -> void:
	var section := Finder.section(title)
	if section == null:
		_mouse.fail("there is no section " + title)
		return
	await _mouse.scroll_to(EditorInterface.get_inspector(), section)
	await _mouse.click_at(_mouse.find_rect(section).position + Vector2(60.0, 12.0), section, title)
	await _mouse.wait(0.5)


# The plugin, in the project's settings, which stay open.
func _enable() -> void:
	await _open_menu("Project")
	await _mouse.choose(_root, "Project Settings...")
	await _mouse.wait(0.5)
	var settings := Finder.of_class(_root, "ProjectSettingsEditor")
	await _mouse.choose_tab(Finder.tabs(settings, "Plugins"), "Plugins")
	var list: Tree = Finder.of_class(Finder.of_class(settings, "EditorPluginSettings"), "Tree")
	await _mouse.choose_item(list, Finder.item(list.get_root(), "Lobelight", 1), 0, "On")
	await _mouse.wait(1.0)
	_expect(EditorInterface.is_plugin_enabled(ADDON), "enabled plugin")


func _close_settings() -> void:
	var settings := Finder.of_class(_root, "ProjectSettingsEditor")
	await _mouse.click(Finder.button(settings, "Close"), "Close")
