@tool
extends RefCounted
## What a scene has of Lobelight: its materials, their tables, its environments and its probes.

const Slots := preload("../conversion/material_slots.gd")
const TangentWarning := preload("../tangent_warning.gd")

## The materials, and the nodes that show them.
var materials: Dictionary[LobeMaterial3D, Array] = {}
## All others with shaders, and the nodes that show them.
var shader_materials: Dictionary[ShaderMaterial, Array] = {}
var tables: Array[LobeTable] = []
var environments: Array[LobeEnvironment3D] = []
var probes: Array[LobeProbe3D] = []
## Nodes whose meshes lack the tangents that their materials need.
var without_tangents: Array[MeshInstance3D] = []


## Looks at a node and all below it.
static func of(root: Node) -> RefCounted:
	var usage := new()
	if root != null:
		usage._look_at(root)
	return usage


## The environments among a node and all below it. In the tree they are known: warnings ask over and
## over, and a walk through a large scene takes milliseconds.
static func find_environments(root: Node) -> Array[LobeEnvironment3D]:
	var found: Array[LobeEnvironment3D] = []
	if root == null:
		return found
	var nodes: Array[Node] = [root]
	if root.is_inside_tree():
		nodes = root.get_tree().get_nodes_in_group(LobeEnvironment3D._GROUP)
	else:
		nodes.append_array(root.find_children("*", "LobeEnvironment3D", true, false))
	for node in nodes:
		if node is LobeEnvironment3D and (node == root or root.is_ancestor_of(node)):
			found.append(node)
	return found


func _look_at(node: Node) -> void:
	if node is LobeEnvironment3D:
		environments.append(node)
	if node is LobeProbe3D:
		probes.append(node)
	for material in _find_all(node):
		if material is ShaderMaterial and not material is LobeMaterial3D:
			var users: Array = shader_materials.get_or_add(material, [])
			users.append(node)
	for material in find_materials(node):
		if not materials.has(material):
			materials[material] = []
		materials[material].append(node)
		if material.table != null and material.table not in tables:
			tables.append(material.table)
	var instance := node as MeshInstance3D
	if instance != null and not TangentWarning.of(instance).is_empty():
		without_tangents.append(instance)
	for child in node.get_children():
		_look_at(child)


## The LobeMaterial3Ds that a node is drawn with, in next passes too.
static func find_materials(node: Node) -> Array[LobeMaterial3D]:
	var found: Array[LobeMaterial3D] = []
	for material in _find_all(node):
		if material is LobeMaterial3D:
			found.append(material)
	return found


static func _find_all(node: Node) -> Array[Material]:
	var found: Array[Material] = []
	for material in _find_first_passes(node):
		while material != null and material not in found:
			found.append(material)
			material = material.next_pass
	return found


static func _find_first_passes(node: Node) -> Array[Material]:
	var materials: Array[Material] = []
	var instance := node as MeshInstance3D
	if instance != null and instance.mesh != null:
		materials = [instance.material_override, instance.material_overlay]
		for surface in instance.mesh.get_surface_count():
			# An override hides the others.
			materials.append(instance.get_active_material(surface))
		return materials
	for slot in Slots.of(node):
		materials.append_array(slot.materials)
	return materials
