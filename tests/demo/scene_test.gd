extends GdUnitTestSuite
## The demo's scene: that it holds together, and what it does when it is used.

const Controls := preload("res://demo/interface/controls.gd")
const DemoRoot := preload("res://demo/demo.gd")
const DemoScene := preload("res://demo/demo.tscn")
const DemoTables := preload("res://demo/demo_tables.gd")
const Layers := preload("res://demo/layers.gd")
const Methods := preload("res://demo/methods.gd")
const RivalLight := preload("res://demo/rivals/rival_light.gd")
const RivalMaterial := preload("res://demo/rivals/rival_material.gd")

var _demo: DemoRoot


func before_test() -> void:
	_demo = auto_free(DemoScene.instantiate())
	add_child(_demo)


func test_every_object_has_a_material_and_a_name() -> void:
	assert_int(_demo.objects.size()).is_equal(6)
	var titles: Array[String] = []
	for object in _demo.objects:
		assert_bool(object.material_override is LobeMaterial3D).is_true()
		assert_int(object.mesh.get_surface_count()).is_equal(1)
		assert_bool(object.title in titles).is_false()
		titles.append(object.title)


func test_objects_have_the_tangents_that_their_sliders_need() -> void:
	for object in _demo.objects:
		var arrays := object.mesh.surface_get_arrays(0)
		assert_bool(arrays[Mesh.ARRAY_TANGENT] != null).is_true()


func test_starts_with_eight_lobes_of_the_ready_set() -> void:
	assert_int(_demo.lobe_count).is_equal(8)
	assert_array(_demo.missing_tables).is_empty()
	for object in _demo.objects:
		assert_str(object.material.table_set.resource_path).is_equal(DemoTables.READY)


func test_widths_at_the_start_are_widths_of_the_thesis_tables() -> void:
	# Its tables cannot be interpolated: there, the comparison is of methods and not of widths.
	for object in _demo.objects:
		var widths := object.get_widths()
		var alpha := LobeMaterial3D.widths_of(widths.x, widths.y)
		for width: float in [alpha.x, alpha.y]:
			var octaves := log(width / 0.01) / log(2.0)
			assert_float(absf(octaves - roundf(octaves))).is_less(0.01)


func test_environment_turns_and_changes() -> void:
	var light: LobeEnvironment3D = _demo.get_node("Light")
	var first := light.panorama
	_demo.environment_index = 1
	assert_object(light.panorama).is_not_same(first)
	var before := light.rotation.y
	_demo.turn = 0.5
	assert_float(light.rotation.y - before).is_equal_approx(0.5, 1e-5)


func test_the_studio_is_captured_and_its_lamp_moves() -> void:
	var light: LobeEnvironment3D = _demo.get_node("Light")
	_demo.environment_index = 2
	assert_bool(_demo.is_live()).is_true()
	assert_int(light.source).is_equal(LobeEnvironment3D.Source.CAPTURE)
	assert_int(light.capture_cull_mask).is_equal(Layers.STUDIO)
	var studio: Node3D = _demo.get_node("Studio")
	assert_bool(studio.visible).is_true()
	var lamp: Node3D = studio.get_child(-1)
	var before := lamp.position
	_demo.turn = 1.0
	assert_float(lamp.position.distance_to(before)).is_greater(1.0)
	_demo.environment_index = 0
	assert_bool(studio.visible).is_false()
	assert_int(light.source).is_equal(LobeEnvironment3D.Source.PANORAMA)


func test_sliders_set_the_chosen_object_or_all() -> void:
	var teapot := _demo.objects[1]
	var other := _demo.objects[0]
	var before := other.get_widths()
	_demo.chosen = 1
	_demo.set_widths(Vector3(0.5, 0.25, 0.75))
	assert_vector(teapot.get_widths()).is_equal_approx(Vector3(0.5, 0.25, 0.75), 1e-4 * Vector3.ONE)
	assert_vector(other.get_widths()).is_equal_approx(before, 1e-6 * Vector3.ONE)
	_demo.chosen = DemoRoot.EVERY_OBJECT
	_demo.set_widths(Vector3(0.3, 0.5, 0.0))
	for object in _demo.objects:
		assert_float(object.material.roughness).is_equal_approx(0.3, 1e-5)
	_demo.reset_widths()
	assert_vector(other.get_widths()).is_equal_approx(before, 1e-6 * Vector3.ONE)


func test_every_method_has_its_material_on_its_half() -> void:
	_demo.left_method = Methods.Method.STOCK
	_demo.right_method = Methods.Method.SAMPLES
	for object in _demo.objects:
		var twin: MeshInstance3D = object.get_child(0)
		# Without a renderer the map of the right method never comes; until then it is lit as ours.
		assert_object(twin.material_override).is_same(object.material)
		object.rival_light = RivalLight.new()
		assert_int(object.layers).is_equal(Layers.LEFT)
		assert_int(twin.layers).is_equal(Layers.RIGHT)
		assert_bool(object.material_override is BaseMaterial3D).is_true()
		assert_bool(twin.material_override is RivalMaterial).is_true()
	_demo.right_method = Methods.NONE
	for object in _demo.objects:
		assert_bool((object.get_child(0) as MeshInstance3D).visible).is_false()


func test_only_halves_that_are_seen_are_drawn() -> void:
	var view := _demo.compare_view
	assert_bool(view.get_viewports()[1].is_valid()).is_false()
	_demo.right_method = Methods.Method.SAMPLES
	assert_bool(view.get_viewports()[1].is_valid()).is_true()
	assert_int(_demo.camera.cull_mask & Layers.LEFT).is_not_equal(0)
	_demo.divider = 1.0
	assert_bool(view.get_viewports()[1].is_valid()).is_false()
	assert_int(_demo.camera.cull_mask & Layers.LEFT_COVER).is_equal(0)
	_demo.divider = 0.0
	assert_bool(view.get_viewports()[0].is_valid()).is_false()
	assert_int(_demo.camera.cull_mask & Layers.LEFT).is_equal(0)
	assert_int(_demo.camera.cull_mask & Layers.RIGHT).is_not_equal(0)


func test_the_engine_makes_maps_for_its_own_material_only() -> void:
	var world: Environment = (_demo.get_node("World") as WorldEnvironment).environment
	assert_object(world.sky).is_null()
	_demo.right_method = Methods.Method.STOCK
	assert_object(world.sky).is_not_null()
	var sky := world.sky
	_demo.environment_index = 2
	assert_object(world.sky).is_same(sky)
	assert_bool(sky.sky_material is ShaderMaterial).is_true()
	_demo.right_method = Methods.NONE
	assert_object(world.sky).is_null()
	assert_int(world.reflected_light_source).is_equal(Environment.REFLECTION_SOURCE_DISABLED)


func test_sets_that_were_not_made_cannot_be_chosen() -> void:
	var controls: Controls = _demo.get_node("Interface").controls
	for count in DemoTables.LOBE_COUNTS:
		var index := controls.lobes.get_item_index(count)
		var is_there := ResourceLoader.exists(DemoTables.path_of(count))
		assert_bool(controls.lobes.is_item_disabled(index)).is_equal(not is_there)


func test_camera_keeps_its_target_in_the_middle_of_what_is_free() -> void:
	var size := _demo.get_viewport().get_visible_rect().size
	for area: Rect2 in [Rect2(), Rect2(Vector2.ZERO, size * Vector2(0.6, 1.0))]:
		_demo.camera.free_area = area
		var middle := area.get_center() if area.has_area() else 0.5 * size
		var seen := _demo.camera.unproject_position(_demo.camera.target)
		assert_float(seen.distance_to(middle)).is_less(0.5)
