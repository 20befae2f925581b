@tool
extends Object
## Hands a [LobeMaterial3D]'s properties to the rendering server.
##
## Not as [ShaderMaterial]'s own parameters: those would be stored with the material, pyramid and
## all.

const MaterialShader := preload("material_shader.gd")
const TableChoice := preload("table_choice.gd")

# As Godot's own materials have them, gray being the mean.
const _CHANNELS: Array[Vector4] = [
	Vector4(1.0, 0.0, 0.0, 0.0),
	Vector4(0.0, 1.0, 0.0, 0.0),
	Vector4(0.0, 0.0, 1.0, 0.0),
	Vector4(0.0, 0.0, 0.0, 1.0),
	Vector4(1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0),
]


static func set_albedo(material: LobeMaterial3D) -> void:
	_give(material, &"lobelight_albedo", _linear(material.albedo))
	_give(material, &"lobelight_alpha", material.albedo.a)


static func apply(material: LobeMaterial3D, choice: TableChoice) -> void:
	_apply_table(material, choice)
	_apply_coat(material, choice)
	_apply_textures(material)
	if MaterialShader.is_dielectric(material):
		_give(material, &"lobelight_metallic", material.metallic)
		_give(material, &"lobelight_specular_amount", material.specular)
		# Godot 4.6, scene_forward_lights_inc.glsl, F0 and light_compute: what reflects less than 2 % is
		# taken for occluded.
		var f0 := 0.16 * material.specular * material.specular
		_give(material, &"lobelight_dielectric", Vector2(f0, minf(50.0 * f0, 1.0)))
	if MaterialShader.emits(material):
		_apply_emission(material)
	_give(material, &"lobelight_alpha_scissor_threshold", material.alpha_scissor_threshold)
	_give(material, &"lobelight_alpha_hash_scale", material.alpha_hash_scale)
	_give(material, &"lobelight_ao_light_affect", material.ao_light_affect)
	_give(material, &"lobelight_normal_scale", material.normal_scale)
	var scale := material.uv1_scale
	var offset := material.uv1_offset
	_give(material, &"lobelight_uv_transform", Vector4(scale.x, scale.y, offset.x, offset.y))


static func _apply_table(material: LobeMaterial3D, choice: TableChoice) -> void:
	if choice.widths_texture != null:
		_give(material, &"lobelight_table", choice.widths_texture.texture.get_rid())
		_give(material, &"lobelight_table_lookup", choice.widths_texture.lookup)
		_give(material, &"lobelight_widths", choice.widths_texture.levels)
	else:
		_give(material, &"lobelight_table", choice.table.get_texture().get_rid())
		_give(material, &"lobelight_table_lookup", choice.table.get_lookup())
		_give(material, &"lobelight_table_alpha", choice.table.alpha)
	_give(material, &"lobelight_roughness", choice.roughness)
	if not choice.is_isotropic:
		_give(material, &"lobelight_anisotropy", choice.anisotropy)
		_give(material, &"lobelight_anisotropy_turn", Vector2.from_angle(choice.rotation))


static func _apply_coat(material: LobeMaterial3D, choice: TableChoice) -> void:
	if choice.coat == null:
		return
	var lookup := choice.coat.get_lookup()
	_give(material, &"lobelight_coat_table", choice.coat.get_texture().get_rid())
	_give(material, &"lobelight_coat_alpha", choice.coat.alpha.x)
	_give(material, &"lobelight_coat_lookup", Vector3(lookup.x, lookup.y, lookup.w))
	var amount := Vector2(material.clearcoat, material.clearcoat_roughness)
	_give(material, &"lobelight_coat_amount", amount)


static func _apply_textures(material: LobeMaterial3D) -> void:
	_give_texture(material, &"lobelight_albedo_texture", material.albedo_texture)
	_give_texture(material, &"lobelight_orm_texture", material.orm_texture)
	_give_texture(material, &"lobelight_metallic_texture", material.metallic_texture)
	_give(material, &"lobelight_metallic_channel", _CHANNELS[material.metallic_texture_channel])
	_give_texture(material, &"lobelight_roughness_texture", material.roughness_texture)
	_give(material, &"lobelight_roughness_channel", _CHANNELS[material.roughness_texture_channel])
	_give_texture(material, &"lobelight_ao_texture", material.ao_texture)
	_give(material, &"lobelight_ao_channel", _CHANNELS[material.ao_texture_channel])
	_give_texture(material, &"lobelight_normal_texture", material.normal_texture)
	_give_texture(material, &"lobelight_flowmap", material.anisotropy_flowmap)
	_give_texture(material, &"lobelight_coat_texture", material.clearcoat_texture)
	_give_texture(material, &"lobelight_emission_texture", material.emission_texture)


static func _apply_emission(material: LobeMaterial3D) -> void:
	var colour := _linear(material.emission) * material.emission_energy
	var factor := material.emission_energy * Vector3.ONE
	if (
		material.emission_texture != null
		and material.emission_operator == LobeMaterial3D.EmissionOperator.MULTIPLY
	):
		factor = colour
		colour = Vector3.ZERO
	_give(material, &"lobelight_emitted", colour)
	_give(material, &"lobelight_emission_factor", factor)


static func _linear(colour: Color) -> Vector3:
	var linear := colour.srgb_to_linear()
	return Vector3(linear.r, linear.g, linear.b)


static func _give_texture(material: LobeMaterial3D, name: StringName, texture: Texture2D) -> void:
	if texture != null:
		_give(material, name, texture.get_rid())


static func _give(material: LobeMaterial3D, name: StringName, value: Variant) -> void:
	RenderingServer.material_set_param(material._rid, name, value)
