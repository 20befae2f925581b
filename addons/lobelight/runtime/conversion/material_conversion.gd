@tool
extends "../material/conversion.gd"
## Between Godot's own materials and [LobeMaterial3D]; see [method LobeMaterial3D.from_standard] and
## [method LobeMaterial3D.to_standard].

const Widths := preload("../table/widths.gd")

# Of the same name and meaning on both sides.
const _SHARED: Array[StringName] = [
	&"transparency",
	&"alpha_scissor_threshold",
	&"alpha_hash_scale",
	&"blend_mode",
	&"cull_mode",
	&"vertex_color_use_as_albedo",
	&"vertex_color_is_srgb",
	&"albedo_texture",
	&"texture_filter",
	&"texture_repeat",
	&"render_priority",
	&"next_pass",
	&"resource_name",
]

# What a StandardMaterial3D may have, and its property's value without it.
const _LOST: Dictionary[StringName, Variant] = {
	&"albedo_texture_force_srgb": false,
	&"albedo_texture_msdf": false,
	&"alpha_antialiasing_mode": BaseMaterial3D.ALPHA_ANTIALIASING_OFF,
	&"backlight_enabled": false,
	&"bent_normal_enabled": false,
	&"billboard_mode": BaseMaterial3D.BILLBOARD_DISABLED,
	&"depth_draw_mode": BaseMaterial3D.DEPTH_DRAW_OPAQUE_ONLY,
	&"depth_test": BaseMaterial3D.DEPTH_TEST_DEFAULT,
	&"detail_enabled": false,
	&"diffuse_mode": BaseMaterial3D.DIFFUSE_BURLEY,
	&"disable_fog": false,
	&"disable_receive_shadows": false,
	&"distance_fade_mode": BaseMaterial3D.DISTANCE_FADE_DISABLED,
	&"fixed_size": false,
	&"grow": false,
	&"heightmap_enabled": false,
	&"no_depth_test": false,
	&"proximity_fade_enabled": false,
	&"refraction_enabled": false,
	&"rim_enabled": false,
	&"shading_mode": BaseMaterial3D.SHADING_MODE_PER_PIXEL,
	&"shadow_to_opacity": false,
	&"specular_mode": BaseMaterial3D.SPECULAR_SCHLICK_GGX,
	&"stencil_mode": BaseMaterial3D.STENCIL_MODE_DISABLED,
	&"subsurf_scatter_enabled": false,
	&"use_particle_trails": false,
	&"use_point_size": false,
	&"uv1_triplanar": false,
}


func from_standard(source: BaseMaterial3D) -> LobeMaterial3D:
	var made := LobeMaterial3D.new()
	_copy(source, made)
	made.albedo = source.albedo_color
	made.uv1_scale = Vector2(source.uv1_scale.x, source.uv1_scale.y)
	made.uv1_offset = Vector2(source.uv1_offset.x, source.uv1_offset.y)
	if source is ORMMaterial3D:
		_take_orm(source, made)
	else:
		_take_parts(source, made)
	if source.normal_enabled:
		made.normal_texture = source.normal_texture
		made.normal_scale = source.normal_scale
	if source.clearcoat_enabled:
		made.clearcoat = source.clearcoat
		made.clearcoat_roughness = source.clearcoat_roughness
		made.clearcoat_texture = source.clearcoat_texture
	if source.anisotropy_enabled:
		made.anisotropy = source.anisotropy
		made.anisotropy_flowmap = source.anisotropy_flowmap
	if source.emission_enabled:
		made.emission = source.emission
		made.emission_energy = source.emission_energy_multiplier
		made.emission_operator = source.emission_operator as LobeMaterial3D.EmissionOperator
		made.emission_texture = source.emission_texture
	return made


func to_standard(shown: ShaderMaterial) -> BaseMaterial3D:
	var source := shown as LobeMaterial3D
	var packed := (
		source.orm_texture != null
		and source.roughness == 1.0
		and source.metallic == 1.0
		and source.specular == 0.5
	)
	var made: BaseMaterial3D = ORMMaterial3D.new() if packed else StandardMaterial3D.new()
	_copy(source, made)
	made.albedo_color = source.albedo
	made.uv1_scale = Vector3(source.uv1_scale.x, source.uv1_scale.y, 1.0)
	made.uv1_offset = Vector3(source.uv1_offset.x, source.uv1_offset.y, 0.0)
	if packed:
		made.orm_texture = source.orm_texture
		made.ao_enabled = true
		made.ao_light_affect = source.ao_light_affect
	else:
		_give_parts(source, made)
	made.normal_enabled = source.normal_texture != null
	made.normal_texture = source.normal_texture
	made.normal_scale = source.normal_scale
	made.clearcoat_enabled = source.clearcoat > 0.0
	made.clearcoat = source.clearcoat
	made.clearcoat_roughness = source.clearcoat_roughness
	made.clearcoat_texture = source.clearcoat_texture
	_give_anisotropy(source, made)
	var glows := source.emission != Color.BLACK or source.emission_texture != null
	made.emission_enabled = glows and source.emission_energy != 0.0
	made.emission = source.emission
	made.emission_energy_multiplier = source.emission_energy
	made.emission_operator = source.emission_operator as BaseMaterial3D.EmissionOperator
	made.emission_texture = source.emission_texture
	return made


