extends RefCounted
## The sphere of [SphereImpostor] under another method's shader.


## A quad whose material is the shader include [param path] of this folder, which has a function
## [param function] like lobelight_specular, after the lines [param defines]. With [param light] it
## has what environment.gdshaderinc asks for; with [param room] the function gets the place of
## the pixel first, see room_box.gdshaderinc.
static func make(
	path: String,
	function: String,
	defines: PackedStringArray,
	parameters: Dictionary,
	light: LobeLight = null,
	room: CompareRoom = null
) -> MeshInstance3D:
	var folder := SphereImpostor.FRAGMENT_PATH.get_base_dir()
	var code := "shader_type spatial;\nrender_mode ambient_light_disabled;\n"
	if light != null and not light.is_even:
		code += "#define LOBELIGHT_STRETCHED_LEVELS\n"
	for define in defines:
		code += "#define %s\n" % define
	code += "#define SPHERE_SPECULAR%s %s\n" % ["_AT" if room != null else "", function]
	code += '#include "%s"\n' % folder.path_join("comparators").path_join(path)
	code += '#include "%s"\n' % SphereImpostor.FRAGMENT_PATH
	var material := ShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = code
	material.set_shader_parameter(&"lobelight_albedo", Vector3.ONE)
	material.set_shader_parameter(&"lobelight_environment_rotation", Basis.IDENTITY)
	material.set_shader_parameter(&"lobelight_environment_energy", 1.0)
	if room != null:
		material.set_shader_parameter(&"room_half", 0.5 * room.size)
		material.set_shader_parameter(&"room_probe", room.probe)
	for parameter: StringName in parameters:
		material.set_shader_parameter(parameter, parameters[parameter])
	if light != null:
		light.apply(material.get_rid())
	return SphereImpostor.make_quad(material)
