@tool
extends Object
## Which properties the inspector shows: not those that do nothing beside the others, as
## [BaseMaterial3D] has it.

# What turns a property on.
const _SWITCHES: Dictionary[String, StringName] = {
	"billboard_keep_scale": &"billboard_mode",
	"fov_override": &"use_fov_override",
	"grow_amount": &"grow",
	"heightmap_max_layers": &"heightmap_deep_parallax",
	"heightmap_min_layers": &"heightmap_deep_parallax",
	"msdf_outline_size": &"albedo_texture_msdf",
	"msdf_pixel_range": &"albedo_texture_msdf",
	"point_size": &"use_point_size",
	"proximity_fade_distance": &"proximity_fade_enabled",
	"distance_fade_min_distance": &"distance_fade_mode",
	"distance_fade_max_distance": &"distance_fade_mode",
	"stencil_reference": &"stencil_mode",
	"uv1_triplanar_sharpness": &"uv1_triplanar",
	"uv1_world_triplanar": &"uv1_triplanar",
	"uv2_triplanar_sharpness": &"uv2_triplanar",
	"uv2_world_triplanar": &"uv2_triplanar",
	"z_clip_scale": &"use_z_clip_scale",
}
# What is of no use to a surface that shows its colour alone, by how the names begin.
const _OF_SHADED: PackedStringArray = [
	"anisotropy",
	"ao_",
	"backlight",
	"bent_normal",
	"clearcoat",
	"emission",
	"metallic",
	"normal",
	"rim",
	"roughness",
	"subsurf_scatter",
]


static func hides(surface: LobeBaseMaterial3D, name: String) -> bool:
	return _is_unused(surface, name) or _is_unshaded(surface, name)


static func _is_unused(surface: LobeBaseMaterial3D, name: String) -> bool:
	if _SWITCHES.has(name):
		return not surface.get(_SWITCHES[name])
	if name.begins_with("particles_anim_"):
		return surface.billboard_mode != BaseMaterial3D.BILLBOARD_PARTICLES
	var is_used := true
	match name:
		"alpha_scissor_threshold":
			is_used = surface.transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_SCISSOR
		"alpha_hash_scale":
			is_used = surface.transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_HASH
		"alpha_antialiasing_mode":
			is_used = surface.can_smooth_alpha()
		"alpha_antialiasing_edge":
			is_used = surface.has_smooth_alpha()
		"blend_mode":
			is_used = not surface.has_smooth_alpha()
		"depth_test":
			is_used = not surface.no_depth_test
		"emission_intensity":
			is_used = surface.has_physical_units()
		"subsurf_scatter_transmittance_color", "subsurf_scatter_transmittance_texture":
			is_used = not surface.subsurf_scatter_skin_mode
		"stencil_flags", "stencil_compare":
			is_used = surface.stencil_mode == BaseMaterial3D.STENCIL_MODE_CUSTOM
		"stencil_color":
			is_used = surface.has_stencil_pass()
		"stencil_outline_thickness":
			is_used = surface.stencil_mode == BaseMaterial3D.STENCIL_MODE_OUTLINE
	return not is_used


static func _is_unshaded(surface: LobeBaseMaterial3D, name: String) -> bool:
	if not surface.is_unshaded():
		return false
	for beginning in _OF_SHADED:
		if name.begins_with(beginning):
			return true
	return false
