extends SceneTree
## Draws the demo in each environment and saves the pictures: the second half of
## [code]./dev demo[/code].

const DemoScene := preload("res://demo/demo.tscn")
const DemoRoot := preload("res://demo/demo.gd")
const PictureFile := preload("res://demo/picture_file.gd")
const SIZE := Vector2i(1280, 720)

var _arguments := CommandLine.new("demo", ["out", "env", "json"])


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	var out := _arguments.path("out")
	_arguments.required("out")
	var pictures: Array[Dictionary] = []
	if _arguments.error.is_empty():
		pictures = await _draw(out)
	if _arguments.error.is_empty() and _arguments.has("json"):
		_arguments.fail_if(AtomicFile.save_json(pictures, _arguments.path("json")))
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
	quit(0 if _arguments.error.is_empty() else 1)


func _draw(out: String) -> Array[Dictionary]:
	var viewport := SubViewport.new()
	viewport.size = SIZE
	viewport.own_world_3d = true
	viewport.msaa_3d = Viewport.MSAA_4X
	# Without it Mobile keeps colours in ten bits, which end at 2.
	viewport.use_hdr_2d = true
	viewport.render_target_update_mode = SubViewport.UPDATE_DISABLED
	root.add_child(viewport)
	var demo: DemoRoot = DemoScene.instantiate()
	viewport.add_child(demo)
	(demo.get_node("Interface") as CanvasLayer).hide()
	if demo.missing_tables:
		_arguments.fail("%s: the table is missing." % demo.missing_tables[0])
		return []

	var pictures: Array[Dictionary] = []
	var line := ProgressLine.new("drawing")
	var wanted := _wanted_environments(demo.settings.size())
	for i in wanted.size():
		demo.environment_index = wanted[i]
		_arguments.fail_if(await demo.prepare_light())
		# The materials have the light from the next frame on; only then is it worth drawing.
		await process_frame
		viewport.render_target_update_mode = SubViewport.UPDATE_ONCE
		await RenderingServer.frame_post_draw
		line.show((i + 1.0) / wanted.size())
		pictures.append(_save(viewport, out, demo.settings[wanted[i]].title))
	line.finish()
	return pictures


func _wanted_environments(count: int) -> Array:
	if not _arguments.has("env"):
		return range(count)
	var number := _arguments.integer("env", 1, 1, count)
	return [number - 1] if _arguments.error.is_empty() else []


func _save(viewport: SubViewport, out: String, title: String) -> Dictionary:
	var renderer := RenderingServer.get_current_rendering_method()
	var path := out.path_join("%s_%s.png" % [title.to_lower(), renderer])
	_arguments.fail_if(PictureFile.save(viewport, path))
	return {"environment": title, "renderer": renderer, "picture": path}
