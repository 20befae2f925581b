@tool
extends Control
## Base of the plots in the inspector: colours, font and sizes are the editor's.

## Width and height at the editor's scale 1.
const SIZE := Vector2(150.0, 150.0)

## What is drawn above the plot.
var title := ""


func _init() -> void:
	size_flags_horizontal = SIZE_EXPAND_FILL
	mouse_filter = Control.MOUSE_FILTER_PASS


func _enter_tree() -> void:
	custom_minimum_size = SIZE * EditorInterface.get_editor_scale()


## Pixels of the screen for one at the editor's scale 1.
static func scaled(pixels: float) -> float:
	return pixels * EditorInterface.get_editor_scale()


func get_ink() -> Color:
	return get_theme_color(&"font_color", &"Label")


## For what is behind the curves: axes, circles.
func get_faint() -> Color:
	return Color(get_ink(), 0.25)


## For figures beside the curves.
func get_pale() -> Color:
	return Color(get_ink(), 0.7)


func get_accent() -> Color:
	return get_theme_color(&"accent_color", &"Editor")


## The place for the plot below its title.
func get_area() -> Rect2:
	var margin := scaled(4.0)
	var top := get_line_height() + margin
	return Rect2(margin, top, size.x - 2.0 * margin, size.y - top - margin)


func get_line_height() -> float:
	return get_theme_font(&"font", &"Label").get_height(_font_size())


func draw_title() -> void:
	draw_text(Vector2(scaled(4.0), 0.0), title, get_ink())


## One line of text with its upper left corner at [param at].
func draw_text(at: Vector2, text: String, color: Color) -> void:
	var font := get_theme_font(&"font", &"Label")
	var base := at + Vector2(0.0, font.get_ascent(_font_size()))
	var width := maxf(size.x - at.x, 1.0)
	draw_string(font, base, text, HORIZONTAL_ALIGNMENT_LEFT, width, _font_size(), color)


## One line of text that ends at [param at], its upper right corner.
func draw_text_left_of(at: Vector2, text: String, color: Color) -> void:
	var font := get_theme_font(&"font", &"Label")
	var width := font.get_string_size(text, HORIZONTAL_ALIGNMENT_LEFT, -1, _font_size()).x
	draw_text(at - Vector2(width, 0.0), text, color)


func _font_size() -> int:
	return roundi(0.85 * get_theme_font_size(&"font_size", &"Label"))
