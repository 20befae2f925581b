@tool
extends "walk.gd"
## From an empty room to one that is lit by a probe. The room and a chrome ball are there; the rest
## is done by clicks.

const SCENE := "res://room.tscn"
const SIZE := Vector3(6, 3, 8)
const BALL := Vector3(1.2, -0.7, 1.0)
# The second one, and where its number is in a mask's grid.
const _BALL_LAYER := 2
const _BALL_CELL := Vector2(42.0, 19.0)
const _MOST_TURNS := 40
# Of the ball in the last picture, in pixels.
const _RADIUS := 110.0


func go() -> void:
	await _enable()
	await _close_settings()
	# The page begins with the addon enabled.
	_mouse.clicks = 0
	await _mouse.wait(3.0)
	await _open_room()
	var tree: Tree = Finder.of_class(Finder.of_class(_root, "SceneTreeEditor"), "Tree")
	await _mouse.choose_item(tree, tree.get_root(), 0, "the root")
	await _add_node("LobeP")
	var probe: LobeProbe3D = EditorInterface.get_edited_scene_root().find_child("LobeProbe3D")
	_expect(probe != null, "node")
	if probe == null:
		return
	await _zoom_out(probe)
	await _take.call("room_1_probe")
	for axis in 3:
		await _drag_to_wall(probe, axis)
	_expect(probe.size.distance_to(SIZE) < 0.2, "box of the room's size, but %s" % probe.size)
	await _mouse.wait(1.0)
	await _take.call("room_2_box")
	await _leave_ball_out(probe)
	var panel := Finder.of_script(EditorInterface.get_inspector(), "light_panel.gd")
	await _mouse.scroll_to(EditorInterface.get_inspector(), Finder.button(panel, "Bake Light"))
	await _mouse.click(Finder.button(panel, "Bake Light"), "Bake Light")
	for turn in _MOST_TURNS:
		await _mouse.wait(0.25)
		if probe.light != null:
			break
	_expect(probe.light != null, "baked light")
	await _mouse.wait(1.0)
	await _take.call("room_3_baked")
	await _look_at_ball()
	await _take.call("room_4_ball")


# Walls that only show from inside, so that the camera looks into the room.
func _open_room() -> void:
	var root := Node3D.new()
	root.name = "Room"
	var colours: Array[Color] = [
		Color(0.8, 0.25, 0.2),
		Color(0.2, 0.5, 0.25),
		Color(0.75, 0.72, 0.65),
		Color(0.45, 0.3, 0.2),
		Color(0.25, 0.35, 0.7),
		Color(0.8, 0.7, 0.3),
	]
	for face in 6:
		@warning_ignore("integer_division")
		var axis := face / 2
		var inwards := Vector3.ZERO
		inwards[axis] = -1.0 if face % 2 == 0 else 1.0
		var wall := MeshInstance3D.new()
		wall.name = "Wall%d" % (face + 1)
		var quad := QuadMesh.new()
		var up := Vector3.UP if axis != 1 else Vector3.BACK
		wall.basis = Basis.looking_at(-inwards, up)
		quad.size = Vector2((wall.basis.x * SIZE).length(), (wall.basis.y * SIZE).length())
		wall.position = -0.5 * SIZE * inwards
		var paint := StandardMaterial3D.new()
		paint.albedo_color = colours[face]
		quad.material = paint
		wall.mesh = quad
		_add(root, wall)
	# With one of its own, the editor adds no sun and no sky.
	var world := WorldEnvironment.new()
	world.name = "World"
	world.environment = Environment.new()
	world.environment.background_mode = Environment.BG_COLOR
	world.environment.background_color = Color(0.05, 0.06, 0.08)
	world.environment.ambient_light_source = Environment.AMBIENT_SOURCE_COLOR
	world.environment.ambient_light_color = Color.WHITE
	world.environment.ambient_light_energy = 0.25
	_add(root, world)
	var lamp := OmniLight3D.new()
	lamp.name = "Lamp"
	lamp.position = Vector3(-1, 1, -1)
	lamp.omni_range = 12.0
	lamp.light_energy = 1.5
	lamp.light_size = 0.2
	_add(root, lamp)
	var ball := MeshInstance3D.new()
	ball.name = "Ball"
	ball.mesh = SphereMesh.new()
	ball.scale = 1.4 * Vector3.ONE
	ball.position = BALL
	var chrome := LobeMaterial3D.new()
	chrome.metallic = 1.0
	chrome.roughness = 0.2
	ball.material_override = chrome
	ball.layers = _BALL_LAYER
	_add(root, ball)
	var packed := PackedScene.new()
	packed.pack(root)
	root.free()
	ResourceSaver.save(packed, SCENE)
	EditorInterface.open_scene_from_path(SCENE)
	EditorInterface.set_main_screen_editor("3D")
	await _mouse.wait(2.0)


