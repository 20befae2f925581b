extends GdUnitTestSuite
## The light of a pixel's place: boxes with the light of rooms, how they fade into one another and
## into the environment, and where on a box's walls a reflection lies.

const Kit := preload("support/render_kit.gd")
const SIDE := 48
# Half a step of eight bits, twice: what nobody sees.
const SAME := 1.0 / 255.0

var _view: LinearViewport
var _environment: LobeEnvironment3D


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)


func after_test() -> void:
	_view.free()


func test_a_box_far_away_is_like_an_environment() -> void:
	var light := _make_light(32, _colourful)
	for material in _materials():
		material.light = light
		var sphere := Kit.make_sphere(material, 32)
		_view.add_child(sphere)
		var expected: Image = await _view.capture()
		# The same, seen from the middle of a huge box: as the material's own, and as a probe's.
		var boxed: LobeLight = light.duplicate()
		boxed.box_size = 4000.0 * Vector3.ONE
		material.light = boxed
		_assert_same(await _view.capture(), expected, "own light of %s" % material.resource_name)
		material.light = null
		var probe := _add_probe(light, Vector3.ZERO, 4000.0 * Vector3.ONE)
		_assert_same(await _view.capture(), expected, "probe for %s" % material.resource_name)
		probe.free()
		sphere.free()


func test_outside_of_all_boxes_is_the_environment() -> void:
	var material := _metal(8, Vector2(0.1, 0.3))
	_view.add_child(Kit.make_sphere(material, 32))
	await _light(Kit.make_panorama(32, func(d: Vector3) -> Color: return _colourful(d)))
	var expected: Image = await _view.capture()
	var probe := _add_probe(_make_light(4, _constant(5.0)), Vector3(20, 0, 0), 8.0 * Vector3.ONE)
	_assert_same(await _view.capture(), expected, "a probe elsewhere")
	# Half of the light fades over the sphere, and what is outside stays.
	probe.position = Vector3(-2.0, 0.0, 0.0)
	probe.size = Vector3(4.0, 40.0, 40.0)
	probe.blend_distance = 0.25
	var image: Image = await _view.capture()
	for x: int in range(33, 44, 3):
		var difference := image.get_pixel(x, 24).r - expected.get_pixel(x, 24).r
		assert_float(absf(difference)).is_less(SAME)
	assert_float(image.get_pixel(18, 24).r - expected.get_pixel(18, 24).r).is_greater(0.5)


func test_lights_fade_by_the_depth_in_their_boxes() -> void:
	# One lobe of weight 1 everywhere: a constant light's picture is that constant.
	_view.add_child(Kit.make_sphere(_metal(1, Vector2(0.2, 0.2)), 64))
	await _light(Kit.constant(0.0))
	# Ends at x = 0, and at x = 0.5 nothing is left.
	var probe := _add_probe(_make_light(4, _constant(1.0)), Vector3(-4, 0, 0), 8.0 * Vector3.ONE)
	probe.blend_distance = 0.5
	var image: Image = await _view.capture()
	var weights := _weights(image)
	for x in weights:
		var normal := Kit.sphere_normal(x, 24, SIDE)
		var expected := clampf(1.0 - normal.x / 0.5, 0.0, 1.0)
		assert_float(weights[x]).override_failure_message("at %s" % normal.x).is_equal_approx(
			expected, 0.01
		)


func test_equal_priorities_are_mixed_and_higher_ones_come_first() -> void:
	_view.add_child(Kit.make_sphere(_metal(1, Vector2(0.2, 0.2)), 64))
	await _light(Kit.constant(0.0))
	# The left one ends at x = 0.25, the right one at x = -0.25, each fades over 1 m.
	var left := _add_probe(
		_make_light(4, _filled(Color(1, 0, 0))), Vector3(-3.75, 0, 0), 8.0 * Vector3.ONE
	)
	var right := _add_probe(
		_make_light(4, _filled(Color(0, 1, 0))), Vector3(3.75, 0, 0), 8.0 * Vector3.ONE
	)
	for priority: int in [0, 1]:
		left.priority = priority
		var image: Image = await _view.capture()
		for x: int in range(6, 44, 4):
			var place := Kit.sphere_normal(x, 24, SIDE).x
			var shares := Vector2(clampf(1.25 - place, 0.0, 1.0), clampf(1.25 + place, 0.0, 1.0))
			if priority == 0:
				shares /= maxf(shares.x + shares.y, 1.0)
			else:
				shares.y *= 1.0 - shares.x
			var got := image.get_pixel(x, 24)
			var what := "priority %d at %s" % [priority, place]
			_assert_near(got.r, shares.x, 0.01, what)
			_assert_near(got.g, shares.y, 0.01, what)


