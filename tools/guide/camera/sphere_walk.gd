@tool
extends "walk.gd"
## The guide's list of clicks, from an empty project to a brushed sphere in the light of the sky.

const ADDON := "lobelight"
const LOOK := "Brushed Metal"
# That of the look.
const ANISOTROPY := 0.95


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
	await _choose_preset()
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


func _choose_preset() -> void:
	var choice := Finder.button(EditorInterface.get_inspector(), "Choose …")
	await _mouse.scroll_to(EditorInterface.get_inspector(), choice)
	await _mouse.click(choice, "Preset")
	await _mouse.choose(choice, LOOK)
	await _mouse.wait(1.0)
	var material: LobeMaterial3D = EditorInterface.get_inspector().get_edited_object().get(
		&"material_override"
	)
	_expect(material.anisotropy == ANISOTROPY, "a look of anisotropy %s" % ANISOTROPY)
