extends GdUnitTestSuite
## Probes are captured when they should, in the right order, within the budget of a frame, and leave
## nothing behind after some hundred updates, or as many as LOBELIGHT_UPDATES says.

const LightRegistry := preload("res://addons/lobelight/runtime/light/light_registry.gd")
const LightStore := preload("res://addons/lobelight/runtime/probes/light_store.gd")
const ProbeSchedule := preload("res://addons/lobelight/runtime/probes/probe_schedule.gd")
const MODES := LobeProbe3D.UpdateMode
const TEXELS := 16

var _view: LinearViewport
# By probe: how often it has been captured anew.
var _rebuilt: Dictionary[LobeProbe3D, int] = {}
# Views and levels that were drawn for probes in each frame, and the probes whose turn it was.
var _drawn: Array[int] = []
var _turns: Array[LobeProbe3D] = []
var _window_size: Vector2i


func before() -> void:
	# Frames take as long as the window takes to be shown.
	_window_size = get_window().size
	get_window().size = Vector2i(64, 64)
	ProjectSettings.set_setting(LightStore.SETTING, TEXELS)


func after() -> void:
	get_window().size = _window_size
	ProjectSettings.set_setting(LightStore.SETTING, null)


func before_test() -> void:
	ProjectSettings.set_setting(ProbeSchedule.SETTING, null)
	_view = LinearViewport.new(8)
	add_child(_view)
	_rebuilt.clear()
	_drawn.clear()
	_turns.clear()


func after_test() -> void:
	if RenderingServer.frame_pre_draw.is_connected(_record):
		RenderingServer.frame_pre_draw.disconnect(_record)
	_view.free()


func test_sixteen_probes_within_the_budget() -> void:
	for views: int in [6, 2, 1]:
		ProjectSettings.set_setting(ProbeSchedule.SETTING, views)
		var probes := _add_probes(16)
		_watch()
		await _until_rebuilt(probes)
		assert_int(_drawn.max()).is_equal(views)
		for probe in probes:
			assert_int(_rebuilt[probe]).is_equal(1)
			assert_bool(_turns.count(probe) == 3).is_true()
			probe.free()
		after_test()
		before_test()


func test_near_and_large_ones_come_first() -> void:
	_view.camera.position = Vector3(3.0, 0.0, 0.0)
	var far := _add_probe(Vector3(60.0, 0.0, 0.0), 8.0)
	var small := _add_probe(Vector3(3.0, 0.0, 0.0), 2.0)
	var large := _add_probe(Vector3(3.0, 0.0, 0.0), 8.0)
	_watch()
	await _until_rebuilt([far, small, large])
	# Each of them before reflections between their materials are added to any.
	assert_array(_turns.slice(0, 3)).is_equal([large, small, far])


func test_one_probe_s_change_leaves_the_others_alone() -> void:
	var probes := _add_probes(4)
	await _until_rebuilt(probes)
	var before := probes[3].get_light().faces[0].get_data()
	_view.camera.environment.background_color = Color.RED
	assert_bool(await probes[1].rebuild()).is_true()
	probes[2].origin_offset.x = 0.1
	probes[0].intensity = 0.5
	await _frames(40)
	(
		assert_array(probes.map(func(probe: LobeProbe3D) -> int: return _rebuilt[probe]))
		. is_equal([1, 2, 2, 1])
	)
	assert_bool(probes[3].get_light().faces[0].get_data() == before).is_true()


func test_nothing_is_called_while_nothing_changes() -> void:
	await _frames(ProbeSchedule._IDLE_FRAMES + 4)
	var before := _count_callers()
	var probes := _add_probes(3)
	await _until_rebuilt(probes)
	await _frames(ProbeSchedule._IDLE_FRAMES + 4)
	assert_int(_count_callers()).is_equal(before)
	assert_object(ProbeSchedule._capture).is_null()
	# And it begins again when there is something to do.
	assert_bool(await probes[2].rebuild()).is_true()


func test_what_changes_all_the_time_is_captured_nonetheless() -> void:
	ProjectSettings.set_setting(ProbeSchedule.SETTING, 1)
	var probe := _add_probe(Vector3.ZERO, 2.0)
	await _until_rebuilt([probe])
	probe.update_mode = MODES.WHEN_CHANGED
	_view.camera.environment.background_color = Color.GREEN
	for frame in 24:
		probe.position.x += 0.01
		await _frames(1)
	_assert_colour(_colour_of(probe), Color.GREEN)


