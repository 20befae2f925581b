extends GdUnitTestSuite
## Two eyes: each sees what a camera with one picture sees from there, mirrors show what they do by
## their geometry, and both eyes get the same light.
##
## Run by ./dev test stereo, in a project whose shaders are compiled for two eyes.

const Kit := preload("res://tests/render/support/render_kit.gd")
const SkyKit := preload("res://tests/render/support/sky_kit.gd")
const TwoEyes := preload("res://bake/two_eyes.gd")
const TAA := "rendering/anti_aliasing/quality/use_taa"
const SIDE := 64
# Of a picture of 8 bits, as the screen shows it.
const SAME := 1.0 / 255.0
# Rasterisation may put an edge's pixels on its other side.
const MOST_APART := 0.003
const RADIUS := 0.055
const PLACES: PackedVector3Array = [
	Vector3(-0.12, 0.07, 0.0),
	Vector3(0.0, 0.07, 0.05),
	Vector3(0.12, 0.07, 0.0),
	Vector3(-0.07, -0.06, 0.05),
	Vector3(0.07, -0.06, 0.0),
]

var _used_taa := false
var _eyes: TwoEyes
var _environment: LobeEnvironment3D


func before_test() -> void:
	_used_taa = ProjectSettings.get_setting(TAA, false)
	assert_bool(TwoEyes.are_possible()).is_true()
	_eyes = TwoEyes.new(SIDE)
	# Not along the axes, so that no wrong turn stays unseen.
	_eyes.origin.transform = Transform3D(
		Basis.from_euler(Vector3(-0.3, 0.4, 0.2)), Vector3(0.14, 0.11, 0.34)
	)
	add_child(_eyes)
	_environment = LobeEnvironment3D.new()
	_environment.rotation = Vector3(0.2, 0.7, 0.1)
	_eyes.add_child(_environment)


func after_test() -> void:
	ProjectSettings.set_setting(TAA, _used_taa)
	if _eyes != null:
		_eyes.free()
		_eyes = null
		await get_tree().process_frame


func test_each_eye_sees_what_a_camera_sees_from_there() -> void:
	for i in PLACES.size():
		_add_sphere(_make_materials()[i], PLACES[i])
	await _light(Kit.make_panorama(64, SkyKit.radiance))
	await _assert_eyes_are_right("the environment's light")

	# Of a surface that is as bright from everywhere, both eyes see the same.
	await _light(Kit.constant(0.5))
	var pictures := await _eyes.capture()
	var left := _mean(pictures[TwoEyes.LEFT])
	var right := _mean(pictures[TwoEyes.RIGHT])
	assert_float(left).is_greater(0.3)
	assert_float(absf(left - right)).is_less(0.002)


func test_lights_of_places() -> void:
	var materials := _make_materials()
	for i: int in [0, 1]:
		_add_sphere(materials[i], PLACES[i])
	await _light(Kit.make_panorama(32, SkyKit.radiance))
	# Its border goes through both spheres, and its walls are near.
	var probe := LobeProbe3D.new()
	probe.light = _make_room()
	probe.size = 0.5 * Vector3.ONE
	probe.blend_distance = 0.1
	probe.position = Vector3(-0.02, 0.3, 0.05)
	_eyes.add_child(probe)
	await _assert_eyes_are_right("a probe's light")


func test_mirrors_show_each_eye_what_lies_behind_it() -> void:
	var mirror := LobeMaterial3D.new()
	mirror.metallic = 1.0
	mirror.table = LobeTable.make_single_lobe(0.01)
	_add_sphere(mirror, Vector3.ZERO)
	_environment.rotation = Vector3.ZERO
	await _light(Kit.make_panorama(64, SkyKit.radiance))
	var pictures := await _eyes.capture()
	for eye: int in [TwoEyes.LEFT, TwoEyes.RIGHT]:
		var off := _mirror_error(pictures[eye], eye, eye)
		assert_float(off).append_failure_message("eye %d" % eye).is_less(2.0 * SAME)
		# The other eye is where it would be seen to be wrong.
		assert_float(_mirror_error(pictures[eye], eye, 1 - eye)).is_greater(5.0 * SAME)


