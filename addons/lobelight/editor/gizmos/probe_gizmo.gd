@tool
extends EditorNode3DGizmoPlugin
## What the 3D view shows of [LobeProbe3D]s: an icon, and of selected ones the box, a fainter box
## where the light has faded, and the capture point. Six handles move the box's faces, as those of a
## ReflectionProbe do: the opposite face stays, with Alt it mirrors the dragged one. Three more move
## the capture point.

const BoxHandles := preload("box_handles.gd")
const IconFile := preload("../icon_file.gd")

const _NAME := "LobeProbe3D"
const _COLOR_SETTING := "editors/3d_gizmos/gizmo_colors/reflection_probe"
const _FAINT := 0.3
const _ICON := "lobe_probe_3d"
const _ICON_MAGNIFICATION := 8.0
const _ICON_SCALE := 0.05
# The first handle of the capture point, and how far from it its handles are.
const _ORIGIN := 6
const _ARM := 0.25

var _undo_redo: EditorUndoRedoManager
var _selected: Array[LobeProbe3D] = []
# Of the probe whose handle is dragged, as it was before.
var _start := {}
var _frame: Transform3D


func _init(undo_redo: EditorUndoRedoManager = null) -> void:
	_undo_redo = undo_redo
	var color: Color = EditorInterface.get_editor_settings().get_setting(_COLOR_SETTING)
	create_material("box", color)
	create_material("faded", Color(color, color.a * _FAINT))
	create_icon_material("icon", IconFile.draw(_ICON, _ICON_MAGNIFICATION))
	create_handle_material("handles")
	EditorInterface.get_selection().selection_changed.connect(_on_selection_changed)


func _has_gizmo(node: Node3D) -> bool:
	return node is LobeProbe3D


func _get_gizmo_name() -> String:
	return _NAME


func _get_priority() -> int:
	return -1


func _redraw(gizmo: EditorNode3DGizmo) -> void:
	gizmo.clear()
	var probe := gizmo.get_node_3d() as LobeProbe3D
	if probe in EditorInterface.get_selection().get_selected_nodes():
		var box := probe.get_aabb()
		var lines := _get_edges(box)
		var handles := BoxHandles.get_places(probe.size)
		for axis in 3:
			var arm := Vector3.ZERO
			arm[axis] = _ARM
			lines.append(probe.origin_offset - arm)
			lines.append(probe.origin_offset + arm)
			handles.append(probe.origin_offset + arm)
		gizmo.add_lines(lines, get_material("box", gizmo))
		if probe.blend_distance > 0.0:
			var faded := _get_edges(box.grow(probe.blend_distance))
			gizmo.add_lines(faded, get_material("faded", gizmo))
		gizmo.add_handles(handles, get_material("handles", gizmo), [])
	gizmo.add_unscaled_billboard(get_material("icon", gizmo), _ICON_SCALE)


func _get_handle_name(_gizmo: EditorNode3DGizmo, id: int, _secondary: bool) -> String:
	if id < _ORIGIN:
		return BoxHandles.get_handle_name(id)
	return "Origin " + "XYZ"[id - _ORIGIN]


# What the 3D view says while the handle is dragged.
func _get_handle_value(gizmo: EditorNode3DGizmo, id: int, _secondary: bool) -> Variant:
	var probe := gizmo.get_node_3d() as LobeProbe3D
	return probe.size if id < _ORIGIN else probe.origin_offset


func _begin_handle_action(gizmo: EditorNode3DGizmo, _id: int, _secondary: bool) -> void:
	var probe := gizmo.get_node_3d() as LobeProbe3D
	_start = _get_state(probe)
	_frame = probe.get_box()


func _set_handle(
	gizmo: EditorNode3DGizmo, id: int, _secondary: bool, camera: Camera3D, point: Vector2
) -> void:
	var probe := gizmo.get_node_3d() as LobeProbe3D
	var step := 0.0
	if EditorInterface.is_node_3d_snap_enabled():
		step = EditorInterface.get_node_3d_translate_snap()
	if id < _ORIGIN:
		@warning_ignore("integer_division")
		var place := BoxHandles.find_place(_frame, Vector3.ZERO, id / 2, camera, point)
		var symmetric := Input.is_key_pressed(KEY_ALT)
		var size: Vector3 = _start["size"]
		var box := BoxHandles.drag(size, id, place, symmetric, step, LobeProbe3D.MIN_SIZE)
		probe.size = box.size
		# A box that was smaller for a moment has moved the capture point.
		probe.origin_offset = _start["origin_offset"]
		if symmetric:
			probe.position = _start["position"]
		else:
			probe.global_position = _frame * box.get_center()
		return
	var axis := id - _ORIGIN
	var origin: Vector3 = _start["origin_offset"]
	var place := BoxHandles.find_place(_frame, origin, axis, camera, point) - _ARM
	origin[axis] = snappedf(place, step) if step > 0.0 else place
	probe.origin_offset = origin


func _commit_handle(
	gizmo: EditorNode3DGizmo, id: int, _secondary: bool, _restore: Variant, cancel: bool
) -> void:
	var probe := gizmo.get_node_3d() as LobeProbe3D
	var end := _get_state(probe)
	if cancel:
		for property: String in _start:
			probe.set(property, _start[property])
		return
	if end == _start:
		return
	_undo_redo.create_action(
		"Change Probe Size" if id < _ORIGIN else "Change Probe Origin Offset",
		UndoRedo.MERGE_DISABLE,
		probe
	)
	for property: String in end:
		_undo_redo.add_do_property(probe, property, end[property])
		_undo_redo.add_undo_property(probe, property, _start[property])
	_undo_redo.commit_action()


# In the order in which they are to be set: the size limits the capture point.
static func _get_state(probe: LobeProbe3D) -> Dictionary:
	return {"size": probe.size, "origin_offset": probe.origin_offset, "position": probe.position}


static func _get_edges(box: AABB) -> PackedVector3Array:
	var lines: PackedVector3Array = []
	for corner in 8:
		# Bit 2 of a corner's number is its end in x, bit 1 in y and bit 0 in z.
		for bit: int in [1, 2, 4]:
			if corner & bit == 0:
				lines.append(box.get_endpoint(corner))
				lines.append(box.get_endpoint(corner | bit))
	return lines


# The engine has only the one node drawn anew that its inspector shows.
func _on_selection_changed() -> void:
	var before := _selected
	_selected = []
	for node in EditorInterface.get_selection().get_selected_nodes():
		if node is LobeProbe3D:
			_selected.append(node)
	for probe: Variant in before + _selected:
		if is_instance_valid(probe):
			(probe as LobeProbe3D).update_gizmos()
