extends GdUnitTestSuite
## The demo's interior: what it shows when, where its ball goes, and what its rooms are lit by.

const Controls := preload("res://demo/interface/controls.gd")
const DemoRoot := preload("res://demo/demo.gd")
const DemoScene := preload("res://demo/demo.tscn")
const Interior := preload("res://demo/interior/interior.gd")
const Methods := preload("res://demo/methods.gd")
const Plan := preload("res://demo/interior/plan.gd")
const StillLight := preload("res://demo/interior/still_light.gd")

var _demo: DemoRoot
var _interior: Interior


func before_test() -> void:
	_demo = auto_free(DemoScene.instantiate())
	add_child(_demo)
	_interior = _demo.get_node("Interior")


func _enter() -> void:
	for index in _demo.settings.size():
		if _demo.settings[index].is_interior:
			_demo.environment_index = index


func test_it_is_built_when_it_is_first_shown() -> void:
	assert_int(_interior.get_child_count()).is_equal(0)
	_enter()
	var parts := _interior.get_child_count()
	assert_int(parts).is_greater(10)
	_demo.environment_index = 0
	_enter()
	assert_int(_interior.get_child_count()).is_equal(parts)


func test_it_stands_in_the_halls_place() -> void:
	var hall := _demo.objects
	var view := _demo.camera.get_view()
	_enter()
	assert_bool(_interior.is_visible_in_tree()).is_true()
	for object in hall:
		assert_bool(object.is_visible_in_tree()).is_false()
	assert_array(_demo.objects).is_equal(_interior.objects)
	assert_int(_demo.objects.size()).is_equal(5)
	var controls: Controls = _demo.get_node("Interface").controls
	assert_int(controls.objects.item_count).is_equal(6)
	_demo.environment_index = 0
	assert_bool(_interior.is_visible_in_tree()).is_false()
	assert_array(_demo.objects).is_equal(hall)
	assert_vector(_demo.camera.target).is_equal(view.target)
	assert_float(_demo.camera.distance).is_equal(view.distance)
	assert_int(controls.objects.item_count).is_equal(7)


func test_objects_have_names_materials_and_tangents() -> void:
	_enter()
	var titles: Array[String] = []
	for object in _demo.objects:
		assert_bool(object.material_override is LobeMaterial3D).is_true()
		assert_bool(object.mesh.surface_get_arrays(0)[Mesh.ARRAY_TANGENT] != null).is_true()
		assert_bool(object.title in titles).is_false()
		titles.append(object.title)


func test_methods_without_rooms_are_not_offered() -> void:
	_demo.left_method = Methods.Method.SAMPLES
	_demo.right_method = Methods.Method.SAMPLES
	_enter()
	assert_int(_demo.left_method).is_equal(Methods.Method.OURS)
	assert_int(_demo.right_method).is_equal(Methods.NONE)
	var controls: Controls = _demo.get_node("Interface").controls
	var samples := controls.left.get_item_index(Methods.Method.SAMPLES)
	assert_bool(controls.left.is_item_disabled(samples)).is_true()
	_demo.environment_index = 0
	assert_bool(controls.left.is_item_disabled(samples)).is_false()


func test_the_ball_rolls_through_both_doorways() -> void:
	_enter()
	var ball: Node3D = _interior.get_node("ChromeBall")
	var is_reached: Array[bool] = [false, false, false]
	var boxes: Array[AABB] = [Plan.WARM, Plan.COOL, Plan.YARD]
	var before := ball.position
	var turned := ball.rotation.z
	const STEPS := 400
	for step in STEPS:
		_demo.turn = TAU * (step + 1) / STEPS
		var place := ball.position
		# It stands on the floor, rolls without sliding and stays away from the doorways' sides.
		assert_float(place.y).is_equal_approx(Plan.BALL_RADIUS, 1e-5)
		var rolled := (ball.rotation.z - turned) * Plan.BALL_RADIUS
		assert_float(rolled).is_equal_approx(before.x - place.x, 1e-4)
		assert_float(place.z - Plan.BALL_RADIUS).is_greater(Plan.DOORWAY.x + 0.05)
		assert_float(place.z + Plan.BALL_RADIUS).is_less(Plan.DOORWAY.y - 0.05)
		for index in boxes.size():
			var all := AABB(place, Vector3.ZERO).grow(0.99 * Plan.BALL_RADIUS)
			is_reached[index] = is_reached[index] or boxes[index].encloses(all)
		before = place
		turned = ball.rotation.z
	assert_array(is_reached).is_equal([true, true, true])
	assert_float(_demo.camera.target.x).is_equal_approx(_interior.get_target().x, 1e-5)


