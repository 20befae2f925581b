extends GdUnitTestSuite
## The environment is where Godot's own sky would show it, and turns with its node.

const Kit := preload("support/render_kit.gd")
const SIDE := 32
const MIDDLE := 16
const MARKERS: Dictionary[Vector3, Color] = {
	Vector3.RIGHT: Color.RED,
	Vector3.LEFT: Color.GREEN,
	Vector3.UP: Color.BLUE,
	Vector3.DOWN: Color.YELLOW,
	Vector3.BACK: Color.MAGENTA,
	Vector3.FORWARD: Color.CYAN,
}

var _panorama: ImageTexture
var _sky: Sky
var _view: LinearViewport
var _environment: LobeEnvironment3D


# Six discs of pure colours, which every renderer shows alike.
static func _markers(direction: Vector3) -> Color:
	for axis in MARKERS:
		if axis.dot(direction) > 0.9:
			return MARKERS[axis]
	return Color.BLACK


func before() -> void:
	_panorama = Kit.make_panorama(64, _markers)
	var material := PanoramaSkyMaterial.new()
	material.panorama = _panorama
	_sky = Sky.new()
	_sky.sky_material = material
	_sky.radiance_size = Sky.RADIANCE_SIZE_32


func after() -> void:
	_panorama = null
	_sky = null


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_environment = LobeEnvironment3D.new()
	_environment.panorama = _panorama
	_view.add_child(_environment)
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = LobeTable.make_single_lobe(0.01)
	_view.add_child(Kit.make_sphere(material))


func after_test() -> void:
	_view.free()


func test_mirror_shows_what_is_behind_the_viewer() -> void:
	await _environment.rebuild()
	for axis in MARKERS:
		# Seen from `axis`, the sphere's middle mirrors what is behind the camera.
		var reflected: Color = await _look(4.0 * axis, -axis, false)
		_assert_colour(reflected, MARKERS[axis], "mirrored at %s" % axis)


func test_the_sky_shows_the_same() -> void:
	for axis in MARKERS:
		# From where nothing is in the way; beside the poles, which the engine's sky blurs.
		var towards := (axis + 0.1 * Vector3(axis.y, axis.z, axis.x)).normalized()
		var seen: Color = await _look(2.0 * axis, towards, true)
		_assert_colour(seen, MARKERS[axis], "sky at %s" % axis)


func test_sideways_reflections() -> void:
	await _environment.rebuild()
	_view.camera.position = Vector3(0.0, 0.0, 4.0)
	var image: Image = await _view.capture()
	for axis: Vector3 in [Vector3.RIGHT, Vector3.LEFT, Vector3.UP, Vector3.DOWN]:
		# The normal halfway between the viewer and the marker.
		var normal := (Vector3.BACK + axis).normalized()
		var pixel := (Vector2(normal.x + 1.0, 1.0 - normal.y) * 0.5 * SIDE).floor()
		_assert_colour(image.get_pixelv(Vector2i(pixel)), MARKERS[axis], "reflected %s" % axis)


func test_rotation_of_the_node() -> void:
	# Turned by 90° about y, what was at -z is at -x.
	_environment.rotation.y = 0.5 * PI
	await _environment.rebuild()
	var left: Color = await _look(Vector3(-4.0, 0.0, 0.0), Vector3.RIGHT, false)
	_assert_colour(left, MARKERS[Vector3.FORWARD], "turned about y")
	# A turn after the rebuild shows as well; scale does not.
	_environment.transform.basis = Basis(Vector3.RIGHT, 0.5 * PI).scaled(Vector3(3.0, 3.0, 3.0))
	# About x: what was at +y is at +z.
	var back: Color = await _look(Vector3(0.0, 0.0, 4.0), Vector3.FORWARD, false)
	_assert_colour(back, MARKERS[Vector3.UP], "turned about x")


# The middle of the picture from a point towards a direction; of the sky or without it.
func _look(from: Vector3, towards: Vector3, sky: bool) -> Color:
	var up := Vector3.UP if absf(towards.y) < 0.9 else Vector3.BACK
	_view.camera.look_at_from_position(from, from + towards, up)
	_view.transparent_bg = not sky
	var surroundings := _view.camera.environment
	if sky:
		surroundings.sky = _sky
		surroundings.background_mode = Environment.BG_SKY
		_view.camera.set_perspective(20.0, 0.1, 10.0)
	else:
		surroundings.background_mode = Environment.BG_COLOR
		_view.camera.set_orthogonal(2.0, 0.1, 10.0)
	var image: Image = await _view.capture()
	return image.get_pixel(MIDDLE, MIDDLE)


func _assert_colour(got: Color, expected: Color, what: String) -> void:
	var off := maxf(absf(got.r - expected.r), absf(got.g - expected.g))
	off = maxf(off, absf(got.b - expected.b))
	assert_float(off).append_failure_message("%s: %s, expected %s" % [what, got, expected]).is_less(
		0.02
	)
