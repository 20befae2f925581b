extends GdUnitTestSuite
## Conversion between Godot's materials and LobeMaterial3D.


func _texture() -> Texture2D:
	return ImageTexture.create_from_image(Image.create_empty(2, 2, false, Image.FORMAT_RGB8))


func _full_material() -> StandardMaterial3D:
	var source := StandardMaterial3D.new()
	source.resource_name = "brushed"
	source.albedo_color = Color(0.8, 0.5, 0.3, 0.6)
	source.albedo_texture = _texture()
	source.metallic = 0.7
	source.metallic_specular = 0.3
	source.metallic_texture = _texture()
	source.metallic_texture_channel = BaseMaterial3D.TEXTURE_CHANNEL_BLUE
	source.roughness = 0.35
	source.roughness_texture = _texture()
	source.roughness_texture_channel = BaseMaterial3D.TEXTURE_CHANNEL_GREEN
	source.emission_enabled = true
	source.emission = Color(0.1, 0.2, 0.3)
	source.emission_energy_multiplier = 3.0
	source.emission_operator = BaseMaterial3D.EMISSION_OP_MULTIPLY
	source.emission_texture = _texture()
	source.normal_enabled = true
	source.normal_texture = _texture()
	source.normal_scale = 0.6
	source.clearcoat_enabled = true
	source.clearcoat = 0.8
	source.clearcoat_roughness = 0.2
	source.clearcoat_texture = _texture()
	source.anisotropy_enabled = true
	source.anisotropy = -0.6
	source.anisotropy_flowmap = _texture()
	source.ao_enabled = true
	source.ao_texture = _texture()
	source.ao_light_affect = 0.4
	source.ao_on_uv2 = true
	source.ao_texture_channel = BaseMaterial3D.TEXTURE_CHANNEL_ALPHA
	source.transparency = BaseMaterial3D.TRANSPARENCY_ALPHA_SCISSOR
	source.alpha_scissor_threshold = 0.3
	source.blend_mode = BaseMaterial3D.BLEND_MODE_ADD
	source.cull_mode = BaseMaterial3D.CULL_DISABLED
	source.vertex_color_use_as_albedo = true
	source.uv1_scale = Vector3(2.0, 3.0, 1.0)
	source.uv1_offset = Vector3(0.5, 0.25, 0.0)
	source.uv1_triplanar = true
	source.uv1_triplanar_sharpness = 2.0
	source.uv1_world_triplanar = true
	source.uv2_scale = Vector3(3.0, 2.0, 1.0)
	source.uv2_offset = Vector3(0.25, 0.5, 0.75)
	source.uv2_triplanar = true
	source.uv2_triplanar_sharpness = 3.0
	source.uv2_world_triplanar = true
	source.albedo_texture_force_srgb = true
	source.albedo_texture_msdf = true
	source.msdf_pixel_range = 6.0
	source.msdf_outline_size = 2.0
	source.emission_on_uv2 = true
	source.heightmap_enabled = true
	source.heightmap_scale = 3.0
	source.heightmap_deep_parallax = true
	source.heightmap_min_layers = 4
	source.heightmap_max_layers = 20
	source.heightmap_flip_tangent = true
	source.heightmap_flip_binormal = true
	source.heightmap_texture = _texture()
	source.heightmap_flip_texture = true
	source.detail_enabled = true
	source.detail_mask = _texture()
	source.detail_blend_mode = BaseMaterial3D.BLEND_MODE_MUL
	source.detail_uv_layer = BaseMaterial3D.DETAIL_UV_2
	source.detail_albedo = _texture()
	source.detail_normal = _texture()
	source.billboard_mode = BaseMaterial3D.BILLBOARD_PARTICLES
	source.billboard_keep_scale = true
	source.particles_anim_h_frames = 3
	source.particles_anim_v_frames = 4
	source.particles_anim_loop = true
	source.grow = true
	source.grow_amount = 0.2
	source.fixed_size = true
	source.use_point_size = true
	source.point_size = 5.0
	source.use_particle_trails = true
	source.use_z_clip_scale = true
	source.z_clip_scale = 0.5
	source.use_fov_override = true
	source.fov_override = 50.0
	source.texture_filter = BaseMaterial3D.TEXTURE_FILTER_NEAREST
	source.texture_repeat = false
	source.next_pass = StandardMaterial3D.new()
	source.render_priority = 3
	return source


