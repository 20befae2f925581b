@tool
extends Object
## The shader variant of a [LobeMaterial3D]: its render modes and defines.

const CoordinateDefines := preload("coordinate_defines.gd")
const LightRegistry := preload("../light/light_registry.gd")
const TableChoice := preload("table_choice.gd")

const _BLEND_MODES: PackedStringArray = [
	"blend_mix", "blend_add", "blend_sub", "blend_mul", "blend_premul_alpha"
]
const _DEPTH_DRAW_MODES: PackedStringArray = [
	"depth_draw_opaque", "depth_draw_always", "depth_draw_never"
]
const _DIFFUSE_MODES: PackedStringArray = [
	"diffuse_burley", "diffuse_lambert", "diffuse_lambert_wrap", "diffuse_toon"
]
const _SPECULAR_MODES: PackedStringArray = [
	"specular_schlick_ggx", "specular_toon", "specular_disabled"
]
const _ALPHA_ANTIALIASINGS: PackedStringArray = [
	"", "alpha_to_coverage", "alpha_to_coverage_and_one"
]
const _FADES: PackedStringArray = ["", "PIXEL_ALPHA", "PIXEL_DITHER", "OBJECT_DITHER"]
const _STENCIL_COMPARISONS: PackedStringArray = [
	"always", "less", "equal", "less_or_equal", "greater", "not_equal", "greater_or_equal"
]
const _CULL_MODES: PackedStringArray = ["cull_back", "cull_front", "cull_disabled"]
# The textures of effects of lamps, by the effects' defines.
const _LAMP_TEXTURES: Dictionary[String, StringName] = {
	"RIM": &"rim_texture",
	"BACKLIGHT": &"backlight_texture",
	"SCATTERING": &"subsurf_scatter_texture",
	"TRANSMITTANCE": &"subsurf_scatter_transmittance_texture",
	"REFRACTION": &"refraction_texture",
}
# The defines for reflecting sources by a BRDF's formula; with other BRDFs, the lobes reflect them.
const _SOURCES: Dictionary[String, String] = {
	"ggx": "SOURCES_GGX",
	"ward": "SOURCES_WARD",
	"ward_bounded": "SOURCES_WARD_BOUNDED",
}
const _TAA := "rendering/anti_aliasing/quality/use_taa"
const _SCALING := "rendering/scaling_3d/mode"
const _SCALING_OVER_FRAMES: PackedInt32Array = [
	Viewport.SCALING_3D_MODE_FSR2, Viewport.SCALING_3D_MODE_METALFX_TEMPORAL
]
const _SEVERAL_EYES := "xr/shaders/enabled"
const _LIMITER := "rendering/anti_aliasing/screen_space_roughness_limiter/enabled"
## Lookups of the diffuse light, see diffuse/diffuse.gdshaderinc.
const DIFFUSE_FETCHES := 6


## Everything before the include of the fragment function.
static func get_code(surface: LobeBaseMaterial3D, choice: TableChoice) -> String:
	var code := "shader_type spatial;\nrender_mode %s;\n" % ", ".join(_render_modes(surface))
	code += _get_stencil(surface)
	for name in _defines(surface, choice):
		code += "#define LOBELIGHT_%s\n" % name
	return code


## See [method LobeMaterial3D.get_fetches].
static func count_fetches(
	surface: LobeBaseMaterial3D, choice: TableChoice
) -> Dictionary[String, int]:
	var defines := _defines(surface, choice)
	var environment := choice.lobe_count
	var table := choice.lobe_count if choice.has_table() else 0
	var samplers := 2 if choice.has_table() else 1
	if "LAMPS_ONLY" in defines:
		return {"environment": 0, "table": 0, "samplers": 0}
	if "SECOND_TEXELS" in defines or ("WIDTHS_PER_PIXEL" in defines and not choice.is_isotropic):
		table *= 2
	if "LINE_FADES" in defines:
		environment += choice.line.count
	if "DIELECTRIC" in defines and "ENGINE_DIFFUSE" not in defines:
		environment += DIFFUSE_FETCHES
	if choice.coat != null:
		environment += choice.coat.lobe_count
		table += choice.coat.lobe_count
		samplers += 1
	if choice.sheen != null:
		environment += choice.sheen.lobe_count
		table += choice.sheen.lobe_count
		samplers += 1
	if "SOURCES" in defines:
		samplers += 1
	if "PLACED" in defines:
		samplers += _count_placed_samplers(defines)
	return {"environment": environment, "table": table, "samplers": samplers}


