@tool
extends Object
## Hands a [LobeMaterial3D]'s properties to the rendering server.
##
## Not as [ShaderMaterial]'s own parameters: those would be stored with the material, pyramid and
## all.

const MaterialInputs := preload("material_inputs.gd")
const TableChoice := preload("table_choice.gd")

# As Godot's own materials have them, gray being the mean.
const _CHANNELS: Array[Vector4] = [
	Vector4(1.0, 0.0, 0.0, 0.0),
	Vector4(0.0, 1.0, 0.0, 0.0),
	Vector4(0.0, 0.0, 1.0, 0.0),
	Vector4(0.0, 0.0, 0.0, 1.0),
	Vector4(1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0),
]


static func set_albedo(material: RID, albedo: Color) -> void:
	_give(material, &"lobelight_albedo", _linear(albedo))
	_give(material, &"lobelight_alpha", albedo.a)


## Only what the material's variant of the shader has.
static func apply(inputs: MaterialInputs, choice: TableChoice) -> void:
	var material := inputs.rid
	_apply_table(material, choice)
	_apply_coat(inputs, choice)
	_apply_textures(inputs)
	if inputs.is_dielectric():
		_give(material, &"lobelight_metallic", inputs.metallic)
		_give(material, &"lobelight_specular_amount", inputs.specular)
		# Godot 4.6, scene_forward_lights_inc.glsl, F0 and light_compute: what reflects less than 2 % is
		# taken for occluded.
		var f0 := 0.16 * inputs.specular * inputs.specular
		_give(material, &"lobelight_dielectric", Vector2(f0, minf(50.0 * f0, 1.0)))
	if inputs.emits():
		_apply_emission(inputs)
	if inputs.transparency != BaseMaterial3D.TRANSPARENCY_DISABLED:
		_give(material, &"lobelight_alpha_scissor_threshold", inputs.alpha_scissor_threshold)
		_give(material, &"lobelight_alpha_hash_scale", inputs.alpha_hash_scale)
	var scale := inputs.uv1_scale
	var offset := inputs.uv1_offset
	if scale != Vector2.ONE or offset != Vector2.ZERO:
		_give(material, &"lobelight_uv_transform", Vector4(scale.x, scale.y, offset.x, offset.y))


static func _apply_table(material: RID, choice: TableChoice) -> void:
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


static func _apply_coat(inputs: MaterialInputs, choice: TableChoice) -> void:
	if choice.coat == null:
		return
	var material := inputs.rid
	var lookup := choice.coat.get_lookup()
	_give(material, &"lobelight_coat_table", choice.coat.get_texture().get_rid())
	_give(material, &"lobelight_coat_alpha", choice.coat.alpha.x)
	_give(material, &"lobelight_coat_lookup", Vector3(lookup.x, lookup.y, lookup.w))
	var amount := Vector2(inputs.clearcoat, inputs.clearcoat_roughness)
	_give(material, &"lobelight_coat_amount", amount)


static func _apply_textures(inputs: MaterialInputs) -> void:
	var material := inputs.rid
	_give_texture(material, &"lobelight_albedo_texture", inputs.albedo_texture)
	_give_texture(material, &"lobelight_orm_texture", inputs.orm_texture)
	if _give_texture(material, &"lobelight_metallic_texture", inputs.metallic_texture):
		_give(material, &"lobelight_metallic_channel", _CHANNELS[inputs.metallic_texture_channel])
	if _give_texture(material, &"lobelight_roughness_texture", inputs.roughness_texture):
		_give(material, &"lobelight_roughness_channel", _CHANNELS[inputs.roughness_texture_channel])
	if _give_texture(material, &"lobelight_ao_texture", inputs.ao_texture):
		_give(material, &"lobelight_ao_channel", _CHANNELS[inputs.ao_texture_channel])
	if inputs.ao_texture != null or inputs.orm_texture != null:
		_give(material, &"lobelight_ao_light_affect", inputs.ao_light_affect)
	if _give_texture(material, &"lobelight_normal_texture", inputs.normal_texture):
		_give(material, &"lobelight_normal_scale", inputs.normal_scale)
	_give_texture(material, &"lobelight_flowmap", inputs.anisotropy_flowmap)
	_give_texture(material, &"lobelight_coat_texture", inputs.clearcoat_texture)
	_give_texture(material, &"lobelight_emission_texture", inputs.emission_texture)


static func _apply_emission(inputs: MaterialInputs) -> void:
	var colour := _linear(inputs.emission) * inputs.emission_energy
	var factor := inputs.emission_energy * Vector3.ONE
	if (
		inputs.emission_texture != null
		and inputs.emission_operator == BaseMaterial3D.EMISSION_OP_MULTIPLY
	):
		factor = colour
		colour = Vector3.ZERO
	_give(inputs.rid, &"lobelight_emitted", colour)
	_give(inputs.rid, &"lobelight_emission_factor", factor)


static func _linear(colour: Color) -> Vector3:
	var linear := colour.srgb_to_linear()
	return Vector3(linear.r, linear.g, linear.b)


# Whether there is one.
static func _give_texture(material: RID, name: StringName, texture: Texture2D) -> bool:
	if texture == null:
		return false
	_give(material, name, texture.get_rid())
	return true


static func _give(material: RID, name: StringName, value: Variant) -> void:
	RenderingServer.material_set_param(material, name, value)
