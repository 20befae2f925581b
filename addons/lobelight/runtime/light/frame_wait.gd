@tool
extends RefCounted
## What a coroutine awaits from frame to frame, drawn or not: it goes on while rendering is paused,
## and whoever keeps it can have it go on when there will be no more frames.

signal went_on


func _init() -> void:
	RenderingServer.frame_post_draw.connect(go_on)
	var tree := Engine.get_main_loop() as SceneTree
	if tree != null:
		tree.process_frame.connect(go_on)


func go_on() -> void:
	went_on.emit()


## Whether nothing is drawn, so that what waits for a frame would wait forever.
static func is_rendering_paused() -> bool:
	return not RenderingServer.render_loop_enabled or not DisplayServer.window_can_draw()
