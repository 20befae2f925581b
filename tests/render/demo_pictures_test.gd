extends GdUnitTestSuite
## The demo's pictures, small: what they show, and that halves are those of their methods.

const DemoRoot := preload("res://demo/demo.gd")
const DemoScene := preload("res://demo/demo.tscn")
const DemoTables := preload("res://demo/demo_tables.gd")
const Interface := preload("res://demo/interface/interface.gd")
const Methods := preload("res://demo/methods.gd")
const LANDSCAPE := Vector2i(192, 108)
const PORTRAIT := Vector2i(81, 144)
# Texels along the side of the map's faces.
const MAP_SIZE := 64
# The engine makes its own maps over several frames.
const STOCK_FRAMES := 4

var _view: SubViewport
var _demo: DemoRoot


func before_test() -> void:
	_view = auto_free(SubViewport.new())
	_view.size = LANDSCAPE
	_view.own_world_3d = true
	_view.use_hdr_2d = true
	_view.render_target_update_mode = SubViewport.UPDATE_DISABLED
	add_child(_view)
	_demo = DemoScene.instantiate()
	_view.add_child(_demo)
	(_demo.get_node("Interface") as Interface).hide()


# Makes the light first, a small one, unless nothing of it has changed.
func _draw(is_lit := false) -> Image:
	if not is_lit:
		(_demo.get_node("Light") as LobeEnvironment3D).size = MAP_SIZE
		assert_str(await _demo.prepare_light()).is_empty()
	await get_tree().process_frame
	for frame in STOCK_FRAMES if _demo.shows(Methods.Method.STOCK) else 1:
		_view.render_target_update_mode = SubViewport.UPDATE_ONCE
		await RenderingServer.frame_post_draw
	var picture := _view.get_texture().get_image()
	picture.convert(Image.FORMAT_RGBF)
	return picture


# The mean difference of two pictures' parts.
func _difference(a: Image, b: Image, part := Rect2i()) -> float:
	var area := part if part.has_area() else Rect2i(Vector2i.ZERO, a.get_size())
	var first := a.get_region(area).get_data().to_float32_array()
	var second := b.get_region(area).get_data().to_float32_array()
	var sum := 0.0
	for i in first.size():
		sum += absf(first[i] - second[i])
	return sum / first.size()


func _mean(picture: Image) -> float:
	var sum := 0.0
	for value in picture.get_data().to_float32_array():
		sum += value
	return sum / (3 * picture.get_width() * picture.get_height())


# The part of the picture that an object's box covers.
func _place_of(index: int) -> Rect2:
	var object := _demo.objects[index]
	var box := object.get_aabb()
	var place := Rect2(
		_demo.camera.unproject_position(object.global_transform * box.get_center()), Vector2.ZERO
	)
	for corner in 8:
		var at := _demo.camera.unproject_position(
			object.global_transform * box.get_endpoint(corner)
		)
		place = place.expand(at)
	return place


func test_every_method_draws_every_environment() -> void:
	var methods: Array = Methods.Method.values()
	if DemoTables.thesis_set() == null:
		methods.erase(Methods.Method.THESIS)
		print(
			(
				"  %s is not there, so the thesis' method is left out: ./dev test render makes it"
				% DemoTables.THESIS
			)
		)
	for environment in _demo.settings.size():
		_demo.environment_index = environment
		_view.size = PORTRAIT if environment == 1 else LANDSCAPE
		var pictures: Dictionary[int, Image] = {}
		for method: int in methods:
			if _demo.is_inside() and not Methods.has_rooms(method):
				continue
			_demo.left_method = method
			var picture := await _draw()
			assert_float(_mean(picture)).is_between(0.02, 1.0)
			for other: int in pictures:
				# Not the same, and yet of the same things.
				assert_float(_difference(picture, pictures[other])).is_between(2e-4, 0.2)
			pictures[method] = picture
		if _demo.is_live():
			_check_rivals_on_our_map(pictures)


# The captured map's levels blur more than those that the rivals' rules are for.
func _check_rivals_on_our_map(pictures: Dictionary[int, Image]) -> void:
	var ours := pictures[Methods.Method.OURS]
	for index: int in [0, 1]:
		var place := Rect2i(_place_of(index).grow(-2.0))
		for method: int in [Methods.Method.THESIS, Methods.Method.SAMPLES]:
			if pictures.has(method):
				assert_float(_difference(ours, pictures[method], place)).is_less(0.03)


func test_the_engines_own_material_gets_as_much_light() -> void:
	# The sunset's lamps are small; those of the others are beyond what the engine's maps hold.
	_demo.environment_index = 1
	var means: Array[float] = []
	for method: int in [Methods.Method.OURS, Methods.Method.STOCK]:
		_demo.left_method = method
		var picture := await _draw()
		var sum := 0.0
		for index in _demo.objects.size():
			sum += _mean(picture.get_region(Rect2i(_place_of(index).grow(-2.0))))
		means.append(sum)
	assert_float(means[1] / means[0]).is_between(0.65, 1.25)


