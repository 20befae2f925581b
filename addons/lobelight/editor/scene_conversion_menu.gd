@tool
extends EditorContextMenuPlugin
## "Convert Materials to LobeMaterial3D" in the menu of the scene tree: what the selected nodes
## and those below them draw with Godot's own materials, they draw with LobeMaterial3Ds. It can be
## undone. Materials of meshes are overridden in the nodes, because imported meshes cannot be
## changed; instanced scenes get Editable Children for it, since scenes are saved without what else
## has been changed in them.

const ConversionPlugin := preload("material_conversion_plugin.gd")
const SceneUsage := preload("menu/scene_usage.gd")
const Wording := preload("wording.gd")

var _undo_redo: EditorUndoRedoManager


func _init(undo_redo: EditorUndoRedoManager = null) -> void:
	_undo_redo = undo_redo


func _popup_menu(_paths: PackedStringArray) -> void:
	add_context_menu_item("Convert Materials to LobeMaterial3D", convert_nodes)


## The changes to make, in order: [code][node, property, new material][/code]. What several nodes
## share they go on sharing.
static func find_changes(nodes: Array[Node]) -> Array[Array]:
	var changes: Array[Array] = []
	var made: Dictionary[BaseMaterial3D, LobeMaterial3D] = {}
	var seen: Dictionary[Node, bool] = {}
	for root in nodes:
		var all := root.find_children("*", "GeometryInstance3D", true, false)
		all.push_front(root)
		for node in all:
			if seen.has(node):
				continue
			seen[node] = true
			for entry in _find_materials(node):
				var source: BaseMaterial3D = entry[1]
				if not made.has(source):
					made[source] = ConversionPlugin.convert_to_lobes(source)
				changes.append([node, entry[0], made[source]])
	return changes


# Properties of a node that hold or would override one of Godot's materials, and the material.
static func _find_materials(node: Node) -> Array[Array]:
	var found: Array[Array] = []
	var geometry := node as GeometryInstance3D
	if geometry == null:
		return found
	if geometry.material_override is BaseMaterial3D:
		found.append(["material_override", geometry.material_override])
	var instance := node as MeshInstance3D
	if instance != null and instance.mesh != null:
		for surface in instance.mesh.get_surface_count():
			var material := instance.get_surface_override_material(surface)
			if material == null:
				material = instance.mesh.surface_get_material(surface)
			if material is BaseMaterial3D:
				found.append(["surface_material_override/%d" % surface, material])
	elif "material" in node and node.get("material") is BaseMaterial3D:
		# CSG shapes.
		found.append(["material", node.get("material")])
	return found


## The instanced scenes that must become editable for changes in them to be saved with the scene of
## [param root], outer ones first.
static func find_instances(changes: Array[Array], root: Node) -> Array[Node]:
	var found: Array[Node] = []
	for change in changes:
		for instance in _find_owners(change[0], root):
			if instance not in found and not root.is_editable_instance(instance):
				found.append(instance)
	return found


## Those of the changes that are saved with the scene of [param root]: not those of what scripts
## have added to it.
static func find_saved(changes: Array[Array], root: Node) -> Array[Array]:
	return changes.filter(
		func(change: Array) -> bool:
			var node: Node = change[0]
			var owners := _find_owners(node, root)
			var outermost := node if owners.is_empty() else owners[0]
			return node == root or outermost.owner == root
	)


# The instances that a node is in, below the root, outer ones first.
static func _find_owners(node: Node, root: Node) -> Array[Node]:
	var owners: Array[Node] = []
	var next := node.owner if node != root else null
	while next != null and next != root:
		owners.push_front(next)
		next = next.owner
	return owners


## What is said of changes to a scene, and of the light that its materials lack then.
static func describe(changes: Array[Array], root: Node) -> String:
	if changes.is_empty():
		return "There is no material of Godot's own to be converted."
	var made: Dictionary[LobeMaterial3D, bool] = {}
	for change in changes:
		made[change[2]] = true
	var sentence := "Converted %s." % Wording.count(made.size(), "material")
	if SceneUsage.find_environments(root).is_empty():
		# The editor cuts notes off that are longer.
		sentence += " Add a LobeEnvironment3D: nothing lights them yet."
	return sentence


## Converts the materials of nodes and of those below them, by one action that can be undone.
func convert_nodes(nodes: Array) -> void:
	var roots: Array[Node] = []
	roots.assign(nodes)
	var root := EditorInterface.get_edited_scene_root()
	var changes := find_saved(find_changes(roots), root)
	var instances := find_instances(changes, root)
	var toaster := EditorInterface.get_editor_toaster()
	toaster.push_toast(describe(changes, root))
	if changes.is_empty():
		return
	if not instances.is_empty():
		toaster.push_toast(
			"Editable Children is now on for %s." % Wording.count(instances.size(), "instance")
		)
	_undo_redo.create_action("Convert Materials to LobeMaterial3D")
	for instance in instances:
		_undo_redo.add_do_method(root, "set_editable_instance", instance, true)
		_undo_redo.add_undo_method(root, "set_editable_instance", instance, false)
	for change in changes:
		var node: Node = change[0]
		var property: String = change[1]
		_undo_redo.add_do_property(node, property, change[2])
		_undo_redo.add_undo_property(node, property, node.get(property))
	_undo_redo.commit_action()
