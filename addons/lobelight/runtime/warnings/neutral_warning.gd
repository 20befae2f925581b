@tool
extends Object
## Says once in a running game that no [LobeEnvironment3D] lights what is seen. Exports leave it
## out.

const LightRegistry := preload("../light/light_registry.gd")

# Milliseconds from one look to the next: scenes may be loaded slowly, or after a menu.
const _PAUSES: Array[int] = [2000, 3000, 5000, 10000, 20000, 40000]

static var _count := 0
static var _time := 0


## Looks at the scene in a while, and a few times more.
static func begin(tree: SceneTree) -> void:
	if _count == 0:
		_time = Time.get_ticks_msec() + _PAUSES[0]
		tree.process_frame.connect(_wait)


## What is to be said of a scene; empty if nothing is.
static func find_sentence(root: Node) -> String:
	if not LightRegistry.is_unlit():
		return ""
	for node: GeometryInstance3D in root.find_children("*", "GeometryInstance3D", true, false):
		if node.is_visible_in_tree() and _list_materials(node).any(_awaits_light):
			return (
				(
					"LobeMaterial3D: %s shows a neutral map, as there is no LobeEnvironment3D: add one to "
					+ "the scene, and it takes the light of the sky."
				)
				% node.get_path()
			)
	return ""


static func _wait() -> void:
	if Time.get_ticks_msec() < _time:
		return
	var tree := Engine.get_main_loop() as SceneTree
	var sentence := find_sentence(tree.root)
	_count = _PAUSES.size() if sentence else _count + 1
	if sentence:
		push_warning(sentence)
	if _count < _PAUSES.size():
		_time += _PAUSES[_count]
	else:
		tree.process_frame.disconnect(_wait)


static func _awaits_light(material: Material) -> bool:
	return material != null and LightRegistry.awaits_light(material.get_rid())


static func _list_materials(node: GeometryInstance3D) -> Array[Material]:
	var found: Array[Material] = [node.material_override, node.material_overlay]
	var instance := node as MeshInstance3D
	var many := node as MultiMeshInstance3D
	if instance != null:
		for surface in instance.get_surface_override_material_count():
			found.append(instance.get_active_material(surface))
	elif many != null and many.multimesh != null and many.multimesh.mesh != null:
		for surface in many.multimesh.mesh.get_surface_count():
			found.append(many.multimesh.mesh.surface_get_material(surface))
	elif &"material" in node:
		found.append(node.get(&"material"))
	return found
