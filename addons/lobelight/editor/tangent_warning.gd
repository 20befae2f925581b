@tool
extends EditorInspectorPlugin
## A warning in the inspector of a node whose mesh lacks the tangents that its [LobeMaterial3D], or
## a shader of one's own, needs. The engine makes some up then: brushed surfaces and normal maps
## look wrong.

const OwnShaderTangents := preload("own_shaders/own_shader_tangents.gd")
const WarningLabel := preload("warnings/warning_label.gd")


func _can_handle(object: Object) -> bool:
	return object is MeshInstance3D


func _parse_begin(object: Object) -> void:
	for sentence in of(object as MeshInstance3D):
		add_custom_control(WarningLabel.new(sentence))


## A sentence for the surfaces with a [LobeMaterial3D] that lack tangents, and one for those with a
## shader of one's own.
static func of(instance: MeshInstance3D) -> PackedStringArray:
	var sentences: PackedStringArray = []
	var surfaces := find_surfaces(instance)
	if not surfaces.is_empty():
		sentences.append(get_text(surfaces))
	surfaces = find_own_surfaces(instance)
	if not surfaces.is_empty():
		sentences.append(get_own_text(surfaces))
	return sentences


## The surfaces of a node that lack what their [LobeMaterial3D] needs.
static func find_surfaces(instance: MeshInstance3D) -> PackedInt32Array:
	return _find(instance, _is_needed_by_lobes)


## The surfaces of a node that lack what their material's own shader needs.
static func find_own_surfaces(instance: MeshInstance3D) -> PackedInt32Array:
	return _find(instance, _is_needed_by_own_shader)


static func get_text(surfaces: PackedInt32Array) -> String:
	return (
		(
			"LobeMaterial3D: the mesh has no tangents on surface %s, which anisotropy and normal maps "
			+ "need. Import it with Ensure Tangents, or call SurfaceTool.generate_tangents()."
		)
		% _list(surfaces)
	)


static func get_own_text(surfaces: PackedInt32Array) -> String:
	return (
		(
			"The mesh has no tangents on surface %s, which its shader's anisotropy needs: import it "
			+ "with Ensure Tangents, or #define LOBELIGHT_ISOTROPIC in the shader if nothing is brushed."
		)
		% _list(surfaces)
	)


static func _find(instance: MeshInstance3D, is_needed: Callable) -> PackedInt32Array:
	var found: PackedInt32Array = []
	if instance.mesh == null:
		return found
	for surface in instance.mesh.get_surface_count():
		var material := instance.get_active_material(surface)
		if is_needed.call(material) and not _has(instance.mesh, surface):
			found.append(surface)
	return found


static func _is_needed_by_lobes(material: Material) -> bool:
	return material is LobeMaterial3D and (material as LobeMaterial3D).needs_tangents()


static func _is_needed_by_own_shader(material: Material) -> bool:
	if material is LobeMaterial3D or not material is ShaderMaterial:
		return false
	return OwnShaderTangents.are_needed(material as ShaderMaterial)


static func _list(surfaces: PackedInt32Array) -> String:
	return ", ".join(Array(surfaces).map(str))


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