func test_every_room_has_a_probe_of_both_kinds() -> void:
	_enter()
	var lobes := _interior.find_children("*", "LobeProbe3D", true, false)
	var engine := _interior.find_children("*", "ReflectionProbe", true, false)
	assert_int(lobes.size()).is_equal(3)
	assert_int(engine.size()).is_equal(3)
	for index in lobes.size():
		var ours: LobeProbe3D = lobes[index]
		var theirs: ReflectionProbe = engine[index]
		assert_vector(theirs.global_position).is_equal(ours.global_position)
		assert_vector(theirs.origin_offset).is_equal(ours.origin_offset)
		assert_bool(theirs.interior).is_equal(ours.interior)
		assert_bool(theirs.box_projection).is_true()
		# Theirs fades inside its box, and is whole in the room.
		var whole := theirs.size - 2.0 * theirs.blend_distance * Vector3.ONE
		assert_vector(whole).is_equal_approx(ours.size, 1e-4 * Vector3.ONE)
		assert_bool(theirs.is_visible_in_tree()).is_false()
	_demo.right_method = Methods.Method.STOCK
	for theirs: ReflectionProbe in engine:
		assert_bool(theirs.is_visible_in_tree()).is_true()
	_demo.environment_index = 0
	for probe: Node3D in lobes + engine:
		assert_bool(probe.is_visible_in_tree()).is_false()


func test_the_lamp_is_switched_by_its_control() -> void:
	var controls: Controls = _demo.get_node("Interface").controls
	assert_bool(controls.lamp.is_visible_in_tree()).is_false()
	_enter()
	assert_bool(controls.lamp.is_visible_in_tree()).is_true()
	assert_bool(controls.lamp.button_pressed).is_true()
	controls.lamp.button_pressed = false
	assert_bool(_interior.is_lamp_on).is_false()
	controls.lamp.button_pressed = true
	assert_bool(_interior.is_lamp_on).is_true()


func test_light_on_walls_is_finite() -> void:
	_enter()
	var lit := 0
	for node: MeshInstance3D in _interior.find_children("*", "MeshInstance3D", true, false):
		var light: Variant = node.mesh.surface_get_arrays(0)[Mesh.ARRAY_CUSTOM0]
		if light == null:
			continue
		lit += 1
		for value: float in light:
			assert_bool(is_finite(value) and value >= 0.0 and value < 20.0).is_true()
	assert_int(lit).is_greater(10)


func test_light_that_stays_is_brighter_towards_what_it_comes_from() -> void:
	var light := StillLight.new()
	# In the warm room from the doorway; in the cool one from the windows, in front of them.
	var doorway := light.on(Vector3(-0.5, 0.0, Plan.BALL_Z), Vector3.UP)
	assert_float(doorway.z).is_greater(light.on(Vector3(-2.5, 0.0, Plan.BALL_Z), Vector3.UP).z)
	var below := light.on(Vector3(StillLight.WINDOWS[1].x, 0.0, 0.6), Vector3.UP)
	assert_float(below.y).is_greater(light.on(Vector3(0.4, 0.0, -1.4), Vector3.UP).y)
	assert_float(below.y).is_greater(4.0 * doorway.y)
	# Outside, the sky is above.
	var paving := light.on(Vector3(6.5, 0.0, 0.0), Vector3.UP)
	assert_float(paving.z).is_greater(light.on(Vector3(6.5, 0.5, 0.0), Vector3.RIGHT).z)
	assert_float(paving.z).is_equal_approx(StillLight.SKY.z, 0.02)