func test_probes_of_every_frame_leave_others_their_turns() -> void:
	var greedy := _add_probe(Vector3.ZERO, 8.0)
	greedy.update_mode = MODES.EVERY_FRAME
	var sliced := _add_probe(Vector3.ZERO, 4.0)
	sliced.update_mode = MODES.TIME_SLICED
	var once := _add_probe(Vector3(4.0, 0.0, 0.0), 2.0)
	await _until_rebuilt([once])
	assert_int(_rebuilt[once]).is_equal(1)
	assert_int(_rebuilt[sliced]).is_greater(1)
	assert_int(_rebuilt[greedy]).is_greater(10)


func test_a_lamp_s_change_has_the_rooms_captured_that_it_reaches() -> void:
	var lamp := OmniLight3D.new()
	lamp.omni_range = 3.0
	_view.add_child(lamp)
	var near := _add_probe(Vector3.ZERO, 4.0)
	var far := _add_probe(Vector3(20.0, 0.0, 0.0), 4.0)
	for probe: LobeProbe3D in [near, far]:
		probe.update_mode = MODES.WHEN_CHANGED
	var once := _add_probe(Vector3.ZERO, 4.0)
	await _until_rebuilt([near, far, once])
	await _assert_rebuilt([near, far, once], [0, 0, 0])
	lamp.light_energy = 2.0
	await _assert_rebuilt([near, far, once], [1, 0, 0])
	lamp.hide()
	await _assert_rebuilt([near, far, once], [1, 0, 0])
	# Nobody sees what it is while it is off.
	lamp.light_color = Color.RED
	await _assert_rebuilt([near, far, once], [0, 0, 0])
	lamp.show()
	await _assert_rebuilt([near, far, once], [1, 0, 0])
	# From one room to the other, and back as it reaches both.
	lamp.position.x = 20.0
	await _assert_rebuilt([near, far, once], [1, 1, 0])
	lamp.omni_range = 30.0
	await _assert_rebuilt([near, far, once], [1, 1, 0])
	lamp.omni_range = 3.0
	await _assert_rebuilt([near, far, once], [1, 1, 0])
	# In another world it reaches neither.
	var other := LinearViewport.new(4)
	add_child(other)
	_view.remove_child(lamp)
	other.add_child(lamp)
	await _assert_rebuilt([near, far, once], [0, 1, 0])
	lamp.light_energy = 3.0
	await _assert_rebuilt([near, far, once], [0, 0, 0])
	other.remove_child(lamp)
	_view.add_child(lamp)
	await _assert_rebuilt([near, far, once], [0, 1, 0])
	lamp.free()
	await _assert_rebuilt([near, far, once], [0, 1, 0])
	other.free()
	var sun := DirectionalLight3D.new()
	_view.add_child(sun)
	await _assert_rebuilt([near, far, once], [1, 1, 0])


func test_every_frame_is_each_frame_for_one_probe() -> void:
	var probe := _add_probe(Vector3.ZERO, 2.0)
	probe.update_mode = MODES.EVERY_FRAME
	await _until_rebuilt([probe])
	_rebuilt[probe] = 0
	await _frames(6)
	assert_int(_rebuilt[probe]).is_equal(6)
	probe.hide()
	await _frames(3)
	assert_int(_rebuilt[probe]).is_equal(6)


func test_rebuild_ends_when_rendering_is_paused() -> void:
	var probe := _add_probe(Vector3.ZERO, 2.0)
	var other := _add_probe(Vector3.ZERO, 4.0)
	var results := []
	var ask := func(asked: LobeProbe3D) -> void: results.append(await asked.rebuild())
	ask.call(other)
	RenderingServer.render_loop_enabled = false
	ask.call(probe)
	await get_tree().process_frame
	await get_tree().process_frame
	RenderingServer.render_loop_enabled = true
	assert_array(results).is_equal([false, false])
	assert_str(probe.get_rebuild_error()).is_equal("Rendering is paused, so nothing is drawn.")
	assert_str(other.get_rebuild_error()).is_equal("Rendering is paused, so nothing is drawn.")
	# It is captured when rendering goes on.
	await _until_rebuilt([probe, other])
	assert_bool(await probe.rebuild()).is_true()
	assert_str(probe.get_rebuild_error()).is_empty()


