@tool
extends "walk.gd"
## The guide's list of clicks, from an empty project to a brushed sphere in the light of the sky.

const ITEM := "Create Brushed Sphere"
const NODES: Array[String] = [
	"WorldEnvironment", "DirectionalLight3D", "LobeEnvironment3D", "BrushedSphere"
]


func go() -> void:
	await _enable()
	await _take.call("1_enable")
	await _close_settings()
	await _mouse.click(Finder.button(_root, "Lobelight"), "Lobelight")
	var menu := await _mouse.find_menu(_root, ITEM)
	await _mouse.wait(0.5)
	await _take.call("3_create")
	await _mouse.choose_from(menu, ITEM)
	await _mouse.wait(3.0)
	var root := EditorInterface.get_edited_scene_root()
	for node in NODES:
		_expect(root != null and root.has_node(node), node)
	var shown := EditorInterface.get_inspector().get_edited_object()
	_expect(shown is LobeMaterial3D, "material in the inspector")
	await _take.call("4_material")
