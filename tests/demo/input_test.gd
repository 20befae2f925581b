extends GdUnitTestSuite
## The demo under mouse, fingers and keys, and the layout of its controls, by events that are pushed
## into a viewport.

const DemoRoot := preload("res://demo/demo.gd")
const DemoScene := preload("res://demo/demo.tscn")
const Interface := preload("res://demo/interface/interface.gd")
const Look := preload("res://demo/interface/look.gd")
const Methods := preload("res://demo/methods.gd")
const SIZE := Vector2i(1280, 720)
# A place where neither an object nor a control is.
const VOID := Vector2(200, 60)
# Desktop, a tablet upright, a phone upright and lying, with their densities.
const SCREENS := [
	[Vector2i(1280, 720), 1.0],
	[Vector2i(800, 1280), 1.33],
	[Vector2i(1080, 2340), 2.6],
	[Vector2i(2340, 1080), 2.6],
]

var _view: SubViewport
var _demo: DemoRoot
var _interface: Interface


func before_test() -> void:
	_view = auto_free(SubViewport.new())
	_view.size = SIZE
	_view.own_world_3d = true
	_view.handle_input_locally = true
	add_child(_view)
	_demo = DemoScene.instantiate()
	_view.add_child(_demo)
	_interface = _demo.get_node("Interface")
	_interface.ui_scale = 1.0
	# Containers place what they hold in the next frame.
	await get_tree().process_frame
	await get_tree().process_frame


func _press(at: Vector2, pressed: bool, button := MOUSE_BUTTON_LEFT) -> void:
	var event := InputEventMouseButton.new()
	event.button_index = button
	event.pressed = pressed
	event.position = at
	event.global_position = at
	event.button_mask = MOUSE_BUTTON_MASK_LEFT if pressed else 0 as MouseButtonMask
	_view.push_input(event)


func _move(from: Vector2, to: Vector2, device := 0) -> void:
	var event := InputEventMouseMotion.new()
	event.device = device
	event.position = to
	event.global_position = to
	event.relative = to - from
	event.button_mask = MOUSE_BUTTON_MASK_LEFT
	_view.push_input(event)


func _drag(from: Vector2, to: Vector2) -> void:
	_press(from, true)
	_move(from, 0.5 * (from + to))
	_move(0.5 * (from + to), to)
	_press(to, false)


func _touch(finger: int, at: Vector2, pressed: bool) -> void:
	var event := InputEventScreenTouch.new()
	event.index = finger
	event.position = at
	event.pressed = pressed
	_view.push_input(event)


func _slide(finger: int, from: Vector2, to: Vector2) -> void:
	var event := InputEventScreenDrag.new()
	event.index = finger
	event.position = to
	event.relative = to - from
	_view.push_input(event)


func _key(code: Key) -> void:
	var event := InputEventKey.new()
	event.keycode = code
	event.pressed = true
	_view.push_input(event)


func test_the_mouse_turns_the_camera_about_its_target() -> void:
	var camera := _demo.camera
	var yaw := camera.yaw
	var pitch := camera.pitch
	_drag(VOID, VOID + Vector2(100, 40))
	assert_float(camera.yaw).is_less(yaw - 0.3)
	assert_float(camera.pitch).is_greater(pitch + 0.1)
	_drag(VOID, VOID + Vector2(0, 4000))
	assert_float(camera.pitch).is_less(1.4)
	var away := camera.global_position.distance_to(camera.target)
	assert_float(away).is_greater(camera.distance - 0.01)


func test_the_wheel_comes_closer_and_goes_away() -> void:
	var before := _demo.camera.distance
	_press(VOID, true, MOUSE_BUTTON_WHEEL_UP)
	assert_float(_demo.camera.distance).is_less(before)
	_press(VOID, true, MOUSE_BUTTON_WHEEL_DOWN)
	assert_float(_demo.camera.distance).is_equal_approx(before, 1e-4)


func test_a_finger_turns_like_the_mouse_and_only_once() -> void:
	var to := VOID + Vector2(60, 10)
	_drag(VOID, to)
	var by_mouse := _demo.camera.yaw
	_demo.camera.yaw = 0.0
	_touch(0, VOID, true)
	_slide(0, VOID, to)
	# What the engine makes of the finger for those who know the mouse only.
	_move(VOID, to, InputEvent.DEVICE_ID_EMULATION)
	_touch(0, to, false)
	assert_float(by_mouse).is_not_equal(0.0)
	assert_float(_demo.camera.yaw).is_equal_approx(by_mouse, 1e-5)


func test_two_fingers_pinch() -> void:
	var camera := _demo.camera
	var before := camera.distance
	var other := VOID + Vector2(100, 0)
	_touch(0, VOID, true)
	_touch(1, other, true)
	_slide(1, other, other + Vector2(60, 0))
	assert_float(camera.distance).is_equal_approx(before * 100.0 / 160.0, 1e-3)
	assert_float(camera.yaw).is_equal(0.0)
	_slide(1, other + Vector2(60, 0), other)
	assert_float(camera.distance).is_equal_approx(before, 1e-3)
	# The finger that stays goes on by turning, and what it ends is no tap.
	_demo.chosen = 2
	_touch(1, other, false)
	_slide(0, VOID, VOID + Vector2(20, 0))
	assert_float(camera.yaw).is_less(0.0)
	_touch(0, VOID, false)
	assert_int(_demo.chosen).is_equal(2)


func test_what_starts_on_the_controls_does_not_turn_the_camera() -> void:
	var inside := _interface.controls.get_global_rect().get_center()
	_touch(0, inside, true)
	_slide(0, inside, inside - Vector2(400, 0))
	_touch(0, inside - Vector2(400, 0), false)
	_drag(inside, inside - Vector2(400, 0))
	assert_float(_demo.camera.yaw).is_equal(0.0)


