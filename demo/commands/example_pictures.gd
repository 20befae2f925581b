extends "demo_command.gd"
## Draws each scene of demo/examples: tools/guide/examples.sh. [code]--only NAME[/code] draws one.
##
## An example that changes by itself has a method [code]pose[/code], which puts it as it is to be
## shown and may be a coroutine.

const PictureFile := preload("picture_file.gd")
const FOLDER := "res://demo/examples"
const SIZE := Vector2i(640, 360)
# Until captures are there: before, nothing is drawn, which takes its time in software.
const _SETTLING := 12


func _own_options() -> PackedStringArray:
	return ["only"]


func _work(out: String) -> void:
	for example_name in DirAccess.get_directories_at(FOLDER):
		if _arguments.has("only") and _arguments.text("only") != example_name:
			continue
		_arguments.fail_if(await _draw(example_name, out))


func _draw(example_name: String, out: String) -> String:
	var view := SubViewport.new()
	view.size = SIZE
	view.own_world_3d = true
	view.msaa_3d = Viewport.MSAA_4X
	view.use_hdr_2d = true
	view.render_target_update_mode = SubViewport.UPDATE_DISABLED
	root.add_child(view)
	var scene: PackedScene = load("%s/%s/%s.tscn" % [FOLDER, example_name, example_name])
	var example := scene.instantiate()
	view.add_child(example)
	for frame in _SETTLING:
		await process_frame
	if example.has_method(&"pose"):
		await example.call(&"pose")
		for frame in _SETTLING:
			await process_frame
	# The engine's own maps are of the frame before.
	for frame in 2:
		view.render_target_update_mode = SubViewport.UPDATE_ONCE
		await RenderingServer.frame_post_draw
	var problem := PictureFile.save(view, out.path_join(example_name + ".png"))
	view.free()
	for frame in 3:
		await process_frame
	return problem
