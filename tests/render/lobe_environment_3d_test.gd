extends GdUnitTestSuite
## LobeEnvironment3D rebuilds when it should, and never more than it should.

const Kit := preload("support/render_kit.gd")
const SkyKit := preload("support/sky_kit.gd")

var _environment: LobeEnvironment3D
var _rebuilt := 0


func before_test() -> void:
	_rebuilt = 0
	_environment = LobeEnvironment3D.new()
	_environment.source = LobeEnvironment3D.Source.PANORAMA
	_environment.rebuilt.connect(func() -> void: _rebuilt += 1)


func after_test() -> void:
	if is_instance_valid(_environment):
		_environment.free()


func test_entering_the_tree_rebuilds() -> void:
	_environment.panorama = Kit.constant(1.0)
	add_child(_environment)
	await _environment.rebuild_finished
	assert_int(_rebuilt).is_equal(1)
	assert_int(_environment.get_cubemap().get_width()).is_equal(8)
	# Back in the tree, the light is still right.
	remove_child(_environment)
	add_child(_environment)
	await _frames(3)
	assert_int(_rebuilt).is_equal(1)


func test_changes_of_one_frame_make_one_rebuild() -> void:
	add_child(_environment)
	_environment.panorama = Kit.constant(1.0)
	_environment.size = 16
	_environment.filter = LobeEnvironment3D.Filter.BOX
	await _frames(4)
	assert_int(_rebuilt).is_equal(1)
	assert_int(_environment.get_cubemap().get_width()).is_equal(16)
	# The energy and the rotation are no part of the pyramid.
	_environment.energy = 2.0
	_environment.rotation.x = 1.0
	await _frames(4)
	assert_int(_rebuilt).is_equal(1)
	(_environment.panorama as ImageTexture).set_image(Kit.constant(3.0).get_image())
	await _frames(4)
	assert_int(_rebuilt).is_equal(2)


func test_an_overtaken_rebuild_waits_for_the_later_one() -> void:
	_environment.panorama = Kit.constant(1.0)
	var results := []
	var first := func() -> void: results.append(await _environment.rebuild())
	first.call()
	_environment.size = 32
	results.append(await _environment.rebuild())
	await _frames(2)
	assert_array(results).is_equal([true, true])
	assert_int(_rebuilt).is_equal(1)
	assert_int(_environment.get_cubemap().get_width()).is_equal(32)


func test_a_rebuild_overtaken_by_a_failure_ends_too() -> void:
	_environment.panorama = Kit.constant(1.0)
	var results := []
	var first := func() -> void: results.append(await _environment.rebuild())
	first.call()
	_environment.panorama = null
	results.append(await _environment.rebuild())
	await _frames(2)
	assert_array(results).is_equal([false, false])


func test_freed_during_a_rebuild() -> void:
	_environment.panorama = Kit.constant(1.0)
	_environment.rebuild()
	var chain: WeakRef = weakref(_environment._chain)
	# Assertions on the object itself would keep it.
	assert_bool(chain.get_ref() != null).is_true()
	_environment.free()
	await _frames(3)
	assert_int(_rebuilt).is_equal(0)
	assert_bool(chain.get_ref() == null).is_true()


func test_without_a_panorama_there_is_no_light() -> void:
	_environment.panorama = Kit.constant(1.0)
	assert_bool(await _environment.rebuild()).is_true()
	_environment.panorama = null
	assert_bool(await _environment.rebuild()).is_false()
	assert_object(_environment.get_cubemap()).is_null()


func test_materials_belong_to_all_worlds() -> void:
	var views: Array[LinearViewport] = [LinearViewport.new(8), LinearViewport.new(8)]
	var lights: Array[LobeEnvironment3D] = []
	for i in 2:
		add_child(views[i])
		views[i].add_child(SkyKit.make_mirror())
		lights.append(LobeEnvironment3D.new())
		lights[i].panorama = Kit.constant(1.0 + i)
		lights[i].update_mode = LobeEnvironment3D.UpdateMode.ONCE
	views[0].add_child(lights[0])
	await lights[0].rebuild()
	var add_second := func() -> void:
		views[1].add_child(lights[1])
		await lights[1].rebuild()
	await (
		assert_error(add_second)
		. is_push_warning(
			(
				"LobeEnvironment3D: another world has one as well; LobeMaterial3Ds in all worlds are lit by"
				+ " the one that came last."
			)
		)
	)
	# The one that came last lights both; once it has gone, the other does.
	for expected: float in [2.0, 1.0]:
		for view in views:
			var image: Image = await view.capture()
			assert_float(image.get_pixel(4, 4).g).is_equal_approx(expected, 0.01)
		lights[1].hide()
	for view in views:
		view.free()


func test_automatic_size() -> void:
	for pair: Vector2i in [Vector2i(8, 8), Vector2i(200, 256), Vector2i(520, 512)]:
		var image := Image.create_empty(pair.x, 4, false, Image.FORMAT_RGBH)
		_environment.panorama = ImageTexture.create_from_image(image)
		await _environment.rebuild()
		assert_int(_environment.get_cubemap().get_width()).is_equal(pair.y)


func _frames(count: int) -> void:
	for i in count:
		await RenderingServer.frame_post_draw
