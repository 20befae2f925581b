extends "demo_command.gd"
## Draws the demo and saves the pictures: the second half of [code]./dev demo[/code], and all of
## [code]./dev demo --pictures[/code].

const DemoRoot := preload("res://demo/demo.gd")
const Interface := preload("res://demo/interface/interface.gd")
const Methods := preload("res://demo/methods.gd")
const PictureFile := preload("picture_file.gd")
const LANDSCAPE := Vector2i(1280, 720)
const PORTRAIT := Vector2i(720, 1280)
## Pixels of a unit of the interface in portrait, as a phone's density has them.
const PORTRAIT_SCALE := 1.75
const METHODS: Dictionary[int, String] = {
	Methods.Method.OURS: "lobelight",
	Methods.Method.THESIS: "thesis",
	Methods.Method.SAMPLES: "fis",
	Methods.Method.STOCK: "stock",
}
## The right half's method with the controls, by environment.
const COMPARED: Array[int] = [
	Methods.Method.SAMPLES, Methods.Method.STOCK, Methods.Method.THESIS, Methods.Method.STOCK
]
# Frames until the engine's own maps are there.
const _SETTLING := 6


## What one picture shows.
class Picture:
	extends RefCounted
	var size := LANDSCAPE
	var environment := 0
	var left := Methods.Method.OURS as int
	var right := Methods.NONE
	var divider := 0.5
	var has_interface := false

	func get_name(title: String) -> String:
		var words: PackedStringArray = [title.to_lower().get_slice(",", 0)]
		words.append("landscape" if size.x > size.y else "portrait")
		words.append(METHODS[left])
		if right != Methods.NONE:
			words.append(METHODS[right])
		if has_interface:
			words.append("interface")
		return "_".join(words)


var _viewport := SubViewport.new()
var _demo: DemoRoot


func _own_options() -> PackedStringArray:
	return ["env", "json", "all"]


func _work(out: String) -> void:
	var pictures := await _draw_all(out)
	if _arguments.error.is_empty() and _arguments.has("json"):
		_arguments.fail_if(AtomicFile.save_json(pictures, _arguments.path("json")))


func _draw_all(out: String) -> Array[Dictionary]:
	_viewport.msaa_3d = Viewport.MSAA_4X
	# Without it Mobile keeps colours in ten bits, which end at 2.
	_viewport.use_hdr_2d = true
	_viewport.size = LANDSCAPE
	_demo = _add_demo(_viewport)

	var pictures: Array[Dictionary] = []
	var line := ProgressLine.new("drawing")
	var plan := _plan_all() if _arguments.has("all") else _plan_environments()
	for picture in plan:
		if not _arguments.error.is_empty():
			break
		await _draw(picture)
		pictures.append(_save(picture, out))
		line.show(float(pictures.size()) / plan.size())
	line.finish()
	return pictures


# Each panorama, as it is at the start.
func _plan_environments() -> Array[Picture]:
	var plan: Array[Picture] = []
	for index in _wanted_environments():
		var picture := Picture.new()
		picture.environment = index
		plan.append(picture)
	return plan


# Every environment by every method, and with the controls, in both formats.
func _plan_all() -> Array[Picture]:
	var plan: Array[Picture] = []
	for index in _demo.settings.size():
		for size: Vector2i in [LANDSCAPE, PORTRAIT]:
			for method: int in METHODS:
				if _demo.settings[index].is_interior and not Methods.has_rooms(method):
					continue
				var picture := Picture.new()
				picture.environment = index
				picture.size = size
				picture.left = method
				plan.append(picture)
			var compared := Picture.new()
			compared.environment = index
			compared.size = size
			compared.right = COMPARED[index]
			compared.divider = 0.37 if size == LANDSCAPE else 0.5
			compared.has_interface = true
			plan.append(compared)
	return plan


func _wanted_environments() -> Array[int]:
	var panoramas: Array[int] = []
	for index in _demo.settings.size():
		if _demo.settings[index].panorama != null:
			panoramas.append(index)
	if not _arguments.has("env"):
		return panoramas
	var number := _arguments.integer("env", 1, 1, panoramas.size())
	return (
		panoramas.slice(number - 1, number)
		if _arguments.error.is_empty()
		else panoramas.slice(0, 0)
	)


func _draw(picture: Picture) -> void:
	_viewport.size = picture.size
	var interface: Interface = _demo.get_node("Interface")
	interface.ui_scale = PORTRAIT_SCALE if picture.size == PORTRAIT else 1.0
	interface.visible = picture.has_interface
	# A still picture has none.
	interface.shows_times = false
	if _demo.environment_index != picture.environment:
		_demo.environment_index = picture.environment
	_demo.left_method = picture.left
	_demo.right_method = picture.right
	_demo.divider = picture.divider
	if _demo.missing_tables:
		_arguments.fail("%s: the set of tables is missing." % _demo.missing_tables[0])
		return
	_arguments.fail_if(await _demo.prepare_light())
	# The materials have the light from the next frame on; only then is it worth drawing.
	await process_frame
	var frames := _SETTLING if _demo.shows(Methods.Method.STOCK) else 1
	for frame in frames:
		_viewport.render_target_update_mode = SubViewport.UPDATE_ONCE
		await RenderingServer.frame_post_draw


func _save(picture: Picture, out: String) -> Dictionary:
	var renderer := RenderingServer.get_current_rendering_method()
	var title := _demo.settings[picture.environment].title
	var name := picture.get_name(title) if _arguments.has("all") else title.to_lower()
	var path := out.path_join("%s_%s.png" % [name, renderer])
	_arguments.fail_if(PictureFile.save(_viewport, path))
	return {"environment": title, "renderer": renderer, "picture": path}
