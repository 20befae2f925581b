@tool
extends Object
## The shader variant of a [LobeMaterial3D]: its render modes and defines.

const MaterialInputs := preload("material_inputs.gd")
const LightRegistry := preload("../light/light_registry.gd")
const TableChoice := preload("table_choice.gd")

const _BLEND_MODES: PackedStringArray = [
	"blend_mix", "blend_add", "blend_sub", "blend_mul", "blend_premul_alpha"
]
const _CULL_MODES: PackedStringArray = ["cull_back", "cull_front", "cull_disabled"]
const _FILTERS: PackedStringArray = [
	"filter_nearest",
	"filter_linear",
	"filter_nearest_mipmap",
	"filter_linear_mipmap",
	"filter_nearest_mipmap_anisotropic",
	"filter_linear_mipmap_anisotropic",
]
## Lookups of the diffuse light, see diffuse/diffuse.gdshaderinc.
const DIFFUSE_FETCHES := 6


## Everything before the include of the fragment function.
static func get_code(inputs: MaterialInputs, choice: TableChoice) -> String:
	var code := "shader_type spatial;\nrender_mode %s;\n" % ", ".join(_render_modes(inputs))
	for name in _defines(inputs, choice):
		code += "#define LOBELIGHT_%s\n" % name
	return code


## See [method LobeMaterial3D.get_fetches].
static func count_fetches(inputs: MaterialInputs, choice: TableChoice) -> Dictionary[String, int]:
	var defines := _defines(inputs, choice)
	var environment := choice.lobe_count
	var table := choice.lobe_count
	var samplers := 2
	if "SECOND_TEXELS" in defines or ("WIDTHS_PER_PIXEL" in defines and not choice.is_isotropic):
		table *= 2
	if "DIELECTRIC" in defines:
		environment += DIFFUSE_FETCHES
	if choice.coat != null:
		environment += choice.coat.lobe_count
		table += choice.coat.lobe_count
		samplers += 1
	if "PLACED" in defines:
		samplers += _count_placed_samplers(defines)
	return {"environment": environment, "table": table, "samplers": samplers}


# See probes/placed_light.gdshaderinc: the list, and an array of cube maps or four of them.
static func _count_placed_samplers(defines: PackedStringArray) -> int:
	if RenderingServer.get_current_rendering_method() == "gl_compatibility":
		return 5
	var samplers := 2
	for define in defines:
		if define.begins_with("ENVIRONMENTS "):
			samplers += define.get_slice(" ", 1).to_int()
	return samplers


static func _render_modes(inputs: MaterialInputs) -> PackedStringArray:
	var modes: PackedStringArray = ["ambient_light_disabled"]
	# What is the engine's default is left out.
	if inputs.is_dielectric():
		# As Godot's own materials are lit by its lights.
		modes.append("diffuse_burley")
	if inputs.blend_mode != BaseMaterial3D.BLEND_MODE_MIX:
		modes.append(_BLEND_MODES[inputs.blend_mode])
	if inputs.cull_mode != BaseMaterial3D.CULL_BACK:
		modes.append(_CULL_MODES[inputs.cull_mode])
	if inputs.transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_DEPTH_PRE_PASS:
		modes.append("depth_prepass_alpha")
	return modes


static func _defines(inputs: MaterialInputs, choice: TableChoice) -> PackedStringArray:
	var defines: PackedStringArray = ["LOBES %d" % choice.lobe_count]
	if choice.is_isotropic:
		defines.append("ISOTROPIC")
	elif choice.table != null and choice.table == inputs.table and choice.anisotropy < 0.0:
		defines.append("WIDE_BITANGENT")
	if not choice.is_isotropic and choice.rotation != 0.0:
		defines.append("TURNED")
	if choice.widths_texture != null:
		defines.append("WIDTHS_PER_PIXEL")
	elif choice.table.has_second_texels():
		defines.append("SECOND_TEXELS")
	if choice.is_from_set:
		defines.append("COMPENSATED")
	if inputs.is_dielectric():
		defines.append("DIELECTRIC")
	defines.append_array(LightRegistry.get_defines(inputs.rid))
	if choice.coat != null:
		defines.append("COAT_LOBES %d" % choice.coat.lobe_count)
	if inputs.emits():
		defines.append("EMISSION")
	_add_alpha(inputs, defines)
	_add_textures(inputs, choice, defines)
	if inputs.vertex_color_use_as_albedo:
		defines.append("VERTEX_COLOUR")
		if inputs.vertex_color_is_srgb:
			defines.append("SRGB_VERTEX_COLOUR")
	return defines


static func _add_alpha(inputs: MaterialInputs, defines: PackedStringArray) -> void:
	if inputs.transparency == BaseMaterial3D.TRANSPARENCY_DISABLED:
		return
	defines.append("ALPHA")
	if inputs.transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_SCISSOR:
		defines.append("ALPHA_SCISSOR")
	elif inputs.transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_HASH:
		defines.append("ALPHA_HASH")


static func _add_textures(
	inputs: MaterialInputs, choice: TableChoice, defines: PackedStringArray
) -> void:
	var first := defines.size()
	if inputs.albedo_texture != null:
		defines.append("ALBEDO_TEXTURE")
	if inputs.orm_texture != null:
		defines.append_array(["ORM_TEXTURE", "AO"])
	else:
		if inputs.roughness_texture != null:
			defines.append("ROUGHNESS_TEXTURE")
		if inputs.metallic_texture != null:
			defines.append("METALLIC_TEXTURE")
		if inputs.ao_texture != null:
			defines.append_array(["AO", "AO_TEXTURE"])
			if inputs.ao_on_uv2:
				defines.append("AO_ON_UV2")
	if inputs.normal_texture != null:
		defines.append("NORMAL_TEXTURE")
	if inputs.anisotropy_flowmap != null and not choice.is_isotropic:
		defines.append("FLOWMAP")
	if inputs.clearcoat_texture != null and choice.coat != null:
		defines.append("COAT_TEXTURE")
	if inputs.emission_texture != null and inputs.emits():
		defines.append("EMISSION_TEXTURE")
	if defines.size() == first:
		return
	defines.append("TEXTURED")
	var repeat := "repeat_enable" if inputs.texture_repeat else "repeat_disable"
	defines.append("SAMPLING %s, %s" % [_FILTERS[inputs.texture_filter], repeat])
	if inputs.uv1_scale != Vector2.ONE or inputs.uv1_offset != Vector2.ZERO:
		defines.append("UV_TRANSFORM")
