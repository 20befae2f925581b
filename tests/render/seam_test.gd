extends GdUnitTestSuite
## Edges and corners of the cube map, at every level and from everywhere: what is constant stays
## constant, and a radiance that is linear in the direction stays linear, with less slope.

const Kit := preload("support/render_kit.gd")
const Pyramid := preload("res://addons/lobelight/runtime/pyramid/pyramid.gd")
const SkyKit := preload("support/sky_kit.gd")
const SIDE := 64
const SIZE := 32
const GRADIENT := Vector3(0.25, -0.2, 0.15)
# Towards corners, so that pictures have edges and corners all over; together they show all of them.
const VIEWS: PackedVector3Array = [
	Vector3(1, 1, 1), Vector3(-1, -1, 1), Vector3(1, -1, -1), Vector3(-1, 1, -1)
]
# Widths of lobes that are looked up in ever coarser levels, and by how many 255ths a gradient that
# spans 180 of them may be off. What is more than one comes of the sampler: between the texels of
# coarse levels, and of different faces most, straight lines cut corners of the sphere.
const WIDTHS: Dictionary[float, float] = {
	0.001: 1.0, 0.03: 1.0, 0.06: 1.0, 0.1: 1.0, 0.2: 1.7, 0.35: 3.2, 0.6: 4.8
}
# The same of light of the second degree.
const BENT_WIDTHS: Dictionary[float, float] = {0.1: 1.5, 0.2: 3.8, 0.35: 8.5, 0.5: 11.0, 0.6: 10.5}
const ROUND := [[LobeEnvironment3D.Filter.GAUSSIAN], [LobeEnvironment3D.Filter.DISC]]
const FILTERS := [
	[LobeEnvironment3D.Filter.BOX],
	[LobeEnvironment3D.Filter.BINOMIAL],
	[LobeEnvironment3D.Filter.GAUSSIAN],
	[LobeEnvironment3D.Filter.DISC],
]

var _view: LinearViewport
var _material := LobeMaterial3D.new()
var _environment: LobeEnvironment3D
# By view, the directions that the sphere reflects into the pixels.
var _directions: Array[PackedVector3Array] = []


static func _linear(direction: Vector3) -> Color:
	var value := 0.5 + GRADIENT.dot(direction)
	return Color(value, value, value)


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_material.metallic = 1.0
	_view.add_child(Kit.make_sphere(_material, 96))
	_environment = LobeEnvironment3D.new()
	_environment.size = SIZE
	_environment.update_mode = LobeEnvironment3D.UpdateMode.ONCE
	_view.add_child(_environment)
	if _directions.is_empty():
		for from in VIEWS:
			_view.camera.look_at_from_position(4.0 * from.normalized(), Vector3.ZERO)
			_directions.append(SkyKit.all_reflected(_view.camera, SIDE))


func after_test() -> void:
	_view.free()


func after() -> void:
	_material = null


func test_a_constant_stays_constant(
	filter: LobeEnvironment3D.Filter, _test_parameters := FILTERS
) -> void:
	# Through the views of a sky, which in linear light is 0.5 exactly in all renderers.
	_view.camera.environment.background_color = Color(0.5, 0.5, 0.5).linear_to_srgb()
	_environment.filter = filter
	await _environment.rebuild()
	var half := func(_view_direction: Vector3, _reflected: Vector3) -> float: return 0.5
	for width in WIDTHS:
		_material.table = LobeTable.make_single_lobe(width)
		for view in VIEWS.size():
			var worst: float = await _worst(view, half)
			assert_float(255.0 * worst).append_failure_message("width %s" % width).is_less(1.0)


func test_texels_of_a_gradient(filter: LobeEnvironment3D.Filter, _test_parameters := ROUND) -> void:
	_environment.panorama = Kit.make_panorama(64, _linear)
	_environment.filter = filter
	await _environment.rebuild()
	var faces: Array[Image] = _environment._live.chain.cube.get_faces()
	for level in 5:
		var images := Kit.level_of(faces, level)
		var size := images[0].get_width()
		# The least-squares slope, then what is off it.
		var slope := 0.0
		var weights := 0.0
		var worst := 0.0
		for step in 2:
			for i in 6 * size * size:
				@warning_ignore("integer_division")
				var texel := Vector3i(i / (size * size), i % size, i / size % size)
				var direction := _stored_direction(texel.x, texel.y, texel.z, size)
				var got := images[texel.x].get_pixel(texel.y, texel.z).r - 0.5
				var linear := GRADIENT.dot(direction)
				if step == 0:
					slope += got * linear
					weights += linear * linear
				else:
					worst = maxf(worst, absf(got - slope / weights * linear))
		assert_float(255.0 * worst).append_failure_message("level %d" % level).is_less(1.0)
		# What is flat would be exact, too. Gaussians of the level's variance, without the sampler's
		# tent, leave this slope, discs, where they are as wide as a face, somewhat less.
		var c := Pyramid.LEVEL_VARIANCES[filter]
		var tent := (1.0 - _mean_m_cubed(size)) / 6.0 * pow(4.0, level)
		var variance := 4.0 / (SIZE * SIZE) * (c * (pow(4.0, level) - 1.0) + tent)
		var left := Kit.mean_cosine(1.0 / variance) if level > 0 else 1.0
		var share := slope / weights / left
		assert_float(share).append_failure_message("level %d" % level).is_between(0.75, 1.1)