func _add(root: Node3D, node: Node) -> void:
	root.add_child(node)
	node.owner = root


# The wheel over the 3D view, until the handles of the new box are in it.
func _zoom_out(probe: LobeProbe3D) -> void:
	var view := _find_view()
	var place := _mouse.find_rect(view).get_center()
	await _mouse.move(place)
	for turn in _MOST_TURNS:
		if _sees(probe, 0) and _sees(probe, 2) and _sees(probe, 4):
			return
		await _mouse.turn_wheel(MOUSE_BUTTON_WHEEL_DOWN)
	_mouse.fail("the handles do not come into view")


# Until it is large.
func _look_at_ball() -> void:
	EditorInterface.edit_node(EditorInterface.get_edited_scene_root().get_node("Ball"))
	await _mouse.move(_mouse.find_rect(_find_view()).get_center())
	await _mouse.type("f")
	EditorInterface.get_selection().clear()
	for turn in _MOST_TURNS:
		if _find_place(BALL).distance_to(_find_place(BALL + 0.7 * Vector3.UP)) > _RADIUS:
			break
		await _mouse.turn_wheel(MOUSE_BUTTON_WHEEL_UP)
	await _mouse.wait(1.0)


# Which handle of an axis is in the view: the one of its positive end first.
func _sees(probe: LobeProbe3D, id: int) -> bool:
	var rect := _mouse.find_rect(_find_view()).grow(-30.0)
	return rect.has_point(_find_place(probe.get_box() * _get_handle(probe, id)))


func _get_handle(probe: LobeProbe3D, id: int) -> Vector3:
	var place := Vector3.ZERO
	@warning_ignore("integer_division")
	var axis := id / 2
	place[axis] = 0.5 * probe.size[axis] * (-1.0 if id % 2 else 1.0)
	return place


# With Alt the opposite face comes along.
func _drag_to_wall(probe: LobeProbe3D, axis: int) -> void:
	var from := _find_place(probe.get_box() * _get_handle(probe, 2 * axis))
	var wall := Vector3.ZERO
	wall[axis] = 0.5 * SIZE[axis]
	_mouse.hold(KEY_ALT, true)
	await _mouse.drag_from(from, _find_place(wall) - from, "the handle %s" % "XYZ"[axis])
	_mouse.hold(KEY_ALT, false)


# What is on the ball's layer is not captured: the ball would mirror itself.
func _leave_ball_out(probe: LobeProbe3D) -> void:
	var property := Finder.property(&"cull_mask")
	await _mouse.scroll_to(EditorInterface.get_inspector(), property)
	var grid := Finder.of_class(property, "EditorPropertyLayersGrid") as Control
	var place := _mouse.find_rect(grid).position + _BALL_CELL
	await _mouse.click_at(place, grid, "layer 2")
	_expect(probe.cull_mask & _BALL_LAYER == 0, "mask without the ball")


func _find_view() -> Control:
	return EditorInterface.get_editor_viewport_3d(0).get_parent() as Control


# Of a place in the scene, where it is in the window.
func _find_place(place: Vector3) -> Vector2:
	var camera := EditorInterface.get_editor_viewport_3d(0).get_camera_3d()
	return _mouse.find_rect(_find_view()).position + camera.unproject_position(place)
