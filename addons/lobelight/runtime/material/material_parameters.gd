@tool
extends Object
## Hands a [LobeMaterial3D]'s properties to the rendering server.
##
## They are not set as [ShaderMaterial]'s own parameters, which would be stored with the material,
## the pyramid included.

const CoordinateParameters := preload("coordinate_parameters.gd")
const GivenParameters := preload("given_parameters.gd")
const Numbers := preload("surface_numbers.gd")
const TableChoice := preload("table_choice.gd")

# As Godot's own materials have them, gray being the mean.
const _CHANNELS: Array[Vector4] = [
	Vector4(1.0, 0.0, 0.0, 0.0),
	Vector4(0.0, 1.0, 0.0, 0.0),
	Vector4(0.0, 0.0, 1.0, 0.0),
	Vector4(0.0, 0.0, 0.0, 1.0),
	Vector4(1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0),
]


## All that the material's variant of the shader has.
static func apply(surface: LobeBaseMaterial3D, choice: TableChoice) -> void:
	_apply_albedo(surface)
	apply_lobes(surface, choice)
	if surface.is_dielectric():
		_apply_metal(surface)
	if surface.emits():
		_apply_emission(surface)
	_apply_textures(surface)
	CoordinateParameters.apply(surface)
	_apply_fades(surface)
	_apply_lamps(surface)


## What goes with the lobes.
static func apply_lobes(surface: LobeBaseMaterial3D, choice: TableChoice) -> void:
	_apply_table(surface.get_rid(), choice)
	_apply_coat(surface, choice)
	_apply_sheen(surface, choice)


static func _apply_albedo(surface: LobeBaseMaterial3D) -> void:
	var albedo := surface.albedo_color
	_give(surface.get_rid(), &"lobelight_albedo", Numbers.linear(albedo))
	_give(surface.get_rid(), &"lobelight_alpha", albedo.a)


static func _apply_metal(surface: LobeBaseMaterial3D) -> void:
	var material := surface.get_rid()
	_give(material, &"lobelight_metallic", surface.metallic)
	_give(material, &"lobelight_specular_amount", surface.metallic_specular)
	_give(material, &"lobelight_dielectric", Numbers.dielectric(surface.metallic_specular))


static func _apply_table(material: RID, choice: TableChoice) -> void:
	if choice.has_table():
		_give(material, &"lobelight_table", choice.get_texture())
		_give(material, &"lobelight_table_lookup", choice.get_lookup())
		if choice.widths_texture != null:
			_give(material, &"lobelight_widths", choice.widths_texture.levels)
		else:
			_give(material, &"lobelight_table_alpha", choice.get_alpha())
	var of_line := choice.get_line_parameters()
	for name in of_line:
		_give(material, name, of_line[name])
	_give(material, &"lobelight_roughness", choice.roughness)
	if not choice.is_isotropic:
		_give(material, &"lobelight_anisotropy", choice.anisotropy)
		_give(material, &"lobelight_anisotropy_turn", Vector2.from_angle(choice.rotation))


static func _apply_coat(surface: LobeBaseMaterial3D, choice: TableChoice) -> void:
	if choice.coat == null:
		return
	var material := surface.get_rid()
	var lookup := choice.coat.get_lookup()
	_give(material, &"lobelight_coat_table", choice.coat.get_texture().get_rid())
	_give(material, &"lobelight_coat_lookup", Vector3(lookup.x, lookup.y, lookup.w))
	var amount := Vector2(surface.clearcoat, surface.clearcoat_roughness)
	_give(material, &"lobelight_coat_amount", amount)


static func _apply_sheen(surface: LobeBaseMaterial3D, choice: TableChoice) -> void:
	if choice.sheen == null:
		return
	var material := surface.get_rid()
	var lookup := choice.sheen.get_lookup()
	_give(material, &"lobelight_sheen_table", choice.sheen.get_texture().get_rid())
	_give(material, &"lobelight_sheen_lookup", Vector3(lookup.x, lookup.y, lookup.w))
	_give(material, &"lobelight_sheen_tint", Numbers.linear(surface.sheen_color))
	_give_texture(material, &"lobelight_sheen_texture", surface.sheen_texture)


