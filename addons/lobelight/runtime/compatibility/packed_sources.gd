@tool
extends "../pyramid/handed_sources.gd"
## Sources that are read back, as the faces of the pyramid are, and with these: Compatibility.

const CanvasPass := preload("../pyramid/canvas_pass.gd")
const PackShader := preload("source_pack.gdshader")

var _drawn: CanvasPass
var _answer := Answer.UNKNOWN


func _init(found: CanvasPass, old: Texture2D = null) -> void:
	texture = old as ImageTexture if old != null else ImageTexture.new()
	# Two pixels a texel.
	var extent := Vector2i(2 * EXTENT.x, EXTENT.y)
	_drawn = CanvasPass.new(extent, false)
	var parameters: Dictionary[StringName, Variant] = {&"found_sources": found.get_texture()}
	_drawn.add_rect(Rect2i(Vector2i.ZERO, extent), PackShader, parameters)


func draw() -> void:
	_drawn.draw()


func receive() -> void:
	var image := RenderingServer.texture_2d_get(_drawn.get_texture())
	# What could not be read says nothing: the last sources stay.
	if image == null or image.get_format() != Image.FORMAT_RGBA8:
		return
	var data := image.get_data()
	_answer = find_answer(data)
	var sources := Image.create_from_data(EXTENT.x, EXTENT.y, false, Image.FORMAT_RGBAH, data)
	var shown: ImageTexture = texture
	if shown.get_width() == 0:
		shown.set_image(sources)
	else:
		shown.update(sources)


func awaits_answer() -> bool:
	return false


func take_answer() -> Answer:
	var answer := _answer
	_answer = Answer.UNKNOWN
	return answer


func get_viewports() -> Array[RID]:
	return [_drawn.viewport]
