@tool
extends "walk.gd"
## From an empty project to a brushed sphere by hand: the guide's longer list of clicks, without
## pictures.

# That of the look.
const ANISOTROPY := 0.95


func go() -> void:
	await _enable()
	await _close_settings()
	await _mouse.click(Finder.button(_root, "3D Scene"), "3D Scene")
	await _mouse.click(Finder.button(_root, "Edit Sun and Environment settings"), "⋮")
	await _mouse.click(Finder.button(_root, "Add Environment to Scene"), "Add Environment to Scene")
	await _add_node("LobeE")
	_expect(EditorInterface.get_edited_scene_root().find_child("LobeEnvironment3D") != null, "node")
	var tree: Tree = Finder.of_class(Finder.of_class(_root, "SceneTreeEditor"), "Tree")
	await _mouse.choose_item(tree, tree.get_root(), 0, "the root")
	await _add_node("MeshI")
	await _choose_resource(&"mesh", "SphereMesh")
	await _unfold("Geometry")
	await _choose_resource(&"material_override", "LobeMaterial3D")
	await _mouse.click(Finder.button(Finder.property(&"material_override"), ""), "the material")
	await _mouse.wait(1.0)
	await _choose_preset()


func _choose_preset() -> void:
	var choice := Finder.button(EditorInterface.get_inspector(), "Choose …")
	await _mouse.scroll_to(EditorInterface.get_inspector(), choice)
	await _mouse.click(choice, "Preset")
	await _mouse.choose(choice, "Brushed Metal")
	await _mouse.wait(1.0)
	var material: LobeMaterial3D = EditorInterface.get_inspector().get_edited_object().get(
		&"material_override"
	)
	_expect(material.anisotropy == ANISOTROPY, "a look of anisotropy %s" % ANISOTROPY)
