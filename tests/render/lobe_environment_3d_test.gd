extends GdUnitTestSuite
## LobeEnvironment3D rebuilds when it should, and never more than it should.

const Kit := preload("support/render_kit.gd")

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
	await _frames(3 + Kit.count_update_frames())
	assert_int(_rebuilt).is_equal(1)
	assert_int(_environment.get_cubemap().get_width()).is_equal(16)
	# The energy and the rotation are no part of the pyramid.
	_environment.energy = 2.0
	_environment.rotation.x = 1.0
	await _frames(4)
	assert_int(_rebuilt).is_equal(1)
	(_environment.panorama as ImageTexture).set_image(Kit.constant(3.0).get_image())
	await _frames(3 + Kit.count_update_frames())
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
	var chain: WeakRef = weakref(_environment._live.chain)
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


func test_rebuild_ends_when_rendering_is_paused() -> void:
	_environment.panorama = Kit.constant(1.0)
	assert_bool(await _environment.rebuild()).is_true()
	var results := []
	var ask := func() -> void: results.append(await _environment.rebuild())
	# Before and during the update.
	ask.call()
	RenderingServer.render_loop_enabled = false
	ask.call()
	await get_tree().process_frame
	await get_tree().process_frame
	RenderingServer.render_loop_enabled = true
	assert_array(results).is_equal([false, false])
	var why := "Rendering is paused, so nothing is drawn."
	assert_str(_environment.get_rebuild_error()).is_equal(why)
	# When rendering goes on, so does the environment.
	_rebuilt = 0
	add_child(_environment)
	await _frames(2 + Kit.count_update_frames())
	assert_int(_rebuilt).is_equal(1)
	assert_bool(await _environment.rebuild()).is_true()
	assert_str(_environment.get_rebuild_error()).is_empty()


func test_rebuild_ends_when_the_node_goes() -> void:
	var results := []
	var ask := func() -> void: results.append(await _environment.rebuild())
	_environment.source = LobeEnvironment3D.Source.SKY
	add_child(_environment)
	assert_bool(await _environment.rebuild()).is_true()
	ask.call()
	remove_child(_environment)
	await _frames(1)
	assert_array(results).is_equal([false])
	assert_str(_environment.get_rebuild_error()).contains("has left the world")
	_environment.panorama = Kit.constant(1.0)
	_environment.source = LobeEnvironment3D.Source.PANORAMA
	ask.call()
	_environment.free()
	assert_array(results).is_equal([false, false])
	await _frames(2)


func test_hidden_and_waiting_environments_make_nothing() -> void:
	_environment.source = LobeEnvironment3D.Source.SKY
	add_child(_environment)
	await _frames(3)
	var before := _in_use()
	var others: Array[LobeEnvironment3D] = []
	# One waits, the other is hidden.
	for i in 2:
		others.append(LobeEnvironment3D.new())
		others[i].update_mode = LobeEnvironment3D.UpdateMode.EVERY_FRAME
		others[i].size = 64
		others[i].visible = i == 0
		others[i].rebuilt.connect(func() -> void: _rebuilt += 1)
		add_child(others[i])
	_rebuilt = 0
	await _frames(6)
	assert_int(_rebuilt).is_equal(0)
	assert_dict(_in_use()).is_equal(before)
	for other in others:
		assert_bool(other.is_active()).is_false()
		assert_object(other.get_cubemap()).is_null()
	# Their turns come, and the one that has been lighting waits.
	_environment.hide()
	_environment.update_mode = LobeEnvironment3D.UpdateMode.EVERY_FRAME
	await _frames(3)
	assert_int(_rebuilt).is_greater(0)
	assert_object(others[0].get_cubemap()).is_not_null()
	assert_object(others[1].get_cubemap()).is_null()
	others[0].free()
	others[1].show()
	await _frames(3)
	assert_object(others[1].get_cubemap()).is_not_null()
	others[1].free()


func test_an_environment_that_is_not_shown_is_not_called() -> void:
	var before := RenderingServer.frame_pre_draw.get_connections().size()
	_environment.panorama = Kit.constant(1.0)
	_environment.update_mode = LobeEnvironment3D.UpdateMode.EVERY_FRAME
	_environment.hide()
	add_child(_environment)
	await _frames(2)
	assert_int(RenderingServer.frame_pre_draw.get_connections().size()).is_equal(before)
	_environment.show()
	await _frames(2)
	assert_int(_rebuilt).is_greater(0)


func test_automatic_size() -> void:
	for pair: Vector2i in [Vector2i(8, 8), Vector2i(200, 256), Vector2i(520, 512)]:
		var image := Image.create_empty(pair.x, 4, false, Image.FORMAT_RGBH)
		_environment.panorama = ImageTexture.create_from_image(image)
		await _environment.rebuild()
		assert_int(_environment.get_cubemap().get_width()).is_equal(pair.y)


func _in_use() -> Dictionary:
	var server := RenderingServer
	return {
		"textures": server.get_rendering_info(RenderingServer.RENDERING_INFO_TEXTURE_MEM_USED),
		"buffers": server.get_rendering_info(RenderingServer.RENDERING_INFO_BUFFER_MEM_USED),
	}


func _frames(count: int) -> void:
	for i in count:
		await RenderingServer.frame_post_draw