func test_objects_are_where_they_should_be() -> void:
	for size: Vector2i in [LANDSCAPE, PORTRAIT]:
		_view.size = size
		var whole := await _draw()
		var screen := Rect2(Vector2.ZERO, size)
		for index in _demo.objects.size():
			var place := _place_of(index)
			assert_bool(screen.encloses(place)).is_true()
			_demo.objects[index].hide()
			var without := await _draw(true)
			_demo.objects[index].show()
			var inside := Rect2i(place.grow(1.0)).intersection(Rect2i(Vector2i.ZERO, size))
			assert_float(_difference(whole, without, inside)).is_greater(0.01)
			without.blit_rect(whole, inside, inside.position)
			assert_float(_difference(whole, without)).is_less(1e-6)


func test_the_divider_splits_the_picture_exactly() -> void:
	_demo.left_method = Methods.Method.OURS
	var left := await _draw()
	_demo.left_method = Methods.Method.SAMPLES
	var right := await _draw()
	_demo.left_method = Methods.Method.OURS
	_demo.right_method = Methods.Method.SAMPLES
	for at: int in [1, 101, LANDSCAPE.x - 1]:
		_demo.divider = float(at) / LANDSCAPE.x
		assert_int(_demo.compare_view.get_divider_pixel()).is_equal(at)
		var expected := left.duplicate() as Image
		var rest := Rect2i(at, 0, LANDSCAPE.x - at, LANDSCAPE.y)
		expected.blit_rect(right, rest, rest.position)
		assert_float(_difference(await _draw(true), expected)).is_equal(0.0)
	_demo.divider = 0.0
	assert_float(_difference(await _draw(true), right)).is_equal(0.0)
	_demo.divider = 1.0
	assert_float(_difference(await _draw(true), left)).is_equal(0.0)


func test_the_lamp_of_the_studio_moves_in_reflections() -> void:
	_demo.environment_index = 2
	# The ball of car paint.
	var place := Rect2i(_place_of(4).grow(-3.0))
	var before := await _draw()
	_demo.turn = 0.7
	var after := await _draw()
	assert_float(_difference(before, after, place)).is_greater(1e-3)


func test_the_ball_shows_the_room_that_it_is_in() -> void:
	const BALL := 0
	_demo.environment_index = 3
	# In the warm room, in the cool one.
	var warmth: Array[float] = []
	var lit := 0.0
	for turn: float in [-0.8, 0.4]:
		_demo.turn = turn
		var ball := (await _draw()).get_region(Rect2i(_place_of(BALL).grow(-2.0)))
		lit = lit if lit > 0.0 else _mean(ball)
		var mean := Vector3.ZERO
		for y in ball.get_height():
			for x in ball.get_width():
				var texel := ball.get_pixel(x, y)
				mean += Vector3(texel.r, texel.g, texel.b)
		warmth.append(mean.x / mean.z)
	assert_float(warmth[0]).is_greater(1.5 * warmth[1])
	# Without its lamp the warm room is dark, in the ball too.
	_demo.turn = -0.8
	_demo.switch_lamp(false)
	var dark := (await _draw()).get_region(Rect2i(_place_of(BALL).grow(-2.0)))
	assert_float(_mean(dark)).is_less(0.6 * lit)


func test_sliders_change_what_they_are_for() -> void:
	var before := await _draw()
	for widths: Vector3 in [
		Vector3(0.7, 0.0, 0.0), Vector3(0.4, 0.97, 0.0), Vector3(0.4, 0.97, 1.5)
	]:
		_demo.set_widths(widths)
		var after := await _draw(true)
		assert_float(_difference(before, after)).is_greater(1e-3)
		before = after


func test_controls_are_drawn_in_both_layouts() -> void:
	var interface: Interface = _demo.get_node("Interface")
	for size: Vector2i in [LANDSCAPE, PORTRAIT]:
		_view.size = size
		interface.ui_scale = 0.3
		# The camera makes room for the panel, so the scene is not to be seen for this.
		for node: Node3D in [
			_demo.get_node("Backdrop"),
			_demo.get_node("Objects"),
			_demo.get_node("Plinth"),
			_demo.get_node("Shadows")
		]:
			node.hide()
		interface.hide()
		var without := await _draw()
		interface.show()
		await get_tree().process_frame
		var with_controls := await _draw()
		var panel := interface.controls.get_rect()
		var place := Rect2i(Rect2(panel.position * 0.3, panel.size * 0.3).grow(-2.0))
		assert_float(_difference(without, with_controls, place)).is_greater(0.003)