func test_reflections_lie_where_the_walls_are() -> void:
	# A mirror in a box, captured off its middle. The walls' light says where a point of them is.
	var half := Vector3(3.0, 1.5, 2.0)
	var middle := Vector3(0.5, 0.2, 0.4)
	var capture := Vector3(-1.0, 0.3, 0.5)
	var turn := Basis.from_euler(Vector3(0.3, 0.5, -0.2))
	var walls := func(d: Vector3) -> Color: return _wall(capture, d, half)
	var probe := _add_probe(_make_light(64, walls), middle, 2.0 * half)
	probe.basis = turn
	probe.origin_offset = capture
	_view.add_child(Kit.make_sphere(_metal(1, Vector2(0.02, 0.02), 14.0), 128))
	var image: Image = await _view.capture()
	var off := PackedFloat32Array()
	for y in range(4, SIDE, 5):
		for x in range(4, SIDE, 5):
			var normal := Kit.sphere_normal(x, y, SIDE)
			if normal.z < 0.3:
				continue
			var reflected := 2.0 * normal.z * normal - Vector3.BACK
			var place := (normal - middle) * turn
			var expected := _wall(place, reflected * turn, half)
			var got := image.get_pixel(x, y)
			off.append(
				absf(got.r - expected.r) + absf(got.g - expected.g) + absf(got.b - expected.b)
			)
	off.sort()
	# At the walls' edges the light bends.
	assert_float(off[off.size() * 9 / 10]).is_less(0.03)
	assert_float(off[off.size() / 2]).is_less(0.012)


func test_materials_with_holes_are_drawn() -> void:
	# Mesa's drivers have crashed in loops where a `discard` comes before.
	var material := _metal(8, Vector2(0.1, 0.3))
	material.transparency = BaseMaterial3D.TRANSPARENCY_ALPHA_SCISSOR
	material.alpha_scissor_threshold = 0.5
	var holes := Image.create_empty(4, 4, false, Image.FORMAT_RGBA8)
	holes.fill(Color.WHITE)
	holes.fill_rect(Rect2i(0, 0, 4, 2), Color.TRANSPARENT)
	material.albedo_texture = ImageTexture.create_from_image(holes)
	_view.add_child(Kit.make_sphere(material, 32))
	_add_probe(_make_light(8, _constant(1.0)), Vector3.ZERO, 4.0 * Vector3.ONE)
	var image: Image = await _view.capture()
	assert_bool(Kit.is_finite_image(image)).is_true()
	var seen := 0
	for y in SIDE:
		for x in SIDE:
			seen += int(image.get_pixel(x, y).g > 0.05)
	assert_int(seen).is_between(SIDE * SIDE / 4, SIDE * SIDE * 6 / 10)


func test_places_are_those_of_moved_vertices() -> void:
	# A quad in a light that fades along it, and others that are turned or moved into its place.
	var material := _metal(8, Vector2(0.1, 0.3))
	var quad := SphereImpostor.make_quad(material)
	_view.add_child(quad)
	await _light(Kit.constant(0.0))
	var probe := _add_probe(_make_light(8, _colourful), Vector3(-4, 0, 0), 8.0 * Vector3.ONE)
	probe.blend_distance = 0.5
	var expected: Image = await _view.capture()
	assert_float(expected.get_pixel(4, 24).g).is_greater(expected.get_pixel(44, 24).g + 0.1)
	material.billboard_mode = BaseMaterial3D.BILLBOARD_ENABLED
	quad.rotation.y = 0.5 * PI
	_assert_same(await _view.capture(), expected, "a billboard")
	material.billboard_mode = BaseMaterial3D.BILLBOARD_DISABLED
	quad.rotation.y = 0.0
	_view.camera.size = 3.0
	quad.scale = 1.5 * Vector3(0.5, 1.0, 1.0)
	var narrow: Image = await _view.capture()
	# In a picture that is two high it has its own size.
	quad.scale = Vector3(0.5, 1.0, 1.0)
	material.fixed_size = true
	_assert_same(await _view.capture(), narrow, "a fixed size")
	material.fixed_size = false
	_view.camera.size = 2.0
	quad.basis = Basis(Vector3.UP, 0.25 * PI)
	material.grow = true
	material.grow_amount = 0.25
	quad.position = -0.25 * quad.basis.z
	var grown: Image = await _view.capture()
	material.grow = false
	quad.position = Vector3.ZERO
	_assert_same(await _view.capture(), grown, "growth")


