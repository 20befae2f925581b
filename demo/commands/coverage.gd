extends "demo_command.gd"
## Counts what part of the demo's picture each of its surfaces covers, for `./dev demo --cost`:
## surfaces are drawn in plain colours, one each, and pixels counted.
##
## `--out FILE`: [code][{"layout", "width", "height", "shares": {surface: part}}][/code].

const DemoRoot := preload("res://demo/demo.gd")
const DemoObject := preload("res://demo/demo_object.gd")
## Of a Galaxy S4, halved; shares do not depend on it.
const SIZES: Dictionary[String, Vector2i] = {
	"landscape": Vector2i(960, 540),
	"portrait": Vector2i(540, 960),
}
const BACKDROP := "Backdrop"
## Soft shadows, which are drawn over the plinth.
const SHADOWS := "Shadows"

var _view := SubViewport.new()
var _demo: DemoRoot


func _work(out: String) -> void:
	_demo = _add_demo(_view)
	(_demo.get_node("Interface") as CanvasLayer).hide()
	_demo.camera.environment = _plain()
	var layouts: Array[Dictionary] = []
	for layout in SIZES:
		layouts.append(await _measure(layout))
	_arguments.fail_if(AtomicFile.save_json(layouts, out))


func _plain() -> Environment:
	var plain := Environment.new()
	plain.background_mode = Environment.BG_COLOR
	plain.background_color = Color.BLACK
	return plain


func _measure(layout: String) -> Dictionary:
	_view.size = SIZES[layout]
	var colours: Dictionary[int, String] = {}
	for node: MeshInstance3D in _demo.find_children("*", "MeshInstance3D", true, false):
		if node is DemoObject:
			# Corners of the colour cube come back as they are, in all renderers.
			var corner := colours.size() + 1
			colours[corner] = node.name
			node.material_override = _colour(_corner(corner))
		elif node.is_visible_in_tree():
			node.material_override = _colour(Color.BLACK)
	var shadows: Node3D = _demo.get_node("Shadows")
	shadows.hide()
	(_demo.get_node("Backdrop") as Node3D).hide()
	var shares := _count(await _draw(), colours)
	shadows.show()
	for object in shadows.get_children():
		(object as MeshInstance3D).material_override = _colour(Color.WHITE)
	for corner in colours:
		var surface: MeshInstance3D = _demo.find_child(colours[corner], true, false)
		surface.material_override = _colour(Color.BLACK)
	var white: Dictionary[int, String] = {7: SHADOWS}
	shares[SHADOWS] = _count(await _draw(), white)[SHADOWS]
	return {
		"layout": layout,
		"width": SIZES[layout].x,
		"height": SIZES[layout].y,
		"shares": shares,
	}


func _draw() -> Image:
	# Materials are compiled in the background.
	for frame in 3:
		_view.render_target_update_mode = SubViewport.UPDATE_ONCE
		await RenderingServer.frame_post_draw
	return _view.get_texture().get_image()


func _count(picture: Image, names: Dictionary[int, String]) -> Dictionary[String, float]:
	var counts: Dictionary[int, int] = {}
	for y in picture.get_height():
		for x in picture.get_width():
			var texel := picture.get_pixel(x, y)
			var corner := int(texel.r > 0.5) + 2 * int(texel.g > 0.5) + 4 * int(texel.b > 0.5)
			counts[corner] = counts.get(corner, 0) + 1
	var pixels := float(picture.get_width() * picture.get_height())
	var shares: Dictionary[String, float] = {}
	for corner in names:
		shares[names[corner]] = counts.get(corner, 0) / pixels
	shares[BACKDROP] = counts.get(0, 0) / pixels
	return shares


static func _corner(index: int) -> Color:
	return Color(index & 1, (index >> 1) & 1, (index >> 2) & 1)


static func _colour(colour: Color) -> StandardMaterial3D:
	var material := StandardMaterial3D.new()
	material.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	material.albedo_color = colour
	return material
