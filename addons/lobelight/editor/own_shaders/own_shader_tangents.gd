@tool
extends Object
## Whether a shader of one's own needs a mesh's tangents.

const Binding := preload("../../runtime/own_shaders/shader_binding.gd")
const CodeText := preload("../export/shader_text.gd")
const OwnShaders := preload("../export/own_shaders.gd")

# The table of lobes: a Texture3D where the shader draws anisotropic ones.
const _TABLE := "lobelight_table"


## Of a bound material: its shader has anisotropic lobes, and its text, or a file of the project
## that it includes, names the mesh's tangent. One that computes a direction of its own needs none.
static func are_needed(material: ShaderMaterial) -> bool:
	var shader := material.shader
	if shader == null or not Binding.is_bound(material) or not _is_anisotropic(shader):
		return false
	return _names_tangent(shader.code, shader.resource_path.get_slice("::", 0), {})


static func _is_anisotropic(shader: Shader) -> bool:
	# The include comes into graphs when they are drawn.
	if OwnShaders.NODES in shader.code:
		return not Binding.is_round(shader.code)
	for parameter: Dictionary in RenderingServer.get_shader_parameter_list(shader.get_rid()):
		if parameter["name"] == _TABLE:
			return "3D" in parameter["hint_string"]
	return false


static func _names_tangent(code: String, file: String, read: Dictionary[String, bool]) -> bool:
	var text := CodeText.without_comments(code)
	# What nodes of graphs call it where nothing is connected.
	var tangent := RegEx.create_from_string("\\b(LOBELIGHT_NODE_)?TANGENT\\b")
	if tangent.search(text) != null:
		return true
	var include := RegEx.create_from_string('(?m)^\\s*#include\\s+"([^"]+)"')
	for found in include.search_all(text):
		var path := OwnShaders.find_path(found.get_string(1), file)
		if path.begins_with(OwnShaders.ADDON) or read.has(path) or not FileAccess.file_exists(path):
			continue
		read[path] = true
		if _names_tangent(FileAccess.get_file_as_string(path), path, read):
			return true
	return false
