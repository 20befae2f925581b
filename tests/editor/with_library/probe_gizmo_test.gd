@tool
extends GdUnitTestSuite
## The handles of LobeProbe3D's gizmo, dragged as the 3D view drags them.

const BoxHandles := preload("res://addons/lobelight/editor/gizmos/box_handles.gd")
const Kit := preload("res://tests/editor/editor_kit.gd")
const ProbeCamera := preload("res://addons/lobelight/runtime/probes/probe_camera.gd")
const ProbeGizmo := preload("res://addons/lobelight/editor/gizmos/probe_gizmo.gd")

const SCENE := "res://probe_gizmo.tscn"
const PLACE := Vector3(4, -2, 7)
const TURN := Vector3(0.3, 1.1, -0.4)
const SIZE := Vector3(6, 3, 8)
const ORIGIN := Vector3(-1, 0.5, 1.5)
const ALL_PROPERTIES: Array[String] = ["size", "origin_offset", "position"]
# Of a pixel's coordinates, which are single floats, at 30 m.
const TOLERANCE := 1e-3

var _gizmo_plugin: ProbeGizmo
var _probe: LobeProbe3D
var _gizmo: EditorNode3DGizmo
var _camera: Camera3D


# An edited scene of a turned room with a probe in it that is selected, and a camera that sees it.
func before_test() -> void:
	_gizmo_plugin = Kit.get_plugin(get_tree()).get_probe_gizmo()
	var room := Node3D.new()
	room.name = "Room"
	var packed := PackedScene.new()
	packed.pack(room)
	room.free()
	ResourceSaver.save(packed, SCENE)
	EditorInterface.open_scene_from_path(SCENE)
	await await_idle_frame()
	var root: Node3D = EditorInterface.get_edited_scene_root()
	root.position = PLACE
	root.rotation = TURN
	_probe = LobeProbe3D.new()
	_probe.size = SIZE
	_probe.origin_offset = ORIGIN
	_probe.position = Vector3(1, 2, 3)
	_probe.rotation = Vector3(0, 0.5, 0)
	root.add_child(_probe)
	_probe.owner = root
	EditorInterface.get_selection().clear()
	EditorInterface.get_selection().add_node(_probe)
	await await_idle_frame()
	await await_idle_frame()
	for gizmo: EditorNode3DGizmo in _probe.get_gizmos():
		if gizmo.get_plugin() == _gizmo_plugin:
			_gizmo = gizmo
	var view := SubViewport.new()
	view.size = Vector2i(800, 600)
	_camera = Camera3D.new()
	view.add_child(_camera)
	add_child(view)
	_camera.look_at_from_position(_probe.get_box() * Vector3(9, 13, 17), _probe.global_position)


func after_test() -> void:
	_camera.get_parent().free()
	_gizmo = null
	EditorInterface.get_selection().clear()
	EditorInterface.close_scene()
	await await_idle_frame()
	DirAccess.remove_absolute(SCENE)


func _get_state() -> Array:
	return ALL_PROPERTIES.map(func(property: String) -> Variant: return _probe.get(property))


# Drags from where a handle is to a point of the probe's first axes, in some moves.
func _drag(id: int, target: Vector3, frame: Transform3D) -> void:
	_gizmo_plugin._begin_handle_action(_gizmo, id, false)
	for part: float in [0.2, 1.3, 1.0]:
		var point := _camera.unproject_position(frame * (target * part))
		_gizmo_plugin._set_handle(_gizmo, id, false, _camera, point)


func _commit(id: int, cancel := false) -> void:
	_gizmo_plugin._commit_handle(_gizmo, id, false, null, cancel)


func _assert_near(value: Vector3, wanted: Vector3) -> void:
	assert_vector(value).is_equal_approx(wanted, Vector3.ONE * TOLERANCE)


# Undo and redo bring back all of it, to the last bit.
func _assert_undone_and_redone(before: Array, after: Array) -> void:
	var history := Kit.get_history(_probe)
	for round in 2:
		assert_bool(history.undo()).is_true()
		assert_array(_get_state()).is_equal(before)
		assert_bool(history.redo()).is_true()
		assert_array(_get_state()).is_equal(after)


