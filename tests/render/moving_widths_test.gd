extends GdUnitTestSuite
## LobeMaterial3D whose widths change time and again: the tables that the GPU mixes are those of the
## processor, nothing is seen of the change to them, and several materials keep to their own.

const Kit := preload("support/render_kit.gd")
const Oracle := preload("support/material_oracle.gd")
const SIDE := 48
const READY := preload("res://addons/lobelight/tables/ggx_8.res")

var _view: LinearViewport


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)


func after_test() -> void:
	_view.free()


func test_mixed_tables_are_those_of_the_processor() -> void:
	var mixer: GDScript = load("res://addons/lobelight/runtime/mixing/table_mixer.gd")
	# More than one page has, one beside the other.
	var tables := []
	var cases: Array[Vector2] = []
	for i in 6:
		tables.append(mixer.call("take", READY, null))
		cases.append(Vector2(0.15 + 0.15 * i, [0.5, -0.9, 1.1, 0.03, 1.0, -0.2][i]))
		RenderingServer.canvas_item_set_instance_shader_parameter(
			tables[i].item, tables[i].SURFACE, cases[i]
		)
		tables[i].draw()
	await _view.capture()
	for i in 6:
		var widths := LobeMaterial3D.widths_of(cases[i].x, cases[i].y)
		var page: Image = RenderingServer.texture_2d_get(tables[i].texture)
		var expected := READY.table_at(widths)
		var lookup: Vector4 = tables[i].lookup
		# Where the first column is.
		var left := roundi(lookup.y * page.get_width() - 0.5)
		var size := expected.image.get_size()
		assert_int(page.get_height()).is_equal(size.y)
		var shown := page.get_region(Rect2i(Vector2i(left, 0), size))
		_divide_slopes(shown, expected.alpha)
		# A step of the half floats of the largest sharpnesses.
		assert_float(_largest_difference(shown, expected.image)).is_less(0.016)


func test_the_change_is_not_seen() -> void:
	var environment := LobeEnvironment3D.new()
	_view.add_child(environment)
	environment.panorama = Kit.make_panorama(64, Oracle.light)
	await environment.rebuild()
	var material := _material(0.0)
	var other := _material(0.5)
	var sphere := Kit.make_sphere(material)
	_view.add_child(sphere)
	for anisotropy: float in [0.0, 0.9, -0.6]:
		material.anisotropy = anisotropy
		other.anisotropy = anisotropy
		for roughness: float in [0.3, 0.5, 0.42, 0.61]:
			# Another one that moves as well.
			other.roughness = 1.0 - roughness
			material.roughness = roughness
			var shown: Image = await _view.capture()
			var still := _material(anisotropy)
			still.roughness = roughness
			(sphere.mesh as PrimitiveMesh).material = still
			var expected: Image = await _view.capture()
			(sphere.mesh as PrimitiveMesh).material = material
			var most := 1.0 / 255.0
			if _is_stepped():
				# Compatibility's pictures have steps of 1 / 255 as screens show them: one of these.
				shown = _encoded(shown)
				expected = _encoded(expected)
				most *= 1.01
			var difference := _largest_difference(shown, expected)
			(
				assert_float(difference)
				. override_failure_message("%s, %s: %s" % [roughness, anisotropy, difference])
				. is_less(most)
			)


func test_moving_widths_keep_the_shader() -> void:
	var material := _material(0.7)
	_view.add_child(Kit.make_sphere(material))
	await _view.capture()
	var code := material.get_shader_code()
	for i in 4:
		material.roughness = 0.2 + 0.1 * i
		material.anisotropy = 0.3 + 0.1 * i
		await _view.capture()
		assert_str(material.get_shader_code()).is_equal(code)


func _material(anisotropy: float) -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.anisotropy_enabled = true
	material.anisotropy = anisotropy
	return material


static func _divide_slopes(image: Image, alpha: Vector2) -> void:
	for y in image.get_height():
		for x in image.get_width():
			var texel := image.get_pixel(x, y)
			image.set_pixel(x, y, Color(texel.r / alpha.x, texel.g / alpha.y, texel.b, texel.a))


static func _is_stepped() -> bool:
	return RenderingServer.get_current_rendering_method() == "gl_compatibility"


static func _encoded(image: Image) -> Image:
	var encoded := Image.create_empty(
		image.get_width(), image.get_height(), false, Image.FORMAT_RGBAF
	)
	for y in image.get_height():
		for x in image.get_width():
			encoded.set_pixel(x, y, image.get_pixel(x, y).linear_to_srgb())
	return encoded


static func _largest_difference(one: Image, other: Image) -> float:
	var largest := 0.0
	for y in one.get_height():
		for x in one.get_width():
			var difference := one.get_pixel(x, y) - other.get_pixel(x, y)
			for channel in 4:
				largest = maxf(largest, absf(difference[channel]))
	return largest
