extends SceneTree
## Two worlds with lights of their own, and then a light that is to fade: prints what their balls
## show, and the errors that there were.

const SIDE := 8
const VALUES: PackedFloat32Array = [0.25, 1.0]


class Errors:
	extends Logger
	var messages: PackedStringArray = []

	func _log_error(
		_function: String,
		_file: String,
		_line: int,
		code: String,
		rationale: String,
		_editor_notify: bool,
		_type: int,
		_backtraces: Array[ScriptBacktrace]
	) -> void:
		if "Lobelight" in rationale + code or "res://" in rationale + code:
			messages.append(rationale if rationale else code)


func _initialize() -> void:
	_run()


func _run() -> void:
	var errors := Errors.new()
	OS.add_logger(errors)
	await process_frame
	var material: Resource = (
		load("res://addons/lobelight/runtime/material/lobe_material_3d.gd").new()
	)
	material.table = load("res://addons/lobelight/runtime/table/lobe_table.gd").make_single_lobe(
		0.001
	)
	var views: Array[SubViewport] = []
	var lights: Array[Node] = []
	for i in 2:
		views.append(_make_view(material))
		root.add_child(views[i])
		lights.append(_make_light(VALUES[i]))
		views[i].add_child(lights[i])
		await _frames(4)
	var shown: Array[float] = []
	for view in views:
		shown.append(_look(view))
	lights[1].fade_time = 0.1
	lights[1].panorama = _constant(0.5)
	lights[0].panorama = _constant(2.0)
	# Compatibility reads back a face a frame.
	await _frames(9)
	for view in views:
		shown.append(_look(view))
	print("shown: ", JSON.stringify(shown))
	print("errors: ", JSON.stringify(errors.messages))
	for view in views:
		view.free()
	material = null
	await _frames(2)
	OS.remove_logger(errors)
	quit()


func _make_view(material: Material) -> SubViewport:
	var view := SubViewport.new()
	view.own_world_3d = true
	view.size = Vector2i(SIDE, SIDE)
	view.use_hdr_2d = true
	view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	var camera := Camera3D.new()
	camera.set_orthogonal(2.0, 0.1, 10.0)
	camera.position.z = 4.0
	camera.environment = Environment.new()
	camera.environment.background_mode = Environment.BG_COLOR
	view.add_child(camera)
	var ball := MeshInstance3D.new()
	ball.mesh = SphereMesh.new()
	ball.mesh.material = material
	ball.scale = 2.0 * Vector3.ONE
	view.add_child(ball)
	return view


func _make_light(value: float) -> Node:
	var light: Node = (
		load("res://addons/lobelight/runtime/light/lobe_environment_3d.gd").new() as Node
	)
	light.panorama = _constant(value)
	light.size = 8
	return light


func _constant(value: float) -> ImageTexture:
	var image := Image.create_empty(8, 4, false, Image.FORMAT_RGBAF)
	image.fill(Color(value, value, value))
	return ImageTexture.create_from_image(image)


# What the middle of the ball shows, in linear light.
func _look(view: SubViewport) -> float:
	@warning_ignore("integer_division")
	var value := view.get_texture().get_image().get_pixel(SIDE / 2, SIDE / 2).g
	if RenderingServer.get_current_rendering_method() == "gl_compatibility":
		value = pow((value + 0.055) / 1.055, 2.4)
	return snappedf(value, 0.01)


func _frames(count: int) -> void:
	for i in count:
		await RenderingServer.frame_post_draw