func test_there_and_back() -> void:
	var source := _full_material()
	var made := LobeMaterial3D.from_standard(source)
	assert_float(made.roughness).is_equal_approx(0.35, 1e-6)
	assert_float(made.anisotropy).is_equal_approx(-0.6, 1e-6)
	assert_object(made.anisotropy_flowmap).is_same(source.anisotropy_flowmap)
	assert_array(LobeMaterial3D.get_losses_from(source)).is_empty()
	var back := made.to_standard()
	assert_bool(back is StandardMaterial3D).is_true()
	_assert_same(source, back)


func test_defaults() -> void:
	var source := StandardMaterial3D.new()
	var made := LobeMaterial3D.from_standard(source)
	assert_float(made.metallic).is_equal(0.0)
	assert_float(made.roughness).is_equal(1.0)
	assert_bool(made.is_coated()).is_false()
	assert_object(made.normal_texture).is_null()
	_assert_same(source, made.to_standard())


func test_features_that_are_off_stay_off() -> void:
	var source := _full_material()
	for feature: StringName in [
		&"anisotropy_enabled",
		&"ao_enabled",
		&"clearcoat_enabled",
		&"detail_enabled",
		&"emission_enabled",
		&"heightmap_enabled",
		&"normal_enabled"
	]:
		source.set(feature, false)
	var made := LobeMaterial3D.from_standard(source)
	assert_float(made.get_shown_anisotropy()).is_equal(0.0)
	assert_bool(made.is_coated()).is_false()
	assert_bool(made.is_occluded()).is_false()
	assert_bool(made.has_normal_map()).is_false()
	assert_bool(made.emits()).is_false()
	_assert_same(source, made.to_standard())


func test_orm() -> void:
	# Godot takes roughness and metallic of these from the texture alone.
	var source := ORMMaterial3D.new()
	source.orm_texture = _texture()
	source.ao_enabled = true
	source.roughness = 0.3
	source.metallic = 0.2
	var made := LobeMaterial3D.from_standard(source)
	assert_object(made.orm_texture).is_same(source.orm_texture)
	assert_float(made.roughness).is_equal(1.0)
	assert_float(made.metallic).is_equal(1.0)
	var back := made.to_standard()
	assert_bool(back is ORMMaterial3D).is_true()
	assert_object(back.orm_texture).is_same(source.orm_texture)
	assert_bool(back.ao_enabled).is_true()
	# Without occlusion, the texture's red is not to be read.
	source.ao_enabled = false
	made = LobeMaterial3D.from_standard(source)
	assert_object(made.orm_texture).is_same(source.orm_texture)
	assert_bool(made.is_occluded()).is_false()
	# With factors, an ORMMaterial3D would forget them.
	made.orm_texture = source.orm_texture
	made.roughness = 0.5
	var parts := made.to_standard()
	assert_bool(parts is StandardMaterial3D).is_true()
	assert_float(parts.roughness).is_equal(0.5)
	assert_object(parts.roughness_texture).is_same(source.orm_texture)
	assert_int(parts.roughness_texture_channel).is_equal(BaseMaterial3D.TEXTURE_CHANNEL_GREEN)
	assert_object(parts.ao_texture).is_same(source.orm_texture)


func test_an_angle_becomes_a_flow_map() -> void:
	var made := LobeMaterial3D.new()
	made.anisotropy_enabled = true
	made.anisotropy = 0.5
	made.anisotropy_rotation = 0.7
	var texel := made.to_standard().anisotropy_flowmap.get_image().get_pixel(1, 1)
	var flow := Vector2(texel.r, texel.g) * 2.0 - Vector2.ONE
	assert_float(flow.angle()).is_equal_approx(0.7, 2e-3)
	assert_float(texel.a).is_equal(1.0)


func test_a_table_gives_its_widths() -> void:
	var made := LobeMaterial3D.new()
	made.table = LobeTable.make_single_lobe(0.25)
	var back := made.to_standard()
	assert_float(back.roughness).is_equal_approx(0.5, 1e-5)
	assert_bool(back.anisotropy_enabled).is_false()


func _assert_same(a: Material, b: Material, except: PackedStringArray = []) -> void:
	for property in a.get_property_list():
		var name: String = property["name"]
		if property["usage"] & PROPERTY_USAGE_STORAGE and name not in except:
			assert_that(b.get(name)).append_failure_message(name).is_equal(a.get(name))
