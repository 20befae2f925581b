extends GdUnitTestSuite
## The inspector's warning about meshes without tangents.

const TangentWarning := preload("res://addons/lobelight/editor/tangent_warning.gd")


func test_meshes_that_lack_tangents_are_found() -> void:
	var instance: MeshInstance3D = auto_free(MeshInstance3D.new())
	assert_array(TangentWarning.find_surfaces(instance)).is_empty()
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.4
	# Surface 0 has tangents, surface 1 has none.
	var mesh := ArrayMesh.new()
	var arrays := SphereMesh.new().get_mesh_arrays()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	arrays[Mesh.ARRAY_TANGENT] = null
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	instance.mesh = mesh
	instance.material_override = material
	assert_array(TangentWarning.find_surfaces(instance)).is_empty()
	material.anisotropy = 0.5
	material.anisotropy_enabled = true
	assert_array(TangentWarning.find_surfaces(instance)).is_equal(PackedInt32Array([1]))
	assert_str(TangentWarning.get_text([1])).contains("no tangents on surface 1")
	material.anisotropy = 0.0
	material.normal_texture = PlaceholderTexture2D.new()
	material.normal_enabled = true
	assert_array(TangentWarning.find_surfaces(instance)).is_equal(PackedInt32Array([1]))
	instance.material_override = StandardMaterial3D.new()
	assert_array(TangentWarning.find_surfaces(instance)).is_empty()
	instance.material_override = material
	instance.mesh = SphereMesh.new()
	assert_array(TangentWarning.find_surfaces(instance)).is_empty()
	# Without normals, there is nothing to make tangents from.
	arrays[Mesh.ARRAY_NORMAL] = null
	mesh.clear_surfaces()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	instance.mesh = mesh
	assert_array(TangentWarning.find_surfaces(instance)).is_equal(PackedInt32Array([0]))