func test_rebuild_ends_when_the_probe_goes() -> void:
	var results := []
	var ask := func(asked: LobeProbe3D) -> void: results.append(await asked.rebuild())
	var probe := _add_probe(Vector3.ZERO, 2.0)
	ask.call(probe)
	probe.hide()
	await _frames(1)
	assert_array(results).is_equal([false])
	assert_str(probe.get_rebuild_error()).contains("hidden")
	probe.show()
	ask.call(probe)
	_view.remove_child(probe)
	await _frames(1)
	assert_array(results).is_equal([false, false])
	assert_str(probe.get_rebuild_error()).contains("has left its world")
	_view.add_child(probe)
	ask.call(probe)
	probe.free()
	assert_array(results).is_equal([false, false, false])
	await _frames(2)


func test_freed_at_any_moment() -> void:
	ProjectSettings.set_setting(ProbeSchedule.SETTING, 2)
	for mode: LobeProbe3D.UpdateMode in MODES.values():
		for frames in 6:
			var view := LinearViewport.new(4)
			add_child(view)
			var probe := LobeProbe3D.new()
			probe.update_mode = mode
			view.add_child(probe)
			await _frames(frames)
			view.free()
	await _frames(2)
	assert_object(LightRegistry.get_placed()).is_null()


func test_more_probes_keep_the_lights_of_others() -> void:
	var colours: Array[Color] = [Color.RED, Color.GREEN, Color.BLUE, Color.YELLOW, Color.MAGENTA]
	var probes: Array[LobeProbe3D] = []
	for count: int in [1, 2, 3, 5]:
		while probes.size() < count:
			_view.camera.environment.background_color = colours[probes.size()]
			probes.append(_add_probe(Vector3.ZERO, 2.0))
			await _until_rebuilt([probes.back()])
		for i in count:
			_assert_colour(_colour_of(probes[i]), colours[i])
	# What has left makes room for the next one, and takes nothing along.
	var rooms := _count_rooms()
	probes[1].free()
	_view.camera.environment.background_color = Color.CYAN
	probes[1] = _add_probe(Vector3.ZERO, 2.0)
	# What is there of another probe is not its light.
	assert_object(probes[1].get_light()).is_null()
	await _until_rebuilt([probes[1]])
	colours[1] = Color.CYAN
	for i in 5:
		_assert_colour(_colour_of(probes[i]), colours[i])
	assert_int(_count_rooms()).is_equal(rooms)


func test_hundreds_of_updates_leave_nothing_behind() -> void:
	var count := 300
	if OS.has_environment("LOBELIGHT_UPDATES"):
		count = OS.get_environment("LOBELIGHT_UPDATES").to_int()
	var probes := _add_probes(2)
	for probe in probes:
		probe.update_mode = MODES.EVERY_FRAME
	await _frames(30)
	# In Compatibility the engine may still make buffers of its own in the first rounds.
	for turn in 3:
		var before: Dictionary = await _in_use()
		for probe in probes:
			_rebuilt[probe] = 0
		await _frames(count)
		var updates: int = _rebuilt[probes[0]] + _rebuilt[probes[1]]
		assert_int(_rebuilt[probes[0]]).is_between(floori(0.4 * count), ceili(0.6 * count))
		assert_int(updates).is_equal(count)
		var after: Dictionary = await _in_use()
		if after == before or turn == 2:
			assert_dict(after).is_equal(before)
			return


func test_probes_of_two_worlds_take_turns() -> void:
	var other := LinearViewport.new(4)
	other.camera.environment.background_color = Color.GREEN
	add_child(other)
	_view.camera.environment.background_color = Color.RED
	var probes := _add_probes(2)
	_view.remove_child(probes[1])
	other.add_child(probes[1])
	for probe in probes:
		probe.update_mode = MODES.EVERY_FRAME
	await _frames(20)
	var before: Dictionary = await _in_use()
	_rebuilt[probes[1]] = 0
	await _frames(40)
	assert_int(_rebuilt[probes[1]]).is_between(15, 25)
	_assert_colour(_colour_of(probes[0]), Color.RED)
	_assert_colour(_colour_of(probes[1]), Color.GREEN)
	assert_dict(await _in_use()).is_equal(before)
	# What is left of a world that has gone does not stay.
	var gone: WeakRef = weakref(other.find_world_3d())
	other.free()
	await _frames(ProbeSchedule._IDLE_FRAMES + 4)
	assert_bool(gone.get_ref() == null).is_true()


