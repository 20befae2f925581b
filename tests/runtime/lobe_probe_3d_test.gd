extends GdUnitTestSuite
## LobeProbe3D where nothing is drawn: its box, what it has of ReflectionProbe, and warnings.


func _make() -> LobeProbe3D:
	return auto_free(LobeProbe3D.new())


func test_names_types_and_defaults_are_those_of_the_engine_s_probe() -> void:
	var probe := _make()
	var engine: ReflectionProbe = auto_free(ReflectionProbe.new())
	for property: String in [
		"intensity",
		"blend_distance",
		"max_distance",
		"size",
		"origin_offset",
		"interior",
		"cull_mask",
		"update_mode"
	]:
		var of_engine: Variant = engine.get(property)
		assert_that(probe.get(property)).is_equal(of_engine)
		assert_int(typeof(probe.get(property))).is_equal(typeof(of_engine))


func test_the_capture_point_stays_inside_as_in_the_engine_s_probe() -> void:
	var probe := _make()
	var engine: ReflectionProbe = auto_free(ReflectionProbe.new())
	for step: Array in [
		["size", Vector3(2, 4, 6)],
		["origin_offset", Vector3(5, -1.995, 0.5)],
		["size", Vector3(1, 8, 0.5)],
		["size", Vector3(20, 20, 20)],
		["origin_offset", Vector3(-30, 0, 9.99)],
	]:
		for node: Node3D in [probe, engine]:
			node.set(step[0], step[1])
		assert_vector(probe.origin_offset).is_equal_approx(engine.origin_offset, Vector3.ONE * 1e-6)
		assert_vector(probe.size).is_equal(engine.size)


func test_a_box_always_has_a_volume() -> void:
	var probe := _make()
	probe.size = Vector3(-1, 0, 0.001)
	assert_vector(probe.size).is_equal(Vector3.ONE * LobeProbe3D.MIN_SIZE)
	assert_vector(probe.origin_offset).is_equal(Vector3.ZERO)
	probe.size = Vector3(NAN, INF, 3)
	assert_vector(probe.size).is_equal(Vector3(20, 20, 3))
	probe.origin_offset = Vector3(NAN, INF, 1)
	assert_vector(probe.origin_offset).is_equal(Vector3(0, 0, 1))


func test_numbers_are_finite_and_not_negative() -> void:
	var probe := _make()
	for property: String in ["intensity", "blend_distance", "max_distance"]:
		for value: float in [-1.0, NAN, INF]:
			probe.set(property, value)
			assert_float(probe.get(property)).is_equal(0.0)
		probe.set(property, 2.5)
		assert_float(probe.get(property)).is_equal(2.5)


func test_the_box_is_turned_and_moved_but_not_scaled() -> void:
	var parent: Node3D = auto_free(Node3D.new())
	var probe := LobeProbe3D.new()
	parent.add_child(probe)
	add_child(parent)
	parent.scale = Vector3(2, 3, 4)
	probe.position = Vector3(1, 1, 1)
	probe.rotation = Vector3(0.1, 0.7, -0.3)
	probe.scale = Vector3(1, 5, 1)
	var box := probe.get_box()
	assert_vector(box.origin).is_equal_approx(Vector3(2, 3, 4), Vector3.ONE * 1e-5)
	assert_vector(box.basis.get_scale()).is_equal_approx(Vector3.ONE, Vector3.ONE * 1e-5)
	probe.size = Vector3(6, 3, 8)
	assert_that(probe.get_aabb()).is_equal(AABB(Vector3(-3, -1.5, -4), Vector3(6, 3, 8)))
	remove_child(parent)


func test_a_capture_reaches_all_of_the_box() -> void:
	var probe := _make()
	probe.size = Vector3(6, 3, 8)
	probe.origin_offset = Vector3(-1, 0.5, 2)
	for corner in 8:
		var way := probe.get_aabb().get_endpoint(corner) - probe.origin_offset
		assert_float(probe._get_reach()).is_greater_equal(way.length())
	probe.max_distance = 100.0
	assert_float(probe._get_reach()).is_equal(100.0)


func test_what_leaves_no_light_is_told() -> void:
	var probe := _make()
	probe.light = LobeLight.make_dark(true)
	assert_array(probe._get_configuration_warnings()).is_empty()
	probe.update_mode = LobeProbe3D.UpdateMode.TIME_SLICED
	assert_str(probe._get_configuration_warnings()[0]).contains("Update Mode does nothing")
	probe.update_mode = LobeProbe3D.UpdateMode.ONCE
	probe.size = Vector3(4, 0.05, 4)
	assert_str(probe._get_configuration_warnings()[0]).contains("only 0.05 m thick")
	probe.size = Vector3.ONE
	probe.scale = Vector3(1, 1, 2)
	assert_str(probe._get_configuration_warnings()[0]).contains("scale does not matter")
	probe.scale = Vector3.ONE
	probe.intensity = 0.0
	assert_str(probe._get_configuration_warnings()[0]).contains("Intensity is 0")
	probe.intensity = 1.0
	probe.light = null
	var text := "\n".join(probe._get_configuration_warnings())
	if DisplayServer.get_name() == "headless":
		assert_str(text).contains("headless")
