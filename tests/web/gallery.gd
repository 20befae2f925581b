extends Node
## Draws scenes at one size, one after the other, and prints each as [code]PICTURE NAME PNG[/code],
## the file in base64: in a browser as on a desktop. Arguments: the scenes' names, all of them if
## there are none; [code]--moved PIXELS[/code] moves pictures along both axes. Names nothing of the
## addon, so that exports keep what the scenes need.

const FOLDER := "res://tests/web/scenes/"
const SIZE := Vector2i(256, 192)
# Until captures have been read back, and what they reflect of each other has settled.
const FRAMES := 14
# Lights linger for some frames.
const FRAMES_BETWEEN := 4

var _moved := 0.0


func _ready() -> void:
	_draw.call_deferred()


func _draw() -> void:
	await get_tree().process_frame
	var names := OS.get_cmdline_user_args()
	var option := names.find("--moved")
	if option >= 0:
		_moved = names[option + 1].to_float()
		names = names.slice(0, option)
	for file in ResourceLoader.list_directory(FOLDER):
		if names.is_empty() or file.get_basename() in names:
			await _draw_scene(file)
	print("GALLERY DONE")
	if not OS.has_feature("web"):
		get_tree().quit()


func _draw_scene(file: String) -> void:
	var started := Time.get_ticks_msec()
	var view := SubViewport.new()
	view.size = SIZE
	view.render_target_update_mode = SubViewport.UPDATE_ONCE
	add_child(view)
	view.add_child((load(FOLDER + file) as PackedScene).instantiate())
	_move(view.get_camera_3d())
	for frame in FRAMES:
		await get_tree().process_frame
	# What is not looked at takes no time to draw.
	for frame in 2:
		view.render_target_update_mode = SubViewport.UPDATE_ONCE
		await RenderingServer.frame_post_draw
	var png := view.get_texture().get_image().save_png_to_buffer()
	print("PICTURE ", file.get_basename(), " ", Marshalls.raw_to_base64(png))
	print("TOOK ", file.get_basename(), " ", Time.get_ticks_msec() - started)
	view.queue_free()
	for frame in FRAMES_BETWEEN:
		await get_tree().process_frame


func _move(camera: Camera3D) -> void:
	if _moved != 0.0:
		var height := 2.0 * camera.near * tan(0.5 * deg_to_rad(camera.fov))
		var offset := Vector2.ONE * _moved * height / SIZE.y
		camera.set_frustum(height, offset, camera.near, camera.far)