func test_light_is_captured_without_eyes() -> void:
	var metal := LobeMaterial3D.new()
	metal.metallic = 1.0
	metal.table = LobeTable.make_single_lobe(0.01)
	_add_sphere(metal, Vector3.ZERO)
	_environment.rotation = Vector3.ZERO
	_eyes.camera.environment = Environment.new()
	SkyKit.set_sky(_eyes.camera.environment, "shader")
	await _light(null)
	var while_on := await _eyes.capture_single(TwoEyes.LEFT)
	_eyes.use_xr = false
	await _light(null)
	var while_off := await _eyes.capture_single(TwoEyes.LEFT)
	assert_float(_mean(while_off)).is_greater(0.2)
	assert_float(_share_apart(while_on, while_off)).is_equal(0.0)


func test_no_lobes_of_a_line_are_shifted() -> void:
	ProjectSettings.set_setting(TAA, true)
	var brushed := LobeMaterial3D.new()
	brushed.metallic = 1.0
	brushed.roughness = 0.2
	brushed.anisotropy_enabled = true
	brushed.anisotropy = 1.05
	brushed.quality = LobeBaseMaterial3D.Quality.LOBES_16
	var is_shifted := "LINE_SHIFTED" in brushed.get_shader_code()
	_add_sphere(brushed, Vector3.ZERO)
	# Forward+ only has such antialiasing.
	assert_bool(is_shifted).is_equal(
		RenderingServer.get_current_rendering_method() == "forward_plus"
	)
	if not is_shifted:
		return
	# Eyes before the middles of their lenses, and so near to one another that their distance could
	# be taken for what the antialiasing moves the picture by.
	_eyes.interface.iod = 0.02
	_eyes.interface.display_width = 0.04
	_eyes.interface.display_to_lens = 0.04
	await _light(Kit.make_panorama(64, _lamps))
	var pictures := await _eyes.capture()
	var alone := await _eyes.capture_single(TwoEyes.LEFT)
	assert_float(_mean(alone)).is_greater(0.02)
	assert_float(_share_apart(pictures[TwoEyes.LEFT], alone)).is_less(MOST_APART)


# Small ones, in which lobes that are shifted show.
static func _lamps(direction: Vector3) -> Color:
	var wave := sin(9.0 * direction.x) * sin(9.0 * direction.y) * sin(9.0 * direction.z + 1.0)
	return 4.0 * Color.WHITE if wave > 0.7 else Color.BLACK


func _assert_eyes_are_right(what: String) -> void:
	var pictures := await _eyes.capture()
	for eye: int in [TwoEyes.LEFT, TwoEyes.RIGHT]:
		var alone := await _eyes.capture_single(eye)
		assert_float(_mean(alone)).append_failure_message(what).is_greater(0.2)
		var apart := _share_apart(pictures[eye], alone)
		assert_float(apart).append_failure_message("%s, eye %d" % [what, eye]).is_less(MOST_APART)
		# The eyes' pictures are not the same one.
		assert_float(_share_apart(pictures[1 - eye], alone)).is_greater(0.05)


func _light(panorama: Texture2D) -> void:
	_environment.panorama = panorama
	assert_bool(await _environment.rebuild()).is_true()
	for frame in 3:
		await get_tree().process_frame


func _add_sphere(material: Material, place: Vector3) -> void:
	var sphere := Kit.make_sphere(material, 48)
	sphere.scale = RADIUS * Vector3.ONE
	sphere.rotation = Vector3(0.5, 0.3, 0.9)
	sphere.position = place
	_eyes.add_child(sphere)


# What takes different ways through the shaders: vectors from the vertices, the axis of an
# anisotropy, frames of normal maps with a coat above, what is behind, and a face to the camera.
func _make_materials() -> Array[LobeMaterial3D]:
	var made: Array[LobeMaterial3D] = []
	for i in PLACES.size():
		var material := LobeMaterial3D.new()
		material.metallic = 1.0 if i < 2 else 0.0
		material.roughness = 0.3
		made.append(material)
	made[1].anisotropy_enabled = true
	made[1].anisotropy = 0.8
	made[1].anisotropy_rotation = 0.6
	made[2].clearcoat_enabled = true
	made[2].normal_enabled = true
	made[2].normal_texture = _make_waves()
	made[3].refraction_enabled = true
	made[3].refraction_scale = 0.05
	made[4].billboard_mode = BaseMaterial3D.BILLBOARD_ENABLED
	made[4].proximity_fade_enabled = true
	made[4].proximity_fade_distance = 0.01
	return made


