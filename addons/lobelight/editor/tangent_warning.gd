@tool
extends EditorInspectorPlugin
## A warning in the inspector of a node whose mesh lacks the tangents that its [LobeMaterial3D]
## needs. The engine makes some up then: brushed surfaces and normal maps look wrong.

const WarningLabel := preload("warnings/warning_label.gd")


func _can_handle(object: Object) -> bool:
	return object is MeshInstance3D


func _parse_begin(object: Object) -> void:
	var surfaces := find_surfaces(object as MeshInstance3D)
	if not surfaces.is_empty():
		add_custom_control(WarningLabel.new(get_text(surfaces)))


## The surfaces of a node that lack what their material needs.
static func find_surfaces(instance: MeshInstance3D) -> PackedInt32Array:
	var found: PackedInt32Array = []
	if instance.mesh == null:
		return found
	for surface in instance.mesh.get_surface_count():
		var material := instance.get_active_material(surface) as LobeMaterial3D
		if material != null and material.needs_tangents() and not _has(instance.mesh, surface):
			found.append(surface)
	return found


static func get_text(surfaces: PackedInt32Array) -> String:
	var names: PackedStringArray = []
	for surface in surfaces:
		names.append(str(surface))
	return (
		(
			"LobeMaterial3D: the mesh has no tangents on surface %s, which anisotropy and normal maps "
			+ "need. Import it with Ensure Tangents, or call SurfaceTool.generate_tangents()."
		)
		% ", ".join(names)
	)


# The engine stores tangents for every mesh with normals. To one without, it gives
# (n.z, -n.x, n.y) × n (Godot 4.6, RenderingServer::_surface_set_data): if all are that, nobody made
# any.
static func _has(mesh: Mesh, surface: int) -> bool:
	if mesh is PrimitiveMesh:
		return true
	var arrays := mesh.surface_get_arrays(surface)
	if arrays[Mesh.ARRAY_NORMAL] == null or arrays[Mesh.ARRAY_TANGENT] == null:
		return false
	var normals: PackedVector3Array = arrays[Mesh.ARRAY_NORMAL]
	var tangents: PackedFloat32Array = arrays[Mesh.ARRAY_TANGENT]
	for i in normals.size():
		var n := normals[i]
		var made_up := Vector3(n.z, -n.x, n.y).cross(n)
		var tangent := Vector3(tangents[4 * i], tangents[4 * i + 1], tangents[4 * i + 2])
		# Of 16 bits; where the made-up one is all but zero, it says nothing.
		if made_up.length() > 0.1 and made_up.normalized().dot(tangent.normalized()) < 0.999:
			return true
	return false
