@tool
extends RefCounted
## What a [LobeMaterial3D] says of its surface, as the scripts that draw it take it. They know
## nothing of the class itself.

## The material on the rendering server.
var rid: RID
var table_set: LobeTableSet
var table: LobeTable

var transparency := BaseMaterial3D.TRANSPARENCY_DISABLED
var alpha_scissor_threshold := 0.5
var alpha_hash_scale := 1.0
var blend_mode := BaseMaterial3D.BLEND_MODE_MIX
var cull_mode := BaseMaterial3D.CULL_BACK
var vertex_color_use_as_albedo := false
var vertex_color_is_srgb := false

var albedo_texture: Texture2D
var orm_texture: Texture2D
var metallic := 1.0
var specular := 0.5
var metallic_texture: Texture2D
var metallic_texture_channel := BaseMaterial3D.TEXTURE_CHANNEL_RED
var roughness := 0.4
var roughness_texture: Texture2D
var roughness_texture_channel := BaseMaterial3D.TEXTURE_CHANNEL_RED
var anisotropy := 0.0
var anisotropy_flowmap: Texture2D
var anisotropy_rotation := 0.0
var normal_texture: Texture2D
var normal_scale := 1.0
var clearcoat := 0.0
var clearcoat_roughness := 0.5
var clearcoat_texture: Texture2D
var ao_texture: Texture2D
var ao_texture_channel := BaseMaterial3D.TEXTURE_CHANNEL_RED
var ao_on_uv2 := false
var ao_light_affect := 0.0
var emission := Color.BLACK
var emission_energy := 1.0
var emission_operator := BaseMaterial3D.EMISSION_OP_ADD
var emission_texture: Texture2D

var uv1_scale := Vector2.ONE
var uv1_offset := Vector2.ZERO
var texture_filter := BaseMaterial3D.TEXTURE_FILTER_LINEAR_WITH_MIPMAPS_ANISOTROPIC
var texture_repeat := true


## Whether there is diffuse light.
func is_dielectric() -> bool:
	return metallic_texture != null or orm_texture != null or metallic < 1.0


func emits() -> bool:
	if emission_energy == 0.0:
		return false
	var is_dark := emission.r == 0.0 and emission.g == 0.0 and emission.b == 0.0
	if emission_texture == null:
		return not is_dark
	return not is_dark or emission_operator == BaseMaterial3D.EMISSION_OP_ADD


## Whether the widths vary from pixel to pixel.
func varies() -> bool:
	if orm_texture != null or roughness_texture != null:
		return true
	return anisotropy != 0.0 and anisotropy_flowmap != null and anisotropy_flowmap.has_alpha()
