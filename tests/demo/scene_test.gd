extends GdUnitTestSuite
## The demo's scene: that it holds together, and what it does when it is used.

const DemoObject := preload("res://demo/demo_object.gd")
const DemoRoot := preload("res://demo/demo.gd")
const DemoScene := preload("res://demo/demo.tscn")
const DemoTables := preload("res://demo/demo_tables.gd")

var _demo: DemoRoot


func before_test() -> void:
	_demo = auto_free(DemoScene.instantiate())
	add_child(_demo)


func _objects() -> Array[DemoObject]:
	var objects: Array[DemoObject] = []
	for node in _demo.find_children("*", "MeshInstance3D", true, false):
		if node is DemoObject:
			objects.append(node)
	return objects


func _press(key: Key) -> void:
	var event := InputEventKey.new()
	event.keycode = key
	event.pressed = true
	_demo.get_node("Interface")._unhandled_key_input(event)


func test_every_object_has_a_material_and_a_recipe() -> void:
	assert_int(_objects().size()).is_equal(6)
	for object in _objects():
		assert_bool(object.material_override is LobeMaterial3D).is_true()
		assert_int(object.mesh.get_surface_count()).is_equal(1)
		var recipe := "%s/%s.json" % [DemoTables.RECIPES, object.recipe]
		assert_str(object.recipe).is_not_empty()
		assert_file(recipe).exists()


func test_brushed_objects_have_tangents() -> void:
	for object in _objects():
		if object.recipe == "brushed_ward":
			var arrays := object.mesh.surface_get_arrays(0)
			assert_bool(arrays[Mesh.ARRAY_TANGENT] != null).is_true()


func test_missing_tables_are_named() -> void:
	# Nothing bakes tables of three lobes.
	_demo.lobe_count = 3
	assert_array(_demo.missing_tables).has_size(4)
	assert_str(_demo.missing_tables[0]).ends_with("_3.res")
	for object in _objects():
		assert_object((object.material_override as LobeMaterial3D).table).is_null()


func test_environment_turns_and_changes() -> void:
	var light: LobeEnvironment3D = _demo.get_node("Light")
	var first := light.panorama
	_demo.environment_index = 1
	assert_object(light.panorama).is_not_same(first)
	var before := light.rotation.y
	_demo.turn = 0.5
	assert_float(light.rotation.y - before).is_equal_approx(0.5, 1e-5)


func test_keys() -> void:
	_press(KEY_E)
	assert_int(_demo.environment_index).is_equal(1)
	_press(KEY_E)
	assert_int(_demo.environment_index).is_equal(0)
	_press(KEY_L)
	assert_int(_demo.lobe_count).is_equal(16)
	_press(KEY_L)
	assert_int(_demo.lobe_count).is_equal(4)
	_press(KEY_R)
	var before := _demo.turn
	await await_millis(50)
	assert_float(_demo.turn).is_greater(before)


func test_camera_keeps_looking_at_its_target() -> void:
	var camera: Camera3D = _demo.get_node("Camera")
	var motion := InputEventMouseMotion.new()
	motion.button_mask = MOUSE_BUTTON_MASK_LEFT
	motion.relative = Vector2(300, -2000)
	camera._unhandled_input(motion)
	var to_target: Vector3 = (camera.target - camera.global_position).normalized()
	assert_float(to_target.dot(-camera.global_basis.z)).is_equal_approx(1.0, 1e-5)
	assert_float(camera.global_position.distance_to(camera.target)).is_equal_approx(
		camera.distance, 1e-4
	)