func _make_waves() -> ImageTexture:
	var image := Image.create_empty(32, 32, false, Image.FORMAT_RGB8)
	for y in 32:
		for x in 32:
			var slope := Vector3(0.3 * sin(TAU * x / 16.0), 0.2 * sin(TAU * y / 8.0), 1.0)
			var encoded := 0.5 * (slope.normalized() + Vector3.ONE)
			image.set_pixel(x, y, Color(encoded.x, encoded.y, encoded.z))
	image.generate_mipmaps()
	return ImageTexture.create_from_image(image)


func _make_room() -> LobeLight:
	var light := LobeLight.new()
	var faces: Array[Image] = []
	for face in 6:
		var image := Image.create_empty(16, 16, false, Image.FORMAT_RGBAF)
		for y in 16:
			for x in 16:
				image.set_pixel(x, y, SkyKit.radiance(-Kit.texel_direction(face, x, y, 16)))
		image.convert(Image.FORMAT_RGBAH)
		image.generate_mipmaps()
		faces.append(image)
	light.faces = faces
	light.size = 16
	return light


# The mean difference, of the mirror at the world's origin, from what is seen from an eye's place
# through the pixels of `eye`'s picture.
func _mirror_error(picture: Image, eye: int, seen_from: int) -> float:
	var place := _eyes.get_eye(seen_from).origin
	var sum := 0.0
	var count := 0
	for y in SIDE:
		for x in SIDE:
			var point := _meet(_eyes.get_eye(eye), _ray(eye, x, y))
			if point == Vector3.ZERO:
				continue
			var normal := point.normalized()
			var seen := (point - place).normalized()
			# Where the mesh's facets are seen from the side, they are not the sphere.
			if seen.dot(normal) > -0.5:
				continue
			var got := _encode(picture.get_pixel(x, y))
			var difference := got - _encode(SkyKit.radiance(seen.bounce(normal)))
			sum += (absf(difference.r) + absf(difference.g) + absf(difference.b)) / 3.0
			count += 1
	assert_int(count).is_greater(40)
	return sum / count


# The direction that a pixel of an eye's picture shows, in the world.
func _ray(eye: int, x: int, y: int) -> Vector3:
	var seen := Vector4(2.0 * (x + 0.5) / SIDE - 1.0, 1.0 - 2.0 * (y + 0.5) / SIDE, 1.0, 1.0)
	var far: Vector4 = _eyes.get_projection(eye).inverse() * seen
	return (_eyes.get_eye(eye).basis * Vector3(far.x, far.y, far.z)).normalized()


# Where a ray from an eye meets the sphere at the world's origin; zero if it does not.
func _meet(eye: Transform3D, direction: Vector3) -> Vector3:
	var middle := -eye.origin.dot(direction)
	var square := RADIUS * RADIUS - (eye.origin + middle * direction).length_squared()
	if square <= 0.0:
		return Vector3.ZERO
	return eye.origin + (middle - sqrt(square)) * direction


# The share of pixels that differ by more than is seen.
func _share_apart(one: Image, other: Image) -> float:
	var apart := 0
	for y in SIDE:
		for x in SIDE:
			var difference := _encode(one.get_pixel(x, y)) - _encode(other.get_pixel(x, y))
			var most := maxf(absf(difference.r), maxf(absf(difference.g), absf(difference.b)))
			apart += 1 if most > SAME else 0
	return float(apart) / (SIDE * SIDE)


func _encode(colour: Color) -> Color:
	return colour.clamp().linear_to_srgb()


# Of what is covered.
func _mean(picture: Image) -> float:
	var sum := 0.0
	var count := 0
	for y in SIDE:
		for x in SIDE:
			var colour := picture.get_pixel(x, y)
			if colour.a == 1.0:
				sum += (colour.r + colour.g + colour.b) / 3.0
				count += 1
	return sum / maxi(count, 1)