# See probes/placed_light.gdshaderinc: the list, and an array of cube maps or four of them.
static func _count_placed_samplers(defines: PackedStringArray) -> int:
	var is_compatibility := RenderingServer.get_current_rendering_method() == "gl_compatibility"
	var samplers := 5 if is_compatibility else 2
	for define in defines:
		if define.begins_with("ENVIRONMENTS ") or define.begins_with("OTHER_SOURCES "):
			samplers += define.get_slice(" ", 1).to_int()
	return samplers


static func _render_modes(surface: LobeBaseMaterial3D) -> PackedStringArray:
	var modes: PackedStringArray = []
	if _get_diffuse_defines(surface):
		# The engine reflects nothing here, so there is nothing to occlude.
		modes.append("specular_occlusion_disabled")
	elif surface.disable_ambient_light or not surface.shadow_to_opacity:
		modes.append("ambient_light_disabled")
	# What is the engine's default is left out.
	if surface.is_dielectric():
		# As Godot's own materials are lit by its lights.
		modes.append(_DIFFUSE_MODES[surface.diffuse_mode])
	if surface.specular_mode != BaseMaterial3D.SPECULAR_SCHLICK_GGX:
		modes.append(_SPECULAR_MODES[surface.specular_mode])
	if surface.blend_mode != BaseMaterial3D.BLEND_MODE_MIX:
		modes.append(_BLEND_MODES[surface.blend_mode])
	if surface.cull_mode != BaseMaterial3D.CULL_BACK:
		modes.append(_CULL_MODES[surface.cull_mode])
	_add_depth_modes(surface, modes)
	if surface.has_smooth_alpha():
		modes.append(_ALPHA_ANTIALIASINGS[surface.alpha_antialiasing_mode])
	var switches: Dictionary[String, bool] = {
		"unshaded": surface.is_unshaded(),
		"vertex_lighting": surface.shading_mode == BaseMaterial3D.SHADING_MODE_PER_VERTEX,
		"shadows_disabled": surface.disable_receive_shadows,
		"shadow_to_opacity": surface.shadow_to_opacity,
		"fog_disabled": surface.disable_fog,
		"particle_trails": surface.use_particle_trails,
		"sss_mode_skin": surface.subsurf_scatter_enabled and surface.subsurf_scatter_skin_mode,
	}
	for mode in switches:
		if switches[mode]:
			modes.append(mode)
	if modes.is_empty():
		modes.append("blend_mix")
	return modes


static func _add_depth_modes(surface: LobeBaseMaterial3D, modes: PackedStringArray) -> void:
	var draw := surface.depth_draw_mode
	if surface.refraction_enabled:
		draw = BaseMaterial3D.DEPTH_DRAW_ALWAYS
	if draw != BaseMaterial3D.DEPTH_DRAW_OPAQUE_ONLY:
		modes.append(_DEPTH_DRAW_MODES[draw])
	if surface.no_depth_test:
		modes.append("depth_test_disabled")
	elif surface.depth_test == BaseMaterial3D.DEPTH_TEST_INVERTED:
		modes.append("depth_test_inverted")
	if surface.transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_DEPTH_PRE_PASS:
		modes.append("depth_prepass_alpha")


static func _get_stencil(surface: LobeBaseMaterial3D) -> String:
	var flags := surface.stencil_flags
	if surface.stencil_mode == BaseMaterial3D.STENCIL_MODE_DISABLED or flags == 0:
		return ""
	var modes: PackedStringArray = []
	if flags & BaseMaterial3D.STENCIL_FLAG_READ:
		modes.append("read")
	if flags & BaseMaterial3D.STENCIL_FLAG_WRITE:
		modes.append("write")
	if flags & BaseMaterial3D.STENCIL_FLAG_WRITE_DEPTH_FAIL:
		modes.append("write_depth_fail")
	modes.append("compare_" + _STENCIL_COMPARISONS[surface.stencil_compare])
	modes.append(str(surface.stencil_reference))
	return "stencil_mode %s;\n" % ", ".join(modes)