func test_rebuilds_and_comings_and_goings_leave_nothing_behind() -> void:
	var before := {}
	for turn in 18:
		var probes := _add_probes(1 + turn % 5)
		assert_bool(await probes.back().rebuild()).is_true()
		for probe in probes:
			probe.free()
		# What the first ones leave to the next is made once.
		if turn % 6 == 5:
			var after: Dictionary = await _in_use()
			if after == before or turn == 17:
				assert_dict(after).is_equal(before)
				return
			before = after


func _add_probes(count: int) -> Array[LobeProbe3D]:
	var probes: Array[LobeProbe3D] = []
	for i in count:
		probes.append(_add_probe(Vector3(4.0 * (i % 4), 4.0 * floorf(0.25 * i), 0.0), 4.0))
	return probes


func _add_probe(position: Vector3, side: float) -> LobeProbe3D:
	var probe := LobeProbe3D.new()
	probe.position = position
	probe.size = side * Vector3.ONE
	_rebuilt[probe] = 0
	probe.rebuilt.connect(func() -> void: _rebuilt[probe] += 1)
	_view.add_child(probe)
	return probe


func _until_rebuilt(probes: Array[LobeProbe3D]) -> void:
	for frame in 2000:
		if probes.all(func(probe: LobeProbe3D) -> bool: return _rebuilt[probe] > 0):
			return
		await RenderingServer.frame_post_draw
	fail("The probes are not captured.")


# How often each is captured anew in the next frames.
func _assert_rebuilt(probes: Array[LobeProbe3D], expected: Array[int]) -> void:
	for probe in probes:
		_rebuilt[probe] = 0
	await _frames(50)
	var counts: Array[int] = []
	for probe in probes:
		counts.append(_rebuilt[probe])
	assert_array(counts).is_equal(expected)


# From now on, what is drawn for probes. To be called when probes have been asked for, so that the
# schedule has said what a frame draws.
func _watch() -> void:
	RenderingServer.frame_pre_draw.connect(_record)


func _record() -> void:
	_drawn.append(ProbeSchedule._drawn.size())
	if ProbeSchedule._drawn.has(0):
		_turns.append(ProbeSchedule._current.node as LobeProbe3D)


# What is called in each frame.
func _count_callers() -> int:
	var signals: Array[Signal] = [
		RenderingServer.frame_pre_draw,
		RenderingServer.frame_post_draw,
		get_tree().process_frame,
		get_tree().physics_frame,
	]
	var count := 0
	for each in signals:
		count += each.get_connections().size()
	return count


# Places for lights, taken or not.
func _count_rooms() -> int:
	var store: RefCounted = LightRegistry.get_placed().get_store()
	return store._cubes.size() if LinearViewport.is_compatibility() else store._capacity


func _colour_of(probe: LobeProbe3D) -> Color:
	var colours: Array[Color] = []
	for face in probe.get_light().faces:
		colours.append(face.get_pixel(3, 5))
	for colour in colours:
		_assert_colour(colour, colours[0])
	return colours[0]


# What there is of textures, buffers and objects. To be awaited.
func _in_use() -> Dictionary:
	await _frames(4)
	return {
		"textures":
		RenderingServer.get_rendering_info(RenderingServer.RENDERING_INFO_TEXTURE_MEM_USED),
		"buffers":
		RenderingServer.get_rendering_info(RenderingServer.RENDERING_INFO_BUFFER_MEM_USED),
		"objects": Performance.get_monitor(Performance.OBJECT_COUNT),
		"resources": Performance.get_monitor(Performance.OBJECT_RESOURCE_COUNT),
	}


func _frames(count: int) -> void:
	for i in count:
		await RenderingServer.frame_post_draw


func _assert_colour(got: Color, expected: Color) -> void:
	var off := Vector3(got.r - expected.r, got.g - expected.g, got.b - expected.b).abs()
	assert_float(off[off.max_axis_index()]).append_failure_message("%s" % got).is_less(0.01)
