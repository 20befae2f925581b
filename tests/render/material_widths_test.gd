extends GdUnitTestSuite
## LobeMaterial3D with tables from a set: roughness and anisotropy, for the whole surface and from
## pixel to pixel, against lobes_at() of table_at() on the CPU.

const Kit := preload("support/render_kit.gd")
const Oracle := preload("support/material_oracle.gd")
const SIDE := 48
# A percent, and the step of the half floats that pictures have.
const TOLERANCE := 0.011

var _view: LinearViewport
var _environment: LobeEnvironment3D
var _tables := Oracle.make_set()


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_environment = LobeEnvironment3D.new()
	_view.add_child(_environment)
	_environment.panorama = Kit.make_panorama(64, Oracle.light)
	await _environment.rebuild()


func after_test() -> void:
	_view.free()


func test_sliders_choose_the_widths() -> void:
	var material := _material()
	_view.add_child(Kit.make_sphere(material, 128))
	for pair: Array in [[0.3, 0.0], [0.5, 0.7], [0.4, 1.1], [0.4, -0.8], [0.0, 0.0], [1.0, 1.0]]:
		material.roughness = pair[0]
		material.anisotropy = pair[1]
		material.anisotropy_enabled = true
		var table := _tables.table_at(_clamped(LobeMaterial3D.widths_of(pair[0], pair[1])))
		await _check_sphere(table, str(pair))


func test_negative_anisotropy_turns_as_well() -> void:
	var material := _material()
	material.roughness = 0.5
	material.anisotropy = -0.8
	material.anisotropy_enabled = true
	_view.add_child(Kit.make_sphere(material))
	var plain: Image = await _view.capture()
	material.anisotropy_rotation = PI
	assert_float(Kit.psnr(await _view.capture(), plain)).is_greater(60.0)
	material.anisotropy_rotation = 0.5 * PI
	var turned: Image = await _view.capture()
	assert_float(Kit.psnr(turned, plain)).is_less(45.0)
	# The widths of -0.8 exchanged.
	material.anisotropy = 0.8 / (1.0 + 0.9 * 0.8)
	material.anisotropy_enabled = true
	material.anisotropy_rotation = 0.0
	material.roughness = 0.5
	var exchanged: Image = await _view.capture()
	material.anisotropy_rotation = 0.5 * PI
	var back: Image = await _view.capture()
	assert_float(Kit.psnr(turned, exchanged)).is_greater(50.0)
	assert_float(Kit.psnr(back, plain)).is_greater(50.0)


func test_an_animation_player_moves_the_sliders() -> void:
	var material := _material()
	var sphere := Kit.make_sphere(material)
	_view.add_child(sphere)
	var animation := Animation.new()
	var track := animation.add_track(Animation.TYPE_VALUE)
	animation.track_set_path(track, "Sphere:mesh:material:roughness")
	animation.track_insert_key(track, 0.0, 0.2)
	animation.track_insert_key(track, 1.0, 0.8)
	sphere.name = "Sphere"
	var library := AnimationLibrary.new()
	library.add_animation("move", animation)
	var player := AnimationPlayer.new()
	player.add_animation_library("", library)
	_view.add_child(player)
	player.play("move")
	player.seek(0.5, true)
	player.pause()
	assert_float(material.roughness).is_equal_approx(0.5, 1e-5)
	await _check_sphere(_tables.table_at(LobeMaterial3D.widths_of(0.5, 0.0)), "half way")


func test_roughness_from_pixel_to_pixel() -> void:
	await _check_gradient(0.0, 0.0)


func test_anisotropy_from_pixel_to_pixel() -> void:
	await _check_gradient(1.1, 0.6)


func test_negative_anisotropy_from_pixel_to_pixel() -> void:
	await _check_gradient(-1.0, -0.4)


func test_orm_has_the_roughness_in_green() -> void:
	var material := _material()
	var plain := _material()
	plain.roughness = 0.25
	material.roughness = 0.5
	# Alpha is not read; red is occlusion, blue the metal.
	material.orm_texture = _texture(func(_u: float, _v: float) -> Color: return Color(1, 0.5, 1))
	var quad := SphereImpostor.make_quad(material)
	_view.add_child(quad)
	var textured: Image = await _view.capture()
	(quad.mesh as QuadMesh).material = plain
	assert_float(Kit.psnr(textured, await _view.capture())).is_greater(50.0)


func test_default_set_without_any_setup() -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.4
	material.albedo_color = Color(0.8, 0.8, 0.8)
	_view.add_child(Kit.make_sphere(material, 128))
	var table := (load("res://addons/lobelight/tables/ggx_8.res") as LobeTableSet).table_at(
		LobeMaterial3D.widths_of(material.roughness, 0.0)
	)
	await _check_sphere(table, "ggx")


func _material() -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.4
	material.table_set = _tables
	material.albedo_color = Color(0.8, 0.8, 0.8)
	return material


