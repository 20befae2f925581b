extends GdUnitTestSuite
## Normals that differ within a pixel widen reflections: by the variance that a texture tells, by
## that of the bumps that a supersampled picture shows, and not where nothing asks for it.

const Flicker := preload("res://bake/bench_flicker.gd")
const Kit := preload("support/render_kit.gd")
const SIDE := 24
const SAMPLES := 8


func test_only_what_asks_for_it_has_it() -> void:
	var material := LobeMaterial3D.new()
	assert_bool("ANTIALIASED" in material.get_shader_code()).is_false()
	material.specular_antialiasing = LobeBaseMaterial3D.SpecularAntialiasing.ENABLED
	assert_bool("ANTIALIASED" in material.get_shader_code()).is_true()
	material.specular_antialiasing = LobeBaseMaterial3D.SpecularAntialiasing.AUTOMATIC
	material.normal_texture = _flat(Vector2i(4, 4))
	assert_bool("ANTIALIASED" in material.get_shader_code()).is_false()
	material.normal_enabled = true
	assert_bool("ANTIALIASED" in material.get_shader_code()).is_true()
	assert_bool("NORMAL_VARIANCE_TEXTURE" in material.get_shader_code()).is_false()
	material.normal_variance_texture = _flat(Vector2i(2, 2))
	assert_bool("NORMAL_VARIANCE_TEXTURE" in material.get_shader_code()).is_true()
	material.specular_antialiasing = LobeBaseMaterial3D.SpecularAntialiasing.DISABLED
	assert_bool("VARIANCE" in material.get_shader_code()).is_false()


func test_baked_variance_is_that_of_the_texels() -> void:
	# Stripes two texels wide, so that the first level has nothing to tell.
	var stripes := Image.create_empty(8, 8, false, Image.FORMAT_RGB8)
	for y in 8:
		for x in 8:
			stripes.set_pixel(x, y, Color(0.25 if x % 4 < 2 else 0.75, 0.5, 0.9))
	var levels := LobeMaterial3D.bake_normal_variance(stripes).get_image()
	assert_int(levels.get_width()).is_equal(4)
	assert_int(levels.get_mipmap_count()).is_equal(2)
	var data := levels.get_data()
	for i in 16:
		assert_int(data[i]).is_less(2)
	# x is 1/2 up or down.
	for i in range(16, data.size()):
		assert_float(data[i] / 255.0).is_equal_approx(0.5, 0.01)


# In light that is linear in the direction, a lobe of the variance V shows 1 - V of the slope. Seen
# along the normal, normals of the variance s^2 add 4 s^2.
func test_variance_widens_reflections() -> void:
	var light := Kit.make_panorama(64, func(d: Vector3) -> Color: return Color.WHITE * (1.0 + d.z))
	var material := _metal()
	material.normal_texture = _flat(Vector2i(8, 8))
	var variances := [0.0, 0.02, 0.04]
	var slopes := []
	for variance: float in variances:
		var level := Image.create_empty(4, 4, true, Image.FORMAT_R8)
		level.fill(Color.WHITE * sqrt(2.0 * variance))
		level.generate_mipmaps()
		material.normal_variance_texture = ImageTexture.create_from_image(level)
		var image := await _draw(material, light, SIDE)
		slopes.append(image.get_pixel(SIDE / 2, SIDE / 2).g - 1.0)
	for i: int in [1, 2]:
		var lost: float = slopes[0] - slopes[i]
		assert_float(lost).is_equal_approx(4.0 * variances[i], 0.8 * variances[i])


func test_far_bumps_look_as_rough_as_they_are() -> void:
	var light := Kit.make_panorama(64, _light_from_a_side)
	var bumps := Flicker.make_bumps(0.3)
	var material := _metal()
	var variance := LobeMaterial3D.bake_normal_variance(bumps)
	bumps.generate_mipmaps(true)
	material.normal_texture = ImageTexture.create_from_image(bumps)
	# Four texels a pixel.
	material.uv1_scale = Vector3.ONE * (4.0 * SIDE / bumps.get_width())
	var off := LobeBaseMaterial3D.SpecularAntialiasing.DISABLED
	material.specular_antialiasing = off
	var truth := await _draw(material, light, SIDE * SAMPLES)
	for halving in 3:
		truth.shrink_x2()
	var without := await _draw(material, light, SIDE)
	material.specular_antialiasing = LobeBaseMaterial3D.SpecularAntialiasing.AUTOMATIC
	var by_derivatives := await _draw(material, light, SIDE)
	material.normal_variance_texture = variance
	var baked := await _draw(material, light, SIDE)
	assert_float(Kit.psnr(by_derivatives, truth)).is_greater(Kit.psnr(without, truth) + 0.5)
	assert_float(Kit.psnr(baked, truth)).is_greater(Kit.psnr(without, truth) + 3.0)


static func _light_from_a_side(direction: Vector3) -> Color:
	return Color.WHITE * (0.05 + 0.8 * smoothstep(0.0, 0.3, direction.x))


func _metal() -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.25
	material.normal_enabled = true
	material.uv1_scale = Vector3.ONE * 16.0
	return material


func _flat(size: Vector2i) -> ImageTexture:
	var image := Image.create_empty(size.x, size.y, true, Image.FORMAT_RGB8)
	image.fill(Color(0.5, 0.5, 1.0))
	image.generate_mipmaps()
	return ImageTexture.create_from_image(image)


func _draw(material: LobeMaterial3D, light: Texture2D, side: int) -> Image:
	var view := LinearViewport.new(side)
	add_child(view)
	var environment := LobeEnvironment3D.new()
	environment.panorama = light
	view.add_child(environment)
	var quad := MeshInstance3D.new()
	var mesh := QuadMesh.new()
	mesh.size = Vector2(2.0, 2.0)
	mesh.material = material
	quad.mesh = mesh
	view.add_child(quad)
	for frame in 3:
		await view.capture()
	var image := await view.capture()
	view.free()
	return image
