@tool
extends Object
## Defines of a [LobeMaterial3D]'s shader for where its textures lie and where its vertices go; see
## shaders/coordinates.gdshaderinc and shaders/vertex.gdshaderinc.

const _FILTERS: PackedStringArray = [
	"filter_nearest",
	"filter_linear",
	"filter_nearest_mipmap",
	"filter_linear_mipmap",
	"filter_nearest_mipmap_anisotropic",
	"filter_linear_mipmap_anisotropic",
]


## For a material with textures.
static func add(surface: LobeBaseMaterial3D, defines: PackedStringArray) -> void:
	var repeat := "repeat_enable" if surface.texture_repeat else "repeat_disable"
	var filter := _FILTERS[surface.texture_filter]
	defines.append("SAMPLING %s, %s" % [filter, repeat])
	if surface.uv1_triplanar:
		_add_planes("UV1", surface.uv1_world_triplanar, defines)
	elif surface.uv1_scale != Vector3.ONE or surface.uv1_offset != Vector3.ZERO:
		defines.append("UV_TRANSFORM")
	# As BaseMaterial3D has it: without details on them, second coordinates are the mesh's own.
	var on_second := surface.detail_uv_layer == BaseMaterial3D.DETAIL_UV_2
	if surface.uv2_triplanar:
		_add_planes("UV2", surface.uv2_world_triplanar, defines)
	elif on_second and (surface.uv2_scale != Vector3.ONE or surface.uv2_offset != Vector3.ZERO):
		defines.append("UV2_TRANSFORM")
	if surface.has_relief():
		defines.append("PARALLAX")
		var linear := filter.replace("nearest", "linear")
		defines.append("HEIGHT_SAMPLING %s, %s" % [linear, repeat])
		if surface.heightmap_deep_parallax:
			defines.append("DEEP_PARALLAX")
		if surface.detail_enabled and on_second:
			defines.append("PARALLAX_ON_UV2")


static func add_vertices(surface: LobeBaseMaterial3D, defines: PackedStringArray) -> void:
	if not surface.moves_vertices():
		return
	defines.append("VERTICES")
	match surface.billboard_mode:
		BaseMaterial3D.BILLBOARD_ENABLED:
			defines.append("FACING")
		BaseMaterial3D.BILLBOARD_FIXED_Y:
			defines.append("FACING_UPRIGHT")
		BaseMaterial3D.BILLBOARD_PARTICLES:
			defines.append("FACING_PARTICLE")
	if surface.billboard_mode != BaseMaterial3D.BILLBOARD_DISABLED and surface.billboard_keep_scale:
		defines.append("FACING_SCALED")
	if surface.fixed_size:
		defines.append("FIXED_SIZE")
	if surface.use_point_size:
		defines.append("POINT_SIZE")
	if surface.grow:
		defines.append("GROW")
	if surface.use_z_clip_scale:
		defines.append("Z_CLIP_SCALE")
	if surface.use_fov_override:
		defines.append("FOV_OVERRIDE")


static func _add_planes(layer: String, in_world: bool, defines: PackedStringArray) -> void:
	if "TRIPLANAR" not in defines:
		defines.append("TRIPLANAR")
	defines.append(layer + "_TRIPLANAR")
	if in_world:
		defines.append(layer + "_WORLD_TRIPLANAR")