static func _defines(surface: LobeBaseMaterial3D, choice: TableChoice) -> PackedStringArray:
	var defines: PackedStringArray = ["LOBES %d" % choice.lobe_count]
	if choice.is_isotropic:
		defines.append("ISOTROPIC")
	elif choice.table != null and choice.table == surface.table and choice.anisotropy < 0.0:
		defines.append("WIDE_BITANGENT")
	if not choice.is_isotropic and choice.rotation != 0.0:
		defines.append("TURNED")
	if choice.line.count > 0:
		defines.append("LINE %d" % choice.line.count)
		defines.append("LINE_" + choice.line.MODELS[choice.line.brdf])
		if choice.line.fades:
			defines.append("LINE_FADES")
		if _is_mean_of_frames():
			defines.append("LINE_SHIFTED")
	if _may_draw_eyes():
		defines.append("EYES")
	if choice.is_per_pixel:
		defines.append("WIDTHS_PER_PIXEL")
	elif choice.has_second_texels():
		defines.append("SECOND_TEXELS")
	if choice.is_from_set:
		defines.append("COMPENSATED")
	if surface.is_dielectric():
		defines.append("DIELECTRIC")
		if surface.metallic > 0.0:
			defines.append("METALLIC")
		defines.append_array(_get_diffuse_defines(surface))
	if surface.is_lit_by_surroundings():
		defines.append_array(LightRegistry.get_defines(surface.get_rid()))
		if "SOURCES" in defines:
			defines.append(_SOURCES.get(choice.brdf, "SOURCES_IN_LOBES"))
	else:
		defines.append("LAMPS_ONLY")
	if choice.coat != null:
		defines.append("COAT")
	if choice.sheen != null:
		defines.append("SHEEN")
	if surface.emits():
		defines.append("EMISSION")
	if surface.is_antialiased():
		defines.append("ANTIALIASED")
		if _is_limited_by_engine():
			defines.append("LIMITED_BY_ENGINE")
	_add_alpha(surface, defines)
	_add_fades(surface, defines)
	_add_lamps(surface, defines)
	_add_textures(surface, choice, defines)
	CoordinateDefines.add_vertices(surface, defines)
	if surface.vertex_color_use_as_albedo:
		defines.append("VERTEX_COLOUR")
		if surface.vertex_color_is_srgb:
			defines.append("SRGB_VERTEX_COLOUR")
	return defines


# Whether the project's viewports show means over frames: TAA, FSR 2 and MetalFX' temporal scaling.
static func _is_mean_of_frames() -> bool:
	if RenderingServer.get_current_rendering_method() != "forward_plus":
		return false
	var scaling: int = ProjectSettings.get_setting(_SCALING, Viewport.SCALING_3D_MODE_BILINEAR)
	return ProjectSettings.get_setting(_TAA, false) or scaling in _SCALING_OVER_FRAMES


# Whether views of several eyes may have to be told from others: where the engine does not say where
# the eye is.
static func _may_draw_eyes() -> bool:
	if RenderingServer.get_current_rendering_method() != "gl_compatibility":
		return false
	return ProjectSettings.get_setting(_SEVERAL_EYES, false)


# Whether the engine itself widens its lights' highlights where normals differ from pixel to pixel.
static func _is_limited_by_engine() -> bool:
	if RenderingServer.get_current_rendering_method() == "gl_compatibility":
		return false
	return ProjectSettings.get_setting(_LIMITER, true)


# Whether and how the engine takes part in the diffuse light. Not in materials whose lamps are
# shaded in another way than the engine's own.
static func _get_diffuse_defines(surface: LobeBaseMaterial3D) -> PackedStringArray:
	if not surface.is_dielectric() or not surface.is_lit_by_surroundings():
		return []
	var is_plain := (
		surface.shading_mode == BaseMaterial3D.SHADING_MODE_PER_PIXEL
		and surface.diffuse_mode == BaseMaterial3D.DIFFUSE_BURLEY
		and surface.specular_mode == BaseMaterial3D.SPECULAR_SCHLICK_GGX
		and not surface.shadow_to_opacity
		and not surface.has_lamp_effects()
	)
	return LightRegistry.get_diffuse_defines(surface.get_rid()) if is_plain else []


static func _add_alpha(surface: LobeBaseMaterial3D, defines: PackedStringArray) -> void:
	if surface.has_alpha():
		defines.append("ALPHA")
	if surface.transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_SCISSOR:
		defines.append("ALPHA_SCISSOR")
	elif surface.transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_HASH:
		defines.append("ALPHA_HASH")
	if surface.has_smooth_alpha():
		defines.append("SMOOTH_ALPHA")


