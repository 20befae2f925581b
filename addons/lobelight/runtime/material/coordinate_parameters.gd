@tool
extends Object
## Hands the rendering server where a [LobeMaterial3D]'s textures lie and where its vertices go: the
## uniforms that go with coordinate_defines.gd.

const GivenParameters := preload("given_parameters.gd")
const Numbers := preload("surface_numbers.gd")


static func apply(surface: LobeBaseMaterial3D) -> void:
	_apply_layer(surface, "lobelight_uv", surface.uv1_scale, surface.uv1_offset)
	_apply_layer(surface, "lobelight_uv2", surface.uv2_scale, surface.uv2_offset)
	if surface.uv1_triplanar:
		_give(surface, &"lobelight_uv1_scale", surface.uv1_scale)
		_give(surface, &"lobelight_uv1_offset", surface.uv1_offset)
		_give(surface, &"lobelight_uv1_sharpness", surface.uv1_triplanar_sharpness)
	if surface.uv2_triplanar:
		_give(surface, &"lobelight_uv2_scale", surface.uv2_scale)
		_give(surface, &"lobelight_uv2_offset", surface.uv2_offset)
		_give(surface, &"lobelight_uv2_sharpness", surface.uv2_triplanar_sharpness)
	if surface.has_relief():
		_apply_relief(surface)
	_apply_vertices(surface)


static func _apply_layer(
	surface: LobeBaseMaterial3D, name: String, scale: Vector3, offset: Vector3
) -> void:
	if scale != Vector3.ONE or offset != Vector3.ZERO:
		_give(surface, name + "_transform", Numbers.transform(scale, offset))


static func _apply_relief(surface: LobeBaseMaterial3D) -> void:
	_give(surface, &"lobelight_relief", Numbers.relief(surface.heightmap_scale))
	var depth := Vector2(0.0, 1.0) if surface.heightmap_flip_texture else Vector2(1.0, -1.0)
	_give(surface, &"lobelight_depth_of_texel", depth)
	var flip := Vector2(surface.heightmap_flip_tangent, surface.heightmap_flip_binormal)
	_give(surface, &"lobelight_relief_axes", Vector2.ONE - 2.0 * flip)
	if surface.heightmap_deep_parallax:
		var layers := Vector2(surface.heightmap_max_layers, surface.heightmap_min_layers)
		_give(surface, &"lobelight_relief_layers", layers)


static func _apply_vertices(surface: LobeBaseMaterial3D) -> void:
	if surface.billboard_mode == BaseMaterial3D.BILLBOARD_PARTICLES:
		var sheet := Vector2(surface.particles_anim_h_frames, surface.particles_anim_v_frames)
		_give(surface, &"lobelight_sheet", sheet)
		_give(surface, &"lobelight_sheet_loops", surface.particles_anim_loop)
	if surface.use_point_size:
		_give(surface, &"lobelight_point_size", surface.point_size)
	if surface.grow:
		_give(surface, &"lobelight_grow_amount", surface.grow_amount)
	if surface.use_z_clip_scale:
		_give(surface, &"lobelight_z_clip_scale", surface.z_clip_scale)
	if surface.use_fov_override:
		_give(surface, &"lobelight_fov_cotangent", Numbers.cotangent(surface.fov_override))


static func _give(surface: LobeBaseMaterial3D, name: StringName, value: Variant) -> void:
	GivenParameters.give(surface.get_rid(), name, value)
