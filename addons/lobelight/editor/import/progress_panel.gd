@tool
extends Control
## A title, a bar, the time left and a button, drawn at once: where no frame goes by, controls would
## not draw themselves.

const _WIDTH := 380.0
const _MARGIN := 12.0

var title := ""

var _is_held := false
# Its own is the engine's before the window opens, whose font is of another size.
var _look := EditorInterface.get_editor_theme()


## As large as the font wants it.
func find_size() -> Vector2:
	var row := _get_row()
	return Vector2(_WIDTH * EditorInterface.get_editor_scale(), 4.5 * row + 2.0 * _get_margin())


func draw_now(fraction: float, text: String) -> void:
	var item := get_canvas_item()
	var margin := _get_margin()
	var row := _get_row()
	var width := size.x - 2.0 * margin
	RenderingServer.canvas_item_clear(item)
	_look.get_stylebox(&"panel", &"PopupPanel").draw(item, Rect2(Vector2.ZERO, size))
	_draw_text(title, Rect2(margin, margin, width, row), HORIZONTAL_ALIGNMENT_LEFT)
	var bar := Rect2(margin, margin + 1.2 * row, width, 0.8 * row)
	_look.get_stylebox(&"background", &"ProgressBar").draw(item, bar)
	bar.size.x *= clampf(fraction, 0.02, 1.0)
	_look.get_stylebox(&"fill", &"ProgressBar").draw(item, bar)
	_draw_text(text, Rect2(margin, margin + 2.1 * row, width, row), HORIZONTAL_ALIGNMENT_LEFT)
	var button := _find_button()
	_look.get_stylebox(&"pressed" if _is_held else &"normal", &"Button").draw(item, button)
	_draw_text("Cancel", button, HORIZONTAL_ALIGNMENT_CENTER)


## Whether an event of the window lets go of the button.
func is_cancelled_by(event: InputEvent) -> bool:
	var click := event as InputEventMouseButton
	if click == null or click.button_index != MOUSE_BUTTON_LEFT:
		return false
	var was_held := _is_held
	var is_inside := _find_button().has_point(click.position)
	_is_held = click.pressed and is_inside
	return was_held and is_inside and not click.pressed


func _find_button() -> Rect2:
	var row := _get_row()
	var extent := Vector2(6.0 * row, 1.2 * row)
	return Rect2(size - extent - Vector2.ONE * _get_margin(), extent)


func _draw_text(text: String, place: Rect2, alignment: HorizontalAlignment) -> void:
	var font := _look.get_font(&"font", &"Label")
	var font_size := _look.get_font_size(&"font_size", &"Label")
	var height := font.get_height(font_size)
	var start := place.position
	start.y += 0.5 * (place.size.y - height) + font.get_ascent(font_size)
	var color := _look.get_color(&"font_color", &"Label")
	font.draw_string(get_canvas_item(), start, text, alignment, place.size.x, font_size, color)


func _get_row() -> float:
	var font_size := _look.get_font_size(&"font_size", &"Label")
	return 1.25 * _look.get_font(&"font", &"Label").get_height(font_size)


func _get_margin() -> float:
	return _MARGIN * EditorInterface.get_editor_scale()