func get_losses(source: BaseMaterial3D) -> PackedStringArray:
	var losses: PackedStringArray = []
	for name in _LOST:
		if source.get(name) != _LOST[name]:
			losses.append(name)
	if source.emission_enabled and source.emission_on_uv2:
		losses.append("emission_on_uv2")
	return losses


static func _copy(source: Material, made: Material) -> void:
	for name in _SHARED:
		made.set(name, source.get(name))


# Roughness and metallic of an ORMMaterial3D are those of its texture alone.
static func _take_orm(source: BaseMaterial3D, made: LobeMaterial3D) -> void:
	made.roughness = 1.0
	made.metallic = 1.0
	made.ao_light_affect = source.ao_light_affect
	if source.ao_enabled:
		made.orm_texture = source.orm_texture
		return
	made.roughness_texture = source.orm_texture
	made.roughness_texture_channel = LobeMaterial3D.TextureChannel.GREEN
	made.metallic_texture = source.orm_texture
	made.metallic_texture_channel = LobeMaterial3D.TextureChannel.BLUE


static func _take_parts(source: BaseMaterial3D, made: LobeMaterial3D) -> void:
	made.metallic = source.metallic
	made.specular = source.metallic_specular
	made.metallic_texture = source.metallic_texture
	made.metallic_texture_channel = (
		source.metallic_texture_channel as LobeMaterial3D.TextureChannel
	)
	made.roughness = source.roughness
	made.roughness_texture = source.roughness_texture
	made.roughness_texture_channel = (
		source.roughness_texture_channel as LobeMaterial3D.TextureChannel
	)
	if source.ao_enabled:
		made.ao_texture = source.ao_texture
		made.ao_texture_channel = source.ao_texture_channel as LobeMaterial3D.TextureChannel
		made.ao_on_uv2 = source.ao_on_uv2
		made.ao_light_affect = source.ao_light_affect


static func _give_parts(source: LobeMaterial3D, made: BaseMaterial3D) -> void:
	var orm := source.orm_texture
	made.metallic = source.metallic
	made.metallic_specular = source.specular
	made.metallic_texture = orm if orm != null else source.metallic_texture
	made.metallic_texture_channel = (
		BaseMaterial3D.TEXTURE_CHANNEL_BLUE if orm != null else source.metallic_texture_channel
		as BaseMaterial3D.TextureChannel
	)
	made.roughness = _get_godots(source).x
	made.roughness_texture = orm if orm != null else source.roughness_texture
	made.roughness_texture_channel = (
		BaseMaterial3D.TEXTURE_CHANNEL_GREEN if orm != null else source.roughness_texture_channel
		as BaseMaterial3D.TextureChannel
	)
	made.ao_texture = orm if orm != null else source.ao_texture
	made.ao_enabled = made.ao_texture != null
	made.ao_texture_channel = (
		BaseMaterial3D.TEXTURE_CHANNEL_RED if orm != null else source.ao_texture_channel
		as BaseMaterial3D.TextureChannel
	)
	made.ao_on_uv2 = source.ao_on_uv2 and orm == null
	made.ao_light_affect = source.ao_light_affect


# Godot has no angle beside the flow map: without a map, one of a single direction stands for it.
static func _give_anisotropy(source: LobeMaterial3D, made: BaseMaterial3D) -> void:
	var anisotropy := _get_godots(source).y
	var angle := source.anisotropy_rotation
	made.anisotropy_flowmap = source.anisotropy_flowmap
	if angle != 0.0 and anisotropy != 0.0 and source.anisotropy_flowmap == null:
		if anisotropy < 0.0:
			anisotropy = Widths.exchanged(anisotropy)
			angle += 0.5 * PI
		var flow := 0.5 * Vector2.from_angle(angle) + Vector2(0.5, 0.5)
		var image := Image.create_empty(4, 4, false, Image.FORMAT_RGBAH)
		image.fill(Color(flow.x, flow.y, 0.0, 1.0))
		made.anisotropy_flowmap = ImageTexture.create_from_image(image)
	made.anisotropy_enabled = anisotropy != 0.0
	made.anisotropy = clampf(anisotropy, -1.0, 1.0)


# Roughness and anisotropy, of the material's own table where it has one.
static func _get_godots(source: LobeMaterial3D) -> Vector2:
	if source.table != null and source.table.get_problem().is_empty():
		return Widths.to_roughness(source.table.alpha)
	return Vector2(source.roughness, source.anisotropy)