func test_a_probe_has_the_gizmo_and_handles_with_names() -> void:
	assert_object(_gizmo).is_not_null()
	var names: PackedStringArray = []
	for id in 9:
		names.append(_gizmo_plugin._get_handle_name(_gizmo, id, false))
	assert_str(", ".join(names)).is_equal(
		"Size X, Size X, Size Y, Size Y, Size Z, Size Z, Origin X, Origin Y, Origin Z"
	)
	assert_that(_gizmo_plugin._get_handle_value(_gizmo, 0, false)).is_equal(SIZE)
	assert_that(_gizmo_plugin._get_handle_value(_gizmo, 8, false)).is_equal(ORIGIN)


func test_each_face_moves_alone() -> void:
	for id in 6:
		var before := _get_state()
		var frame := _probe.get_box()
		@warning_ignore("integer_division")
		var axis := id / 2
		var outwards := -1.0 if id % 2 else 1.0
		var target := Vector3.ZERO
		target[axis] = outwards * (0.5 * SIZE[axis] + 1.25)
		_drag(id, target, frame)
		_commit(id)
		var wanted := SIZE
		wanted[axis] += 1.25
		_assert_near(_probe.size, wanted)
		var moved := frame.affine_inverse() * _probe.global_position
		_assert_near(moved, 0.5 * (target - target.normalized() * 0.5 * SIZE[axis]))
		# The opposite face is where it was.
		var opposite := Vector3.ZERO
		opposite[axis] = -0.5 * outwards
		_assert_near(_probe.get_box() * (opposite * _probe.size), frame * (opposite * SIZE))
		_assert_undone_and_redone(before, _get_state())
		Kit.get_history(_probe).undo()
		assert_array(_get_state()).is_equal(before)


func test_snapped_lengths_are_multiples_of_the_step() -> void:
	var before := AABB(-0.5 * SIZE, SIZE)
	for id in 6:
		@warning_ignore("integer_division")
		var axis := id / 2
		var outwards := -1.0 if id % 2 else 1.0
		for symmetric: bool in [false, true]:
			var box := BoxHandles.drag(SIZE, id, outwards * 4.37, symmetric, 0.5, 0.02)
			var exact := 2.0 * 4.37 if symmetric else 4.37 + 0.5 * SIZE[axis]
			assert_float(box.size[axis]).is_equal(roundf(2.0 * exact) / 2.0)
			if symmetric:
				assert_float(box.get_center()[axis]).is_equal(0.0)
			elif id % 2:
				assert_float(box.end[axis]).is_equal(before.end[axis])
			else:
				assert_float(box.position[axis]).is_equal(before.position[axis])


func test_with_alt_both_faces_move() -> void:
	_press_alt(true)
	for id in 6:
		var before := _get_state()
		@warning_ignore("integer_division")
		var axis := id / 2
		var target := Vector3.ZERO
		target[axis] = (-1.0 if id % 2 else 1.0) * 5.0
		_drag(id, target, _probe.get_box())
		_commit(id)
		var wanted := SIZE
		wanted[axis] = 10.0
		_assert_near(_probe.size, wanted)
		assert_vector(_probe.position).is_equal(before[2])
		_assert_undone_and_redone(before, _get_state())
		Kit.get_history(_probe).undo()
	_press_alt(false)


func _press_alt(pressed: bool) -> void:
	var event := InputEventKey.new()
	event.keycode = KEY_ALT
	event.pressed = pressed
	Input.parse_input_event(event)
	Input.flush_buffered_events()


# What is too small keeps a volume, and the capture point comes back with the size.
func test_a_face_dragged_through_the_opposite_one_and_undone() -> void:
	var before := _get_state()
	_drag(0, Vector3(-7, 0, 0), _probe.get_box())
	_commit(0)
	assert_float(_probe.size.x).is_equal_approx(LobeProbe3D.MIN_SIZE, 1e-6)
	assert_float(_probe.origin_offset.x).is_equal(0.0)
	_assert_undone_and_redone(before, _get_state())
	Kit.get_history(_probe).undo()
	# A box that was small only for a moment changes nothing else.
	_gizmo_plugin._begin_handle_action(_gizmo, 0, false)
	for x: float in [-7.0, 4.0]:
		var point := _camera.unproject_position(_probe.get_box() * Vector3(x, 0, 0))
		_gizmo_plugin._set_handle(_gizmo, 0, false, _camera, point)
	assert_vector(_probe.origin_offset).is_equal(ORIGIN)
	_commit(0, true)
	assert_array(_get_state()).is_equal(before)


