@tool
extends Object
## Where a node has the materials that it is drawn with.
##
## Materials inside of meshes are overridden at the node where nodes can do that. MultiMeshes,
## particles, libraries and CSG can do it for all surfaces at once only; where these differ, the
## node gets a copy of the mesh.

const Slot := preload("material_slot.gd")


## The places of a node that hold materials. Those that scripts or other nodes hold are not among
## them, see [method find_others].
static func of(node: Node) -> Array[Slot]:
	var found: Array[Slot] = []
	var grid := _as(node, &"GridMap")
	if grid != null:
		_add_library(grid, found)
	var geometry := node as GeometryInstance3D
	if geometry == null:
		return found
	for property: String in ["material_override", "material_overlay"]:
		var material: Material = geometry.get(property)
		if material != null:
			found.append(Slot.new(geometry, property, [material]))
	if node is MeshInstance3D:
		_add_surfaces(node as MeshInstance3D, found)
	elif _as(node, &"CSGShape3D") != null:
		_add_csg(node, found)
	elif geometry.material_override == null:
		# Where there is one, nothing shows what is below it.
		_add_inner(geometry, found)
	return found


## What a node is drawn with that is nobody's material, in words; empty for most nodes.
static func find_others(node: Node) -> PackedStringArray:
	var found: PackedStringArray = []
	if node is SpriteBase3D or node is Label3D:
		if (node as GeometryInstance3D).material_override == null:
			found.append("%ss are drawn with a material of the engine's own" % node.get_class())
	elif node.get_class() == "ImporterMeshInstance3D":
		found.append("its mesh has not been imported yet")
	elif node is AnimationMixer:
		_find_animated(node as AnimationMixer, found)
	if node.get_script() == null:
		return found
	for property in node.get_property_list():
		if property["usage"] & PROPERTY_USAGE_SCRIPT_VARIABLE == 0:
			continue
		if property["usage"] & PROPERTY_USAGE_STORAGE and node.get(property["name"]) is Material:
			found.append("its script's property %s holds a material" % property["name"])
	return found


static func _find_animated(mixer: AnimationMixer, found: PackedStringArray) -> void:
	for name in mixer.get_animation_list():
		var animation := mixer.get_animation(name)
		for track in animation.get_track_count():
			if animation.track_get_type(track) != Animation.TYPE_VALUE:
				continue
			for key in animation.track_get_key_count(track):
				if animation.track_get_key_value(track, key) is Material:
					found.append("its animation %s sets materials" % name)
					break


static func _add_surfaces(instance: MeshInstance3D, found: Array[Slot]) -> void:
	if instance.mesh == null:
		return
	for surface in instance.mesh.get_surface_count():
		var material := instance.get_surface_override_material(surface)
		if material == null:
			material = instance.mesh.surface_get_material(surface)
		if material == null:
			continue
		var slot := Slot.new(instance, "surface_material_override/%d" % surface, [material])
		slot.sources = [slot.property, "mesh"]
		found.append(slot)


static func _add_csg(node: Node, found: Array[Slot]) -> void:
	# Combiners have none.
	var material: Material = node.get("material") if "material" in node else null
	if material != null:
		found.append(Slot.new(node, "material", [material]))
		return
	var mesh: Mesh = node.get("mesh") if "mesh" in node else null
	if mesh != null:
		_add_mesh(node, "mesh", mesh, "material", found)


static func _add_inner(geometry: GeometryInstance3D, found: Array[Slot]) -> void:
	var many := geometry as MultiMeshInstance3D
	if many != null and many.multimesh != null and many.multimesh.mesh != null:
		_add_mesh(many, "multimesh", many.multimesh.mesh, "material_override", found)
	elif geometry is CPUParticles3D and (geometry as CPUParticles3D).mesh != null:
		_add_mesh(geometry, "mesh", geometry.get("mesh"), "material_override", found)
	elif geometry is GPUParticles3D:
		_add_passes(geometry as GPUParticles3D, found)


static func _add_passes(particles: GPUParticles3D, found: Array[Slot]) -> void:
	var meshes: Dictionary[String, Mesh] = {}
	for index in particles.draw_passes:
		var mesh := particles.get_draw_pass_mesh(index)
		if mesh != null:
			meshes["draw_pass_%d" % (index + 1)] = mesh
	for property in meshes:
		# An override is for all passes.
		var override := "material_override" if meshes.size() == 1 else ""
		_add_mesh(particles, property, meshes[property], override, found)


# The materials of a mesh that a property holds, itself or in a MultiMesh: of a single one by the
# property for all surfaces, of several by a copy of the mesh.
static func _add_mesh(
	node: Node, property: String, mesh: Mesh, override: String, found: Array[Slot]
) -> void:
	var materials := get_materials(mesh)
	var first: Material = materials[0] if not materials.is_empty() else null
	var is_one := materials.all(func(other: Material) -> bool: return other == first)
	if first != null and is_one and override:
		var slot := Slot.new(node, override, [first])
		slot.sources = [override, property]
		found.append(slot)
	elif materials.any(func(other: Material) -> bool: return other != null):
		var slot := Slot.new(node, property, materials)
		slot.is_holder = true
		slot.problem = _find_problem(mesh)
		found.append(slot)


static func _add_library(grid: Node, found: Array[Slot]) -> void:
	var library: MeshLibrary = grid.get("mesh_library")
	if library == null:
		return
	var materials: Array[Material] = []
	var slot := Slot.new(grid, "mesh_library")
	for item in library.get_item_list():
		var mesh := library.get_item_mesh(item)
		if mesh != null:
			materials.append_array(get_materials(mesh))
			if slot.problem.is_empty():
				slot.problem = _find_problem(mesh)
	slot.materials = materials
	slot.is_holder = true
	if not (grid.get("baked_meshes") as Array).is_empty():
		slot.problem = "its meshes are baked: Clear Baked Meshes first"
	found.append(slot)


## The materials of a mesh by surface.
static func get_materials(mesh: Mesh) -> Array[Material]:
	var materials: Array[Material] = []
	for surface in mesh.get_surface_count():
		materials.append(mesh.surface_get_material(surface))
	return materials


static func _find_problem(mesh: Mesh) -> String:
	if mesh is ArrayMesh or mesh is PrimitiveMesh:
		return ""
	return "a mesh of the class %s cannot be copied" % mesh.get_class()


# The node, if it is of a class that the engine may have been built without.
static func _as(node: Node, type: StringName) -> Node:
	return node if node.is_class(type) else null
