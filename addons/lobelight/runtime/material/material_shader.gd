@tool
extends Object
## The shader variant of a [LobeMaterial3D]: its render modes and defines.

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
static func get_code(material: LobeMaterial3D, choice: TableChoice) -> String:
	var code := "shader_type spatial;\nrender_mode %s;\n" % ", ".join(_render_modes(material))
	for name in _defines(material, choice):
		code += "#define LOBELIGHT_%s\n" % name
	return code


## See [method LobeMaterial3D.get_fetches].
static func count_fetches(material: LobeMaterial3D, choice: TableChoice) -> Dictionary[String, int]:
	var defines := _defines(material, choice)
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
	return {"environment": environment, "table": table, "samplers": samplers}


## Whether there is diffuse light.
static func is_dielectric(material: LobeMaterial3D) -> bool:
	var textured := material.metallic_texture != null or material.orm_texture != null
	return textured or material.metallic < 1.0


static func emits(material: LobeMaterial3D) -> bool:
	if material.emission_energy == 0.0:
		return false
	var colour := material.emission
	var is_dark := colour.r == 0.0 and colour.g == 0.0 and colour.b == 0.0
	if material.emission_texture == null:
		return not is_dark
	return not is_dark or material.emission_operator == LobeMaterial3D.EmissionOperator.ADD


static func _render_modes(material: LobeMaterial3D) -> PackedStringArray:
	var modes: PackedStringArray = ["ambient_light_disabled"]
	# What is the engine's default is left out.
	if is_dielectric(material):
		# As Godot's own materials are lit by its lights.
		modes.append("diffuse_burley")
	if material.blend_mode != LobeMaterial3D.BlendMode.MIX:
		modes.append(_BLEND_MODES[material.blend_mode])
	if material.cull_mode != LobeMaterial3D.CullMode.BACK:
		modes.append(_CULL_MODES[material.cull_mode])
	if material.transparency == LobeMaterial3D.Transparency.ALPHA_DEPTH_PRE_PASS:
		modes.append("depth_prepass_alpha")
	return modes


static func _defines(material: LobeMaterial3D, choice: TableChoice) -> PackedStringArray:
	var defines: PackedStringArray = ["LOBES %d" % choice.lobe_count]
	if choice.is_isotropic:
		defines.append("ISOTROPIC")
	elif choice.table != null and choice.table == material.table and choice.anisotropy < 0.0:
		defines.append("WIDE_BITANGENT")
	if not choice.is_isotropic and choice.rotation != 0.0:
		defines.append("TURNED")
	if choice.widths_texture != null:
		defines.append("WIDTHS_PER_PIXEL")
	elif choice.table.has_second_texels():
		defines.append("SECOND_TEXELS")
	if choice.is_from_set:
		defines.append("COMPENSATED")
	if is_dielectric(material):
		defines.append("DIELECTRIC")
	defines.append_array(LightRegistry.get_defines(material.get_rid()))
	if choice.coat != null:
		defines.append("COAT_LOBES %d" % choice.coat.lobe_count)
	if emits(material):
		defines.append("EMISSION")
	_add_alpha(material, defines)
	_add_textures(material, choice, defines)
	if material.vertex_color_use_as_albedo:
		defines.append("VERTEX_COLOUR")
		if material.vertex_color_is_srgb:
			defines.append("SRGB_VERTEX_COLOUR")
	return defines


static func _add_alpha(material: LobeMaterial3D, defines: PackedStringArray) -> void:
	if material.transparency == LobeMaterial3D.Transparency.DISABLED:
		return
	defines.append("ALPHA")
	if material.transparency == LobeMaterial3D.Transparency.ALPHA_SCISSOR:
		defines.append("ALPHA_SCISSOR")
	elif material.transparency == LobeMaterial3D.Transparency.ALPHA_HASH:
		defines.append("ALPHA_HASH")


static func _add_textures(
	material: LobeMaterial3D, choice: TableChoice, defines: PackedStringArray
) -> void:
	var first := defines.size()
	if material.albedo_texture != null:
		defines.append("ALBEDO_TEXTURE")
	if material.orm_texture != null:
		defines.append_array(["ORM_TEXTURE", "AO"])
	else:
		if material.roughness_texture != null:
			defines.append("ROUGHNESS_TEXTURE")
		if material.metallic_texture != null:
			defines.append("METALLIC_TEXTURE")
		if material.ao_texture != null:
			defines.append_array(["AO", "AO_TEXTURE"])
			if material.ao_on_uv2:
				defines.append("AO_ON_UV2")
	if material.normal_texture != null:
		defines.append("NORMAL_TEXTURE")
	if material.anisotropy_flowmap != null and not choice.is_isotropic:
		defines.append("FLOWMAP")
	if material.clearcoat_texture != null and choice.coat != null:
		defines.append("COAT_TEXTURE")
	if material.emission_texture != null and emits(material):
		defines.append("EMISSION_TEXTURE")
	if defines.size() == first:
		return
	defines.append("TEXTURED")
	var repeat := "repeat_enable" if material.texture_repeat else "repeat_disable"
	defines.append("SAMPLING %s, %s" % [_FILTERS[material.texture_filter], repeat])
	if material.uv1_scale != Vector2.ONE or material.uv1_offset != Vector2.ZERO:
		defines.append("UV_TRANSFORM")