func test_a_tap_chooses_an_object() -> void:
	for index in _demo.objects.size():
		# Where its corners are seen; many are on its back, or behind other objects.
		var object := _demo.objects[index]
		var corners: PackedVector3Array = object.mesh.surface_get_arrays(0)[Mesh.ARRAY_VERTEX]
		var chosen := 0
		for sample in 40:
			@warning_ignore("integer_division")
			var corner := object.global_transform * corners[sample * corners.size() / 40]
			var at := _demo.camera.unproject_position(corner)
			if _interface.controls.get_global_rect().has_point(at):
				continue
			_press(at, true)
			_press(at, false)
			chosen += int(_demo.chosen == index)
		assert_int(chosen).is_greater(6)
	_press(VOID, true)
	_press(VOID, false)
	assert_int(_demo.chosen).is_equal(DemoRoot.EVERY_OBJECT)


func test_the_divider_goes_where_it_is_dragged() -> void:
	_demo.right_method = Methods.Method.STOCK
	_drag(Vector2(0.5 * SIZE.x, 0.5 * SIZE.y), Vector2(400, 300))
	assert_int(_demo.compare_view.get_divider_pixel()).is_equal(400)
	assert_float(_demo.camera.yaw).is_equal(0.0)
	# Not below the panel, where the handle could not be taken again.
	_drag(Vector2(400, 300), Vector2(2 * SIZE.x, 300))
	var at := _demo.compare_view.get_divider_pixel()
	assert_float(absf(at - _interface.controls.get_global_rect().position.x)).is_less(1.0)
	_drag(Vector2(at - 5, 300), Vector2(-50, 300))
	assert_float(_demo.divider).is_equal(0.0)


func test_a_finger_scrolls_the_sheet_from_wherever_it_starts() -> void:
	# As on a device with a touchscreen, whose first finger is the mouse, too.
	var input := Input as Object
	input.set("emulate_touch_from_mouse", true)
	_view.size = Vector2i(720, 1280)
	_interface.ui_scale = 1.75
	await get_tree().process_frame
	await get_tree().process_frame
	var scroll: ScrollContainer = (
		_interface.controls.find_children("*", "ScrollContainer", true, false)[0]
	)
	var button := _interface.controls.lobes
	var from := button.get_global_transform_with_canvas() * (0.5 * button.size)
	_drag(from, from - Vector2(0, 200))
	input.set("emulate_touch_from_mouse", false)
	assert_int(scroll.scroll_vertical).is_greater(50)
	assert_bool(button.get_popup().visible).is_false()


func test_sliders_are_dragged() -> void:
	var slider := _interface.controls.roughness
	var place := slider.get_global_rect()
	var knob := place.position + Vector2(0.5, 0.5) * place.size
	_drag(knob, place.position + Vector2(0.9, 0.5) * place.size)
	for object in _demo.objects:
		assert_float(object.material.roughness).is_equal_approx(slider.value, 1e-5)
	assert_float(slider.value).is_between(0.65, 0.8)


func test_keys() -> void:
	_key(KEY_E)
	assert_int(_demo.environment_index).is_equal(1)
	for step in _demo.settings.size() - 1:
		_key(KEY_E)
	assert_int(_demo.environment_index).is_equal(0)
	_key(KEY_B)
	assert_int(_demo.right_method).is_not_equal(Methods.NONE)
	_key(KEY_RIGHT)
	assert_float(_demo.divider).is_equal_approx(0.52, 1e-4)
	_key(KEY_M)
	assert_int(_demo.left_method).is_not_equal(Methods.Method.OURS)
	_key(KEY_H)
	assert_bool(_interface.controls.visible).is_false()
	_key(KEY_R)
	var before := _demo.turn
	await await_millis(50)
	assert_float(_demo.turn).is_greater(before)


func test_the_key_for_lobes_goes_through_the_sets_that_there_are() -> void:
	var controls := _interface.controls
	for step in controls.lobes.item_count:
		_key(KEY_L)
		assert_array(_demo.missing_tables).is_empty()
		assert_int(controls.lobes.get_selected_id()).is_equal(_demo.lobe_count)


func test_controls_fit_screens_and_fingers(
	size: Vector2i, density: float, _test_parameters := SCREENS
) -> void:
	_view.size = size
	_interface.ui_scale = density
	_demo.right_method = Methods.Method.SAMPLES
	await get_tree().process_frame
	await get_tree().process_frame
	var screen := Rect2(Vector2.ZERO, Vector2(size) / density)
	var titles := [_interface.left_title, _interface.right_title]
	for part: Control in [_interface.controls, _interface.fold] + titles:
		assert_bool(screen.encloses(part.get_rect())).is_true()
	for title: Control in titles:
		assert_bool(title.get_rect().intersects(_interface.controls.get_rect())).is_false()
		assert_bool(title.get_rect().intersects(_interface.fold.get_rect())).is_false()
	assert_bool(titles[0].get_rect().intersects(titles[1].get_rect())).is_false()
	var touched: Array[Control] = [_interface.fold, _interface.divider]
	for type: String in ["BaseButton", "HSlider"]:
		for node in _interface.controls.find_children("*", type, true, false):
			touched.append(node as Control)
	assert_int(touched.size()).is_greater(10)
	for control in touched:
		assert_float(control.size.y).is_greater_equal(Look.TOUCH)
		assert_float(control.size.x).is_greater_equal(Look.TOUCH)
	# What is lit is seen beside or above the panel.
	var free := _demo.camera.free_area
	var panel := _interface.controls.get_rect()
	assert_bool(free.intersects(Rect2(panel.position * density, panel.size * density))).is_false()
	assert_float(free.get_area()).is_greater(0.4 * size.x * size.y)
