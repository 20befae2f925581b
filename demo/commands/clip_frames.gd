extends "demo_command.gd"
## Draws the frames of the listing's clip: the camera goes to and fro, and in the second half a
## divider shows what the engine makes of the same materials. [code]clip.json[/code] says where the
## divider is in each frame.

const DemoRoot := preload("res://demo/demo.gd")
const Methods := preload("res://demo/methods.gd")
const PictureFile := preload("picture_file.gd")
const SIZE := Vector2i(640, 360)
const FRAMES := 60
## How far the camera goes to each side, in radians.
const SWING := 0.45
## Of the clip: when the divider begins to move, and when it is back; and how far it comes.
const DIVIDED := Vector2(0.4, 0.95)
const FURTHEST := 0.15
# Frames until the engine's own maps are there.
const _SETTLING := 8


func _work(out: String) -> void:
	var viewport := SubViewport.new()
	viewport.msaa_3d = Viewport.MSAA_4X
	# Without it Mobile keeps colours in ten bits, which end at 2.
	viewport.use_hdr_2d = true
	viewport.size = SIZE
	var demo: DemoRoot = _add_demo(viewport)
	var interface: CanvasLayer = demo.get_node("Interface")
	interface.hide()
	demo.right_method = Methods.Method.STOCK
	_arguments.fail_if(await demo.prepare_light())
	await process_frame
	for frame in _SETTLING:
		await _draw(viewport)
	var view := demo.camera.get_view()
	var middle := view.yaw
	var dividers: Array[float] = []
	var line := ProgressLine.new("drawing")
	for frame in FRAMES:
		if not _arguments.error.is_empty():
			return
		var time := float(frame) / FRAMES
		view.yaw = middle + SWING * sin(TAU * time)
		demo.camera.frame(view)
		demo.divider = _get_divider(time)
		dividers.append(demo.divider)
		# What follows the camera follows it in the next frame.
		for again in 2:
			await _draw(viewport)
		_arguments.fail_if(PictureFile.save(viewport, out.path_join("frame_%03d.png" % frame)))
		line.show((frame + 1.0) / FRAMES)
	line.finish()
	_arguments.fail_if(AtomicFile.save_json({"dividers": dividers}, out.path_join("clip.json")))


func _draw(viewport: SubViewport) -> void:
	viewport.render_target_update_mode = SubViewport.UPDATE_ONCE
	await RenderingServer.frame_post_draw


# From the right edge to the left and back, slow at both ends.
func _get_divider(time: float) -> float:
	var way := clampf((time - DIVIDED.x) / (DIVIDED.y - DIVIDED.x), 0.0, 1.0)
	return lerpf(1.0, FURTHEST, 0.5 - 0.5 * cos(TAU * way))
