extends GdUnitTestSuite
## LobeEnvironment3D where nothing is drawn: properties, turns, and clear answers.

const EXPORTED := "user://environment_test.tscn"


func _panorama(width := 16) -> Texture2D:
	@warning_ignore("integer_division")
	var image := Image.create_empty(width, width / 2, false, Image.FORMAT_RGBAF)
	image.fill(Color.WHITE)
	return ImageTexture.create_from_image(image)


func _make() -> LobeEnvironment3D:
	return auto_free(LobeEnvironment3D.new())


func test_rebuild_says_what_is_missing() -> void:
	var environment := _make()
	assert_bool(await environment.rebuild()).is_false()
	assert_str(environment.get_rebuild_error()).contains("no panorama")
	if DisplayServer.get_name() == "headless":
		environment.panorama = _panorama()
		assert_bool(await environment.rebuild()).is_false()
		assert_str(environment.get_rebuild_error()).contains("no renderer")
		assert_object(environment.get_cubemap()).is_null()


func test_rebuild_finished_comes_either_way() -> void:
	var environment := _make()
	var told := [0]
	environment.rebuild_finished.connect(func() -> void: told[0] += 1)
	await environment.rebuild()
	assert_int(told[0]).is_equal(1)


func test_size_is_a_power_of_two_in_range() -> void:
	var environment := _make()
	for pair: Vector2i in [
		Vector2i(0, 0), Vector2i(-5, 0), Vector2i(1, 4), Vector2i(100, 128), Vector2i(99999, 2048)
	]:
		environment.size = pair.x
		assert_int(environment.size).is_equal(pair.y)


func test_energy_is_finite_and_not_negative() -> void:
	var environment := _make()
	for value: float in [-1.0, NAN, INF]:
		environment.energy = value
		assert_float(environment.energy).is_equal(0.0)
	environment.energy = 3.5
	assert_float(environment.energy).is_equal(3.5)


func test_warnings_in_the_editor() -> void:
	var first := _make()
	var second := _make()
	first.source = LobeEnvironment3D.Source.PANORAMA
	assert_int(first._get_configuration_warnings().size()).is_equal(1)
	first.panorama = _panorama()
	assert_str(first._get_configuration_warnings()[0]).contains("only 16 texels")
	first.panorama = _panorama(512)
	assert_array(first._get_configuration_warnings()).is_empty()
	second.panorama = _panorama(512)
	add_child(first)
	add_child(second)
	assert_bool(first.is_active()).is_true()
	assert_bool(second.is_active()).is_false()
	assert_str(second._get_configuration_warnings()[0]).contains("Another LobeEnvironment3D")
	first.visible = false
	assert_bool(second.is_active()).is_true()
	first.visible = true
	assert_bool(first.is_active()).is_true()
	remove_child(first)
	assert_bool(second.is_active()).is_true()
	remove_child(second)


func test_each_world_has_its_own() -> void:
	var viewport: SubViewport = auto_free(SubViewport.new())
	viewport.own_world_3d = true
	add_child(viewport)
	var here := _make()
	var there := LobeEnvironment3D.new()
	add_child(here)
	viewport.add_child(there)
	assert_bool(here.is_active()).is_true()
	assert_bool(there.is_active()).is_true()
	remove_child(here)
	remove_child(viewport)


func test_freed_while_it_waits() -> void:
	# The rebuild that is queued or under way must not outlive the node.
	var environment := LobeEnvironment3D.new()
	environment.panorama = _panorama()
	add_child(environment)
	environment.size = 64
	environment.free()
	await await_idle_frame()
	await await_idle_frame()
	assert_bool(is_instance_valid(environment)).is_false()


func test_scene_file_keeps_the_properties() -> void:
	var environment := _make()
	environment.filter = LobeEnvironment3D.Filter.BOX
	environment.size = 64
	environment.energy = 2.5
	var scene := PackedScene.new()
	scene.pack(environment)
	assert_int(ResourceSaver.save(scene, EXPORTED)).is_equal(OK)
	assert_bool("Cubemap" in FileAccess.get_file_as_string(EXPORTED)).is_false()
	var loaded: LobeEnvironment3D = auto_free((load(EXPORTED) as PackedScene).instantiate())
	assert_int(loaded.filter).is_equal(LobeEnvironment3D.Filter.BOX)
	assert_int(loaded.size).is_equal(64)
	assert_float(loaded.energy).is_equal(2.5)
	DirAccess.remove_absolute(EXPORTED)
