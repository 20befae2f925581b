extends GdUnitTestSuite
## The inspector's warning about meshes without tangents.

const OwnShaderTangents := preload(
	"res://addons/lobelight/editor/own_shaders/own_shader_tangents.gd"
)
const TangentWarning := preload("res://addons/lobelight/editor/tangent_warning.gd")

const _OWN := """shader_type spatial;
render_mode ambient_light_disabled;
%s
#include "res://addons/lobelight/lobelight.gdshaderinc"
void fragment() {
	LobelightPixel pixel = LOBELIGHT_PIXEL;
	EMISSION = lobelight_reflection(pixel, NORMAL, %s, 0.3, 0.8, vec3(0.9));
}
"""


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


func test_own_shaders_with_anisotropic_lobes_are_told_once() -> void:
	var instance: MeshInstance3D = auto_free(MeshInstance3D.new())
	var mesh := ArrayMesh.new()
	var arrays := SphereMesh.new().get_mesh_arrays()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	arrays[Mesh.ARRAY_TANGENT] = null
	for surface in 2:
		mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	instance.mesh = mesh
	var material := ShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = _OWN % ["", "TANGENT"]
	instance.material_override = material
	# Nobody lights it yet.
	assert_array(TangentWarning.of(instance)).is_empty()
	LobeLight.bind(material)
	assert_array(TangentWarning.find_own_surfaces(instance)).is_equal(PackedInt32Array([1, 2]))
	var sentences := TangentWarning.of(instance)
	assert_int(sentences.size()).is_equal(1)
	assert_str(sentences[0]).contains("no tangents on surface 1, 2")
	for rest: Array in [
		["#define LOBELIGHT_ISOTROPIC", "TANGENT"],
		# A direction of its own.
		["// not TANGENT", "cross(NORMAL, vec3(0.0, 1.0, 0.0))"],
	]:
		material.shader.code = _OWN % rest
		assert_array(TangentWarning.of(instance)).is_empty()
	material.shader.code = _OWN % ["", "TANGENT"]
	assert_array(TangentWarning.of(instance)).is_not_empty()
	instance.mesh = SphereMesh.new()
	assert_array(TangentWarning.of(instance)).is_empty()
	# A LobeShaderMaterial binds itself; the surfaces of LobeMaterial3Ds are told apart.
	instance.mesh = mesh
	instance.material_override = null
	var own := LobeShaderMaterial.new()
	own.shader = material.shader
	var brushed := LobeMaterial3D.new()
	brushed.metallic = 1.0
	brushed.anisotropy = 0.5
	brushed.anisotropy_enabled = true
	instance.set_surface_override_material(1, own)
	instance.set_surface_override_material(2, brushed)
	sentences = TangentWarning.of(instance)
	assert_int(sentences.size()).is_equal(2)
	assert_str(sentences[0]).starts_with("LobeMaterial3D: ").contains("surface 2,")
	assert_str(sentences[1]).contains("surface 1,")


func test_graphs_need_tangents_where_they_are_brushed() -> void:
	var graph := VisualShader.new()
	var node := VisualShaderNodeLobelightReflection.new()
	graph.add_node(VisualShader.TYPE_FRAGMENT, node, Vector2.ZERO, 2)
	graph.connect_nodes(VisualShader.TYPE_FRAGMENT, 2, 1, 0, 5)
	var material := LobeShaderMaterial.new()
	material.shader = graph
	assert_bool(OwnShaderTangents.are_needed(material)).is_false()
	node.set_input_port_default_value(node.ANISOTROPY, 0.5)
	assert_bool(OwnShaderTangents.are_needed(material)).is_true()