func test_the_capture_point_moves_along_each_axis() -> void:
	for axis in 3:
		var before := _get_state()
		var handle := ORIGIN
		handle[axis] += 0.25
		var target := handle
		target[axis] -= 0.75
		var id := 6 + axis
		_gizmo_plugin._begin_handle_action(_gizmo, id, false)
		# Where nothing has been moved yet, nothing is.
		for place: Vector3 in [handle, target]:
			var point := _camera.unproject_position(_probe.get_box() * place)
			_gizmo_plugin._set_handle(_gizmo, id, false, _camera, point)
			var wanted := ORIGIN
			wanted[axis] = place[axis] - 0.25
			_assert_near(_probe.origin_offset, wanted)
		_commit(id)
		assert_vector(_probe.size).is_equal(SIZE)
		assert_vector(_probe.position).is_equal(before[2])
		_assert_undone_and_redone(before, _get_state())
		Kit.get_history(_probe).undo()


func test_the_capture_point_stays_in_the_box() -> void:
	_drag(6, Vector3(9, ORIGIN.y, ORIGIN.z), _probe.get_box())
	assert_float(_probe.origin_offset.x).is_equal_approx(0.5 * SIZE.x - 0.01, 1e-6)
	_commit(6, true)
	assert_vector(_probe.origin_offset).is_equal(ORIGIN)


func test_cancelling_restores_all_and_leaves_no_step() -> void:
	var history := Kit.get_history(_probe)
	var version := history.get_version()
	var before := _get_state()
	for id in 9:
		_drag(id, Vector3(1.1, 0.7, -2.3), _probe.get_box())
		_commit(id, true)
		assert_array(_get_state()).is_equal(before)
	# Nor does a click that moves nothing.
	_gizmo_plugin._begin_handle_action(_gizmo, 0, false)
	_commit(0)
	assert_int(history.get_version()).is_equal(version)


# Pure geometry: the place on the axis that is nearest to what the pixel shows, against a search.
func test_the_mouse_points_at_the_nearest_place_of_the_axis() -> void:
	var frame := _probe.get_box()
	for axis in 3:
		for point: Vector2 in [Vector2(100, 500), Vector2(420, 310), Vector2(700, 90)]:
			var found := BoxHandles.find_place(frame, ORIGIN, axis, _camera, point)
			var distance := _find_distance(axis, found, point)
			for step in 400:
				var other := _find_distance(axis, -20.0 + 0.1 * step, point)
				assert_float(distance).is_less_equal(other + 1e-3)


# From a place of the axis to what the camera shows at a pixel.
func _find_distance(axis: int, place: float, point: Vector2) -> float:
	var start := ORIGIN
	start[axis] = place
	start = _probe.get_box() * start
	var from := _camera.project_ray_origin(point)
	var to := from + 200.0 * _camera.project_ray_normal(point)
	return Geometry3D.get_closest_point_to_segment(start, from, to).distance_to(start)


# The edited scene's viewport has no camera of its own.
func test_the_editor_s_camera_counts_for_probes() -> void:
	var shown := EditorInterface.get_editor_viewport_3d(0).get_camera_3d()
	assert_object(ProbeCamera.find(_probe)).is_same(shown)
	# Not for those of the editor's own views.
	var other := LobeProbe3D.new()
	_camera.get_parent().add_child(other)
	_camera.current = true
	assert_object(ProbeCamera.find(other)).is_same(_camera)


func test_all_selected_probes_show_their_boxes() -> void:
	var other := LobeProbe3D.new()
	_probe.get_parent().add_child(other)
	other.owner = _probe.owner
	var selection := EditorInterface.get_selection()
	selection.add_node(other)
	await await_idle_frame()
	await await_idle_frame()
	assert_array(_gizmo_plugin._selected).contains_exactly([_probe, other])
	selection.clear()
	await await_idle_frame()
	await await_idle_frame()
	assert_array(_gizmo_plugin._selected).is_empty()
