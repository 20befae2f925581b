@tool
extends "walk.gd"
## The guide's list of clicks, from an empty project to a brushed sphere in the light of the sky.

const ADDON := "lobelight"
const ANISOTROPY := 0.9


func go() -> void:
	await _enable()
	await _mouse.click(Finder.button(_root, "3D Scene"), "3D Scene")
	await _mouse.click(Finder.button(_root, "Edit Sun and Environment settings"), "⋮")
	await _mouse.click(Finder.button(_root, "Add Environment to Scene"), "Add Environment to Scene")
	await _add_node("LobeE")
	_expect(EditorInterface.get_edited_scene_root().find_child("LobeEnvironment3D") != null, "node")
	await _mouse.wait(2.0)
	await _take.call("2_environment")
	var tree: Tree = Finder.of_class(Finder.of_class(_root, "SceneTreeEditor"), "Tree")
	await _mouse.choose_item(tree, tree.get_root(), 0, "the root")
	await _add_node("MeshI")
	await _choose_resource(&"mesh", "SphereMesh")
	await _unfold("Geometry")
	await _choose_resource(&"material_override", "LobeMaterial3D")
	await _mouse.wait(2.0)
	await _take.call("3_sphere")
	await _mouse.click(Finder.button(Finder.property(&"material_override"), ""), "the material")
	await _mouse.wait(1.0)
	await _unfold("Anisotropy")
	await _drag_anisotropy()
	await _mouse.wait(2.0)
	await _take.call("4_material")


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
	await _take.call("1_enable")
	await _mouse.click(Finder.button(settings, "Close"), "Close")


func _drag_anisotropy() -> void:
	var property := Finder.property(&"anisotropy")
	await _mouse.scroll_to(EditorInterface.get_inspector(), property)
	var slider := Finder.of_class(property, "EditorSpinSlider") as EditorSpinSlider
	# The grabber shows below the mouse.
	await _mouse.move(_mouse.find_rect(slider).get_center())
	var grabber := Finder.of_class(slider, "TextureRect") as Control
	var range_of_values := slider.max_value - slider.min_value
	var way := slider.size.x - grabber.size.x if grabber != null else 0.0
	await _mouse.drag(grabber, Vector2(way * ANISOTROPY / range_of_values, 0.0), "Anisotropy")
	var value: float = property.get_edited_object().get(&"anisotropy")
	_expect(absf(value - ANISOTROPY) < 0.1, "anisotropy of 0.9, not %s" % value)