static func _add_fades(surface: LobeBaseMaterial3D, defines: PackedStringArray) -> void:
	if surface.has_fades():
		defines.append("FADES")
	if surface.proximity_fade_enabled:
		defines.append("PROXIMITY_FADE")
	if surface.distance_fade_mode != BaseMaterial3D.DISTANCE_FADE_DISABLED:
		defines.append("DISTANCE_FADE")
		defines.append(_FADES[surface.distance_fade_mode])
	if surface.refraction_enabled:
		defines.append("REFRACTION")


# What the engine's lamps alone show.
static func _add_lamps(surface: LobeBaseMaterial3D, defines: PackedStringArray) -> void:
	if surface.cull_mode != BaseMaterial3D.CULL_BACK:
		defines.append("BACK_SIDES")
	if surface.shading_mode == BaseMaterial3D.SHADING_MODE_PER_VERTEX:
		defines.append("PER_VERTEX")
	if not surface.has_lamp_effects():
		return
	defines.append("LAMPS")
	if surface.rim_enabled:
		defines.append("RIM")
	if surface.backlight_enabled:
		defines.append("BACKLIGHT")
	if surface.subsurf_scatter_enabled:
		defines.append("SCATTERING")
	if surface.subsurf_scatter_transmittance_enabled:
		defines.append("TRANSMITTANCE")


static func _add_textures(
	surface: LobeBaseMaterial3D, choice: TableChoice, defines: PackedStringArray
) -> void:
	var first := defines.size()
	if surface.albedo_texture != null:
		defines.append("ALBEDO_TEXTURE")
		if surface.shows_msdf():
			defines.append("MSDF")
		elif surface.albedo_texture_force_srgb:
			defines.append("SRGB_ALBEDO")
	if surface.orm_texture != null:
		defines.append("ORM_TEXTURE")
	else:
		if surface.roughness_texture != null:
			defines.append("ROUGHNESS_TEXTURE")
		if surface.metallic_texture != null:
			defines.append("METALLIC_TEXTURE")
	if surface.is_occluded():
		defines.append("AO")
		if surface.orm_texture == null:
			defines.append("AO_TEXTURE")
			if surface.ao_on_uv2:
				defines.append("AO_ON_UV2")
	if surface.has_normal_map():
		defines.append("NORMAL_TEXTURE")
		if surface.has_normal_variance():
			defines.append("NORMAL_VARIANCE_TEXTURE")
	if surface.has_bent_normals():
		defines.append("BENT_NORMAL")
	_add_occlusion(surface, defines)
	if surface.anisotropy_flowmap != null and not choice.is_isotropic:
		defines.append("FLOWMAP")
	if surface.clearcoat_texture != null and choice.coat != null:
		defines.append("COAT_TEXTURE")
	if surface.sheen_texture != null and choice.sheen != null:
		defines.append("SHEEN_TEXTURE")
	if surface.emission_texture != null and surface.emits():
		defines.append("EMISSION_TEXTURE")
		if surface.emission_on_uv2:
			defines.append("EMISSION_ON_UV2")
	if surface.detail_enabled:
		_add_details(surface, defines)
	for name in _LAMP_TEXTURES:
		if name in defines and surface.get(_LAMP_TEXTURES[name]) != null:
			defines.append(name + "_TEXTURE")
	if defines.size() == first:
		return
	defines.append("TEXTURED")
	CoordinateDefines.add(surface, defines)


static func _add_details(surface: LobeBaseMaterial3D, defines: PackedStringArray) -> void:
	defines.append("DETAIL")
	defines.append("DETAIL_BLEND %d" % surface.detail_blend_mode)
	if surface.detail_mask != null:
		defines.append("DETAIL_MASK")
	if surface.detail_albedo != null:
		defines.append("DETAIL_ALBEDO")
	if surface.detail_normal != null:
		defines.append("DETAIL_NORMAL")
	if surface.detail_uv_layer == BaseMaterial3D.DETAIL_UV_2:
		defines.append("DETAIL_ON_UV2")


# Of reflections, see occlusion/occlusion.gdshaderinc.
static func _add_occlusion(surface: LobeBaseMaterial3D, defines: PackedStringArray) -> void:
	if not surface.occludes_reflections():
		return
	defines.append("OCCLUDED")
	if surface.is_occluded():
		defines.append("CONE")
	if surface.has_normal_map():
		defines.append("HORIZON")