func test_samplers_are_counted() -> void:
	var material := _metal(8, Vector2(0.1, 0.3))
	assert_dict(material.get_fetches()).is_equal({"environment": 8, "table": 8, "samplers": 2})
	var probe := _add_probe(_make_light(4, _constant(1.0)), Vector3.ZERO, 4.0 * Vector3.ONE)
	# The list of lights, and their array or, in Compatibility, four cube maps.
	var samplers := 7 if LinearViewport.is_compatibility() else 4
	assert_dict(material.get_fetches()).is_equal(
		{"environment": 8, "table": 8, "samplers": samplers}
	)
	probe.free()
	assert_dict(material.get_fetches()).is_equal({"environment": 8, "table": 8, "samplers": 2})


# All that looks up light: lobes by eights and others, diffuse light, coats.
func _materials() -> Array[LobeMaterial3D]:
	var plastic := LobeMaterial3D.new()
	plastic.resource_name = "plastic"
	plastic.metallic = 0.2
	plastic.roughness = 0.5
	plastic.clearcoat = 0.8
	plastic.clearcoat_enabled = true
	plastic.clearcoat_roughness = 0.2
	return [
		_metal(1, Vector2(0.2, 0.2)),
		_metal(8, Vector2(0.1, 0.3)),
		_metal(11, Vector2(0.3, 0.3)),
		plastic,
	]


func _metal(lobes: int, alpha: Vector2, sharpness := 5.0) -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.resource_name = "%d lobes" % lobes
	var views := Vector2i(2, 1 if alpha.x == alpha.y else 2)
	if lobes > 1:
		material.table = Kit.make_odd_table(lobes, views, alpha, sharpness)
		return material
	var table := LobeTable.new()
	table.alpha = alpha
	table.lobe_count = 1
	table.views = views
	table.image = Image.create_empty(views.x, views.y, false, Image.FORMAT_RGBAH)
	table.image.fill(Color(0.0, 0.0, sharpness, 1.0))
	material.table = table
	return material


func _light(panorama: Texture2D) -> void:
	_environment = LobeEnvironment3D.new()
	_view.add_child(_environment)
	_environment.panorama = panorama
	await _environment.rebuild()


func _add_probe(light: LobeLight, at: Vector3, size: Vector3) -> LobeProbe3D:
	var probe := LobeProbe3D.new()
	probe.position = at
	probe.size = size
	probe.light = light
	_view.add_child(probe)
	return probe


# A light with levels of 2 x 2 means.
func _make_light(side: int, radiance: Callable) -> LobeLight:
	var light := LobeLight.new()
	var faces: Array[Image] = []
	for face in 6:
		var image := Image.create_empty(side, side, false, Image.FORMAT_RGBAF)
		for y in side:
			for x in side:
				var direction := Kit.texel_direction(face, x, y, side)
				var colour: Color = radiance.call(direction)
				image.set_pixel(x, y, colour)
		image.convert(Image.FORMAT_RGBAH)
		image.generate_mipmaps()
		faces.append(image)
	light.faces = faces
	light.size = side
	return light


func _colourful(d: Vector3) -> Color:
	return Color(0.6 + 0.4 * d.x, 0.5 + 0.5 * sin(5.0 * d.y), 0.4 + 0.3 * d.z * d.x)


func _constant(value: float) -> Callable:
	return _filled(Color(value, value, value))


func _filled(colour: Color) -> Callable:
	return func(_d: Vector3) -> Color: return colour


# Where a ray from `place` along `d` meets a wall of the box: -1 to 1 of it as 0 to 1.
func _wall(place: Vector3, d: Vector3, half: Vector3) -> Color:
	var distance := INF
	for axis in 3:
		if d[axis] != 0.0:
			distance = minf(distance, (half[axis] * signf(d[axis]) - place[axis]) / d[axis])
	var point := (place + distance * d) / half * 0.5 + 0.5 * Vector3.ONE
	return Color(point.x, point.y, point.z)


# The red channel along the middle line.
func _weights(image: Image) -> Dictionary[int, float]:
	var found: Dictionary[int, float] = {}
	for x in range(4, SIDE - 4, 3):
		found[x] = image.get_pixel(x, 24).r
	return found


func _assert_same(image: Image, expected: Image, what: String) -> void:
	var most := 0.0
	for y in SIDE:
		for x in SIDE:
			var difference := image.get_pixel(x, y) - expected.get_pixel(x, y)
			most = maxf(
				most, maxf(absf(difference.r), maxf(absf(difference.g), absf(difference.b)))
			)
	assert_float(most).override_failure_message("%s: %s off" % [what, most]).is_less(SAME)
	assert_float(expected.get_pixel(24, 24).r).is_greater(0.05)


func _assert_near(got: float, expected: float, off: float, what: String) -> void:
	(
		assert_float(got)
		. override_failure_message("%s: %s, not %s" % [what, got, expected])
		. is_equal_approx(expected, off)
	)
