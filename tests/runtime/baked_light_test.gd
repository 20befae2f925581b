extends GdUnitTestSuite
## LobeEnvironment3D with a baked light where nothing is drawn: what it says, and what comes of it
## in files, on threads and in the inspector.

const LIGHT := "user://baked_light_of_environment.res"
const SCENE := "user://baked_light_of_environment.tscn"
const TEXELS := 4


func after_test() -> void:
	for path: String in [LIGHT, SCENE]:
		if FileAccess.file_exists(path):
			DirAccess.remove_absolute(path)


func _make_light() -> LobeLight:
	var faces: Array[Image] = []
	for face in 6:
		var image := Image.create_empty(TEXELS, TEXELS, true, Image.FORMAT_RGBAH)
		image.fill(Color(0.25 * face, 1.0, 2.0))
		image.generate_mipmaps()
		faces.append(image)
	var light := LobeLight.new()
	light.faces = faces
	light.size = TEXELS
	light.is_even = true
	return light


func _make(light: LobeLight) -> LobeEnvironment3D:
	var environment: LobeEnvironment3D = auto_free(LobeEnvironment3D.new())
	environment.light = light
	return environment


func test_the_light_is_there_before_and_after_the_tree() -> void:
	var environment := _make(_make_light())
	for turn in 2:
		assert_object(environment.get_light()).is_not_null()
		assert_int(environment.get_cubemap().get_width()).is_equal(TEXELS)
		assert_bool(await environment.rebuild()).is_true()
		assert_str(environment.get_rebuild_error()).is_empty()
		if turn == 0:
			add_child(environment)
			assert_bool(environment.is_active()).is_true()
	assert_object(environment._live).is_null()
	remove_child(environment)
	assert_object(environment.get_light()).is_not_null()
	environment.light = null
	assert_object(environment.get_light()).is_null()


func test_the_node_places_a_light_of_its_own() -> void:
	var light := _make_light()
	var first := _make(light)
	var second := _make(light)
	second.energy = 3.0
	second.basis = Basis(Vector3.UP, 0.5).scaled(Vector3(2, 2, 2))
	assert_float(first.get_light().energy).is_equal(1.0)
	assert_float(second.get_light().energy).is_equal(3.0)
	assert_bool(second.get_light().rotation.is_equal_approx(Basis(Vector3.UP, 0.5))).is_false()
	# Transforms count when the node is in the tree.
	add_child(second)
	assert_bool(second.get_light().rotation.is_equal_approx(Basis(Vector3.UP, 0.5))).is_true()
	assert_bool(light.rotation == Basis.IDENTITY).is_true()
	assert_object(first.get_cubemap()).is_same(second.get_cubemap())
	remove_child(second)


func test_signals_tell_once_that_it_is_shown() -> void:
	var environment := _make(_make_light())
	var told: PackedStringArray = []
	environment.rebuilt.connect(func() -> void: told.append("rebuilt"))
	environment.rebuild_finished.connect(func() -> void: told.append("finished"))
	environment.hide()
	add_child(environment)
	await await_idle_frame()
	assert_array(told).is_empty()
	environment.show()
	environment.energy = 2.0
	environment.hide()
	environment.show()
	# Whoever comes later in the same frame hears of it, too.
	assert_array(told).is_empty()
	await await_idle_frame()
	assert_array(told).contains_exactly(["rebuilt", "finished"])
	await environment.rebuild()
	await await_idle_frame()
	assert_int(told.size()).is_equal(2)
	environment.light = _make_light()
	await await_idle_frame()
	assert_int(told.size()).is_equal(4)
	remove_child(environment)


func test_a_damaged_light_is_told_of_once_and_live_light_takes_its_place() -> void:
	var light := _make_light()
	light.faces = light.faces.slice(1)
	var environment := _make(null)
	var give := func() -> void: environment.light = light
	await assert_error(give).is_push_error("LobeEnvironment3D: Light: " + light.get_problem())
	add_child(environment)
	assert_object(environment.get_light()).is_null()
	assert_object(environment._live).is_not_null()
	var warnings := environment._get_configuration_warnings()
	assert_str("\n".join(warnings)).contains(light.get_problem())
	# Mended in place, as when its file is imported anew.
	light.faces = _make_light().faces
	assert_object(environment.get_light()).is_not_null()
	assert_object(environment._live).is_null()
	remove_child(environment)


func test_the_editor_shows_what_counts() -> void:
	var environment := _make(null)
	assert_array(_get_shown(environment)).contains(["update_mode", "measure_cost", "panorama"])
	assert_int(environment._get_configuration_warnings().size()).is_equal(0)
	environment.source = LobeEnvironment3D.Source.PANORAMA
	assert_int(environment._get_configuration_warnings().size()).is_equal(1)
	environment.light = _make_light()
	var shown := _get_shown(environment)
	assert_array(shown).not_contains(["update_mode", "update_interval", "update_frames"])
	# What the next bake takes.
	assert_array(shown).contains(["source", "panorama", "filter", "size", "energy", "light"])
	assert_array(environment._get_configuration_warnings()).is_empty()
	environment.energy = 0.0
	assert_str(environment._get_configuration_warnings()[0]).contains("Energy is 0")
	environment.light = null
	assert_array(_get_shown(environment)).contains(["update_mode", "measure_cost"])


func _get_shown(object: Object) -> Array[String]:
	var names: Array[String] = []
	for property in object.get_property_list():
		if property.usage & (PROPERTY_USAGE_EDITOR):
			names.append(property.name)
	return names


func test_a_scene_that_a_thread_loads_has_its_light() -> void:
	var light := _make_light()
	light.axes = Basis(Vector3.UP, 0.25)
	light.is_of_world = true
	light.base_energy = 4.0
	assert_int(ResourceSaver.save(light, LIGHT, ResourceSaver.FLAG_COMPRESS)).is_equal(OK)
	light.take_over_path(LIGHT)
	var environment := _make(light)
	environment.update_mode = LobeEnvironment3D.UpdateMode.ONCE
	var packed := PackedScene.new()
	packed.pack(environment)
	assert_int(ResourceSaver.save(packed, SCENE)).is_equal(OK)
	# What is hidden is saved all the same.
	assert_str(FileAccess.get_file_as_string(SCENE)).contains("update_mode")
	environment.light = null
	light = null
	var thread := Thread.new()
	thread.start(_load_scene)
	while thread.is_alive():
		await await_idle_frame()
	var loaded: LobeEnvironment3D = auto_free(thread.wait_to_finish())
	add_child(loaded)
	var shown := loaded.get_light()
	assert_bool(shown.rotation.is_equal_approx(Basis(Vector3.UP, 0.25))).is_true()
	assert_float(shown.energy).is_equal(4.0)
	assert_float(shown.faces[2].get_pixel(1, 1).r).is_equal(0.5)
	remove_child(loaded)


func _load_scene() -> Node:
	var packed: PackedScene = ResourceLoader.load(SCENE, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP)
	return packed.instantiate()


func test_freed_at_any_moment() -> void:
	var light := _make_light()
	for frames in 3:
		var environment := LobeEnvironment3D.new()
		environment.light = light
		add_child(environment)
		for frame in frames:
			await await_idle_frame()
		environment.free()
		light.emit_changed()
	await await_idle_frame()
	assert_int(light.changed.get_connections().size()).is_equal(0)