func _clamped(widths: Vector2) -> Vector2:
	return widths.clampf(_tables.widths[0], _tables.widths[-1])


func _check_sphere(table: LobeTable, what: String) -> void:
	var image: Image = await _view.capture()
	var f0 := Color(0.8, 0.8, 0.8).srgb_to_linear().r
	for normal: Vector3 in [
		Vector3(0.02, 0.02, 1), Vector3(0.6, 0.3, 1), Vector3(-0.9, 0.7, 1), Vector3(0.9, -1.5, 1)
	]:
		var pixel := _pixel_of(normal)
		var frame := Kit.sphere_frame(Kit.sphere_normal(pixel.x, pixel.y, SIDE))
		var expected := Oracle.reflected(table, frame, Vector3.BACK, f0, 1.0, true)
		_assert_close(image.get_pixelv(pixel).r, expected, "%s at %s" % [what, normal])


# A tilted quad on which roughness rises from left to right over the whole range and anisotropy
# from bottom to top, up to the given one.
func _check_gradient(anisotropy: float, rotation: float) -> void:
	var material := _material()
	material.roughness_texture = _texture(func(u: float, _v: float) -> Color: return Color(u, 0, 0))
	material.roughness = 1.0
	material.anisotropy = anisotropy
	material.anisotropy_enabled = true
	material.anisotropy_rotation = rotation
	material.texture_filter = BaseMaterial3D.TEXTURE_FILTER_LINEAR
	material.texture_repeat = false
	material.anisotropy_flowmap = _texture(
		func(_u: float, v: float) -> Color: return Color(1, 0.5, 0, 1.0 - v)
	)
	var quad := SphereImpostor.make_quad(material)
	quad.basis = Basis(Vector3.UP, 0.6) * Basis(Vector3.RIGHT, -0.3)
	_view.add_child(quad)
	var direction := Vector3(0.5, -0.4, 0.7).normalized()
	# Parallel rays at an angle: the camera looks at the quad askew, all of it in the picture.
	_view.camera.look_at_from_position(4.0 * direction, Vector3.ZERO)
	var image: Image = await _view.capture()
	var turned := quad.basis * Basis(Vector3.BACK, rotation)
	var f0 := Color(0.8, 0.8, 0.8).srgb_to_linear().r
	var checked := 0
	for y in range(2, SIDE, 4):
		for x in range(2, SIDE, 3):
			var uv := _uv_of(quad, Vector2(x + 0.5, y + 0.5))
			if uv.x < 0.03 or uv.x > 0.97 or uv.y < 0.03 or uv.y > 0.97:
				continue
			var widths := LobeMaterial3D.widths_of(uv.x, anisotropy * (1.0 - uv.y))
			var table := _exact_table(_clamped(widths), anisotropy)
			var expected := Oracle.reflected(table, turned, direction, f0, 1.0, true)
			_assert_close(image.get_pixel(x, y).r, expected, "roughness, anisotropy %s" % uv)
			checked += 1
	assert_int(checked).is_greater(40)


# For equal widths table_at() gives the isotropic table; where anisotropy varies, the shader stays
# with the others.
func _exact_table(widths: Vector2, anisotropy: float) -> LobeTable:
	if anisotropy != 0.0 and absf(log(widths.x / widths.y)) < 1e-4:
		var end := 1.0001 if widths.x < _tables.widths[1] else 1.0 / 1.0001
		if (anisotropy > 0.0) == (end > 1.0):
			widths.x *= end
		else:
			widths.y *= end
	return _tables.table_at(widths)


# Texture coordinates of a quad of 2 × 2 at a pixel.
func _uv_of(quad: MeshInstance3D, pixel: Vector2) -> Vector2:
	var origin := _view.camera.project_ray_origin(pixel)
	var ray := _view.camera.project_ray_normal(pixel)
	var plane := Plane(quad.basis.z, 0.0)
	var hit: Vector3 = plane.intersects_ray(origin, ray)
	var local := quad.transform.affine_inverse() * hit
	return Vector2(0.5 + 0.5 * local.x, 0.5 - 0.5 * local.y)


# Floats, so that no steps of bytes come in.
func _texture(colour: Callable) -> ImageTexture:
	var image := Image.create_empty(64, 64, false, Image.FORMAT_RGBAF)
	for y in 64:
		for x in 64:
			var texel: Color = colour.call((x + 0.5) / 64.0, (y + 0.5) / 64.0)
			image.set_pixel(x, y, texel)
	return ImageTexture.create_from_image(image)


func _pixel_of(normal: Vector3) -> Vector2i:
	var unit := normal.normalized()
	return Vector2i((Vector2(unit.x + 1.0, 1.0 - unit.y) * 0.5 * SIDE).floor())


func _assert_close(got: float, expected: float, what: String) -> void:
	(
		assert_float(got / expected)
		. append_failure_message("%s: %f, expected %f" % [what, got, expected])
		. is_equal_approx(1.0, TOLERANCE)
	)