func test_lobes_of_a_gradient(filter: LobeEnvironment3D.Filter, _test_parameters := ROUND) -> void:
	_environment.panorama = Kit.make_panorama(64, _linear)
	_environment.filter = filter
	await _environment.rebuild()
	for width in WIDTHS:
		_material.table = LobeTable.make_single_lobe(width)
		var exact := func(o: Vector3, i: Vector3) -> float:
			# The lobe's kappa is that of the half-vector over o.h.
			var variance := 2.0 * width * width * (o + i).normalized().dot(o)
			return 0.5 + Kit.mean_cosine(1.0 / variance) * GRADIENT.dot(i)
		for view in VIEWS.size():
			var worst: float = await _worst(view, exact)
			assert_float(255.0 * worst).append_failure_message("width %s" % width).is_less(
				WIDTHS[width]
			)


func test_wide_lobes_of_what_bends(
	filter: LobeEnvironment3D.Filter, _test_parameters := ROUND
) -> void:
	# Harmonics of the second degree, which spherical Gaussians leave 1 - 3 A / kappa of, A being what
	# they leave of those of the first degree.
	var bent := func(direction: Vector3) -> Color:
		var value := 0.5 + _bend(direction)
		return Color(value, value, value)
	_environment.panorama = Kit.make_panorama(64, bent)
	_environment.filter = filter
	await _environment.rebuild()
	for width: float in BENT_WIDTHS:
		_material.table = LobeTable.make_single_lobe(width)
		var exact := func(o: Vector3, i: Vector3) -> float:
			var variance := 2.0 * width * width * (o + i).normalized().dot(o)
			return 0.5 + (1.0 - 3.0 * variance * Kit.mean_cosine(1.0 / variance)) * _bend(i)
		for view in VIEWS.size():
			var worst: float = await _worst(view, exact)
			assert_float(255.0 * worst).append_failure_message("width %s" % width).is_less(
				BENT_WIDTHS[width]
			)


# A light of the second degree, between -0.4 and 0.4.
static func _bend(direction: Vector3) -> float:
	var d := direction.normalized()
	return 0.4 * (d.dot(Vector3(1, 1, 0.5)) * d.dot(Vector3(1, -1, 0.2)) + 0.8 * d.x * d.z) / 1.2


# Of m³, the share that a texel has of the solid angle of those in the middle of a face, over them.
func _mean_m_cubed(size: int) -> float:
	var sum := 0.0
	for i in size * size:
		@warning_ignore("integer_division")
		var direction := Kit.texel_direction(0, i % size, i / size, size).abs()
		sum += pow(direction[direction.max_axis_index()], 3.0)
	return sum / (size * size)


# What a texel of a blurred level holds the light of: at a face's edges not quite of where it lies,
# see pyramid_round.gdshader.
func _stored_direction(face: int, x: int, y: int, size: int) -> Vector3:
	var axes := Basis(
		Kit.texel_direction(face, 1, 0, 2) - Kit.texel_direction(face, 0, 0, 2),
		Kit.texel_direction(face, 0, 1, 2) - Kit.texel_direction(face, 0, 0, 2),
		Kit.texel_direction(face, 0, 0, 1)
	)
	var position := Vector2(2 * x + 1, 2 * y + 1) / size - Vector2.ONE
	var shortened := 1.0 - 0.25 / size
	position *= Vector2(
		shortened if y == 0 or y == size - 1 else 1.0, shortened if x == 0 or x == size - 1 else 1.0
	)
	return (
		(axes.x.normalized() * position.x + axes.y.normalized() * position.y + axes.z).normalized()
	)


# The largest error in a view's picture. `exact` is called with the directions of the view and of
# the reflection. To be awaited.
func _worst(view: int, exact: Callable) -> float:
	var from := VIEWS[view].normalized()
	_view.camera.look_at_from_position(4.0 * from, Vector3.ZERO)
	var image: Image = await _view.capture()
	var worst := 0.0
	for i in _directions[view].size():
		var direction := _directions[view][i]
		if direction != Vector3.ZERO:
			@warning_ignore("integer_division")
			var got := image.get_pixel(i % SIDE, i / SIDE).r
			worst = maxf(worst, absf(got - (exact.call(from, direction) as float)))
	return worst