static func _apply_textures(surface: LobeBaseMaterial3D) -> void:
	var material := surface.get_rid()
	_give_texture(material, &"lobelight_albedo_texture", surface.albedo_texture)
	_give_texture(material, &"lobelight_orm_texture", surface.orm_texture)
	if _give_texture(material, &"lobelight_metallic_texture", surface.metallic_texture):
		_give(material, &"lobelight_metallic_channel", _CHANNELS[surface.metallic_texture_channel])
	if _give_texture(material, &"lobelight_roughness_texture", surface.roughness_texture):
		_give(
			material, &"lobelight_roughness_channel", _CHANNELS[surface.roughness_texture_channel]
		)
	if _give_texture(material, &"lobelight_ao_texture", surface.ao_texture):
		_give(material, &"lobelight_ao_channel", _CHANNELS[surface.ao_texture_channel])
	if surface.is_occluded():
		_give(material, &"lobelight_ao_light_affect", surface.ao_light_affect)
	if surface.has_normal_map():
		# A detail's may be the only one.
		var map := surface.normal_texture if surface.normal_enabled else null
		_give(material, &"lobelight_normal_texture", map.get_rid() if map != null else null)
		_give(
			material,
			&"lobelight_normal_scale",
			surface.normal_scale if surface.normal_enabled else 1.0
		)
		_give_texture(
			material, &"lobelight_normal_variance_texture", surface.normal_variance_texture
		)
	if surface.has_bent_normals():
		_give_texture(material, &"lobelight_bent_normal_texture", surface.bent_normal_texture)
	_give_texture(material, &"lobelight_flowmap", surface.anisotropy_flowmap)
	_give_texture(material, &"lobelight_coat_texture", surface.clearcoat_texture)
	_give_texture(material, &"lobelight_emission_texture", surface.emission_texture)
	_give_texture(material, &"lobelight_detail_mask", surface.detail_mask)
	_give_texture(material, &"lobelight_detail_albedo", surface.detail_albedo)
	_give_texture(material, &"lobelight_detail_normal", surface.detail_normal)
	_give_texture(material, &"lobelight_heightmap", surface.heightmap_texture)
	if surface.albedo_texture_msdf:
		_give(material, &"lobelight_msdf_range", surface.msdf_pixel_range)
		_give(material, &"lobelight_msdf_outline", surface.msdf_outline_size)


static func _apply_fades(surface: LobeBaseMaterial3D) -> void:
	var material := surface.get_rid()
	if surface.has_alpha():
		_give(material, &"lobelight_alpha_scissor_threshold", surface.alpha_scissor_threshold)
		_give(material, &"lobelight_alpha_hash_scale", surface.alpha_hash_scale)
	if surface.has_smooth_alpha():
		_give(material, &"lobelight_alpha_edge", surface.alpha_antialiasing_edge)
		if surface.albedo_texture != null:
			_give(material, &"lobelight_albedo_size", surface.albedo_texture.get_size())
	if surface.proximity_fade_enabled:
		_give(material, &"lobelight_proximity", surface.proximity_fade_distance)
	if surface.distance_fade_mode != BaseMaterial3D.DISTANCE_FADE_DISABLED:
		var limits := Vector2(
			surface.distance_fade_min_distance, surface.distance_fade_max_distance
		)
		_give(material, &"lobelight_fade_limits", limits)
	if surface.refraction_enabled:
		_give(material, &"lobelight_refraction", surface.refraction_scale)
		if _give_texture(material, &"lobelight_refraction_texture", surface.refraction_texture):
			var channel := _CHANNELS[surface.refraction_texture_channel]
			_give(material, &"lobelight_refraction_channel", channel)


static func _apply_lamps(surface: LobeBaseMaterial3D) -> void:
	var material := surface.get_rid()
	if surface.rim_enabled:
		_give(material, &"lobelight_rim_amount", Vector2(surface.rim, surface.rim_tint))
		_give_texture(material, &"lobelight_rim_texture", surface.rim_texture)
	if surface.backlight_enabled:
		_give(material, &"lobelight_backlight", surface.backlight)
		_give_texture(material, &"lobelight_backlight_texture", surface.backlight_texture)
	if surface.subsurf_scatter_enabled:
		_give(material, &"lobelight_scattering", surface.subsurf_scatter_strength)
		_give_texture(material, &"lobelight_scattering_texture", surface.subsurf_scatter_texture)
	if surface.subsurf_scatter_transmittance_enabled:
		_give(material, &"lobelight_transmitted", surface.subsurf_scatter_transmittance_color)
		_give(
			material,
			&"lobelight_transmittance",
			Vector2(
				surface.subsurf_scatter_transmittance_depth,
				surface.subsurf_scatter_transmittance_boost
			)
		)
		_give_texture(
			material,
			&"lobelight_transmittance_texture",
			surface.subsurf_scatter_transmittance_texture
		)


static func _apply_emission(surface: LobeBaseMaterial3D) -> void:
	var emitted := surface.get_emitted()
	_give(surface.get_rid(), &"lobelight_emitted", emitted[0])
	_give(surface.get_rid(), &"lobelight_emission_factor", emitted[1])


# Whether there is one.
static func _give_texture(material: RID, name: StringName, texture: Texture2D) -> bool:
	if texture == null:
		return false
	_give(material, name, texture.get_rid())
	return true


static func _give(material: RID, name: StringName, value: Variant) -> void:
	GivenParameters.give(material, name, value)
