extends Object
## How the controls look: dark with one accent, large enough for a finger.

## The least height of what is touched, in units of the interface.
const TOUCH := 44.0
const ACCENT := Color(1.0, 0.74, 0.36)
const TEXT := Color(0.93, 0.94, 0.96)
# All are opaque: they lie on bright pictures too, and glass blends otherwise where 2D is linear.
const PANEL := Color(0.05, 0.055, 0.07)
const _FIELD := Color(0.17, 0.18, 0.2)
const _HOVER := Color(0.26, 0.27, 0.3)


static func make_theme() -> Theme:
	var theme := Theme.new()
	theme.default_font_size = 15
	theme.set_stylebox(&"panel", &"PanelContainer", make_box(PANEL, 14, 12))
	for type: StringName in [&"Button", &"OptionButton", &"CheckButton"]:
		theme.set_stylebox(&"normal", type, make_box(_FIELD, 8, 10))
		theme.set_stylebox(&"hover", type, make_box(_HOVER, 8, 10))
		theme.set_stylebox(&"pressed", type, make_box(_HOVER, 8, 10))
		theme.set_stylebox(&"hover_pressed", type, make_box(_HOVER, 8, 10))
		theme.set_stylebox(&"disabled", type, make_box(Color(0.11, 0.115, 0.13), 8, 10))
		theme.set_stylebox(&"focus", type, _make_frame())
		theme.set_color(&"font_color", type, TEXT)
		theme.set_color(&"font_pressed_color", type, ACCENT)
		theme.set_color(&"font_hover_pressed_color", type, ACCENT)
	theme.set_color(&"font_color", &"Label", TEXT)
	theme.set_constant(&"v_separation", &"PopupMenu", 16)
	theme.set_font_size(&"font_size", &"PopupMenu", 16)
	theme.set_stylebox(&"panel", &"PopupMenu", make_box(Color(0.09, 0.1, 0.12), 8, 8))
	theme.set_stylebox(&"slider", &"HSlider", _make_bar(Color(1.0, 1.0, 1.0, 0.2)))
	theme.set_stylebox(&"grabber_area", &"HSlider", _make_bar(ACCENT))
	theme.set_stylebox(&"grabber_area_highlight", &"HSlider", _make_bar(ACCENT))
	var knob := _make_knob(22, TEXT)
	theme.set_icon(&"grabber", &"HSlider", knob)
	theme.set_icon(&"grabber_highlight", &"HSlider", _make_knob(22, ACCENT))
	theme.set_icon(&"grabber_disabled", &"HSlider", knob)
	return theme


## A rounded box; [param margin] is left free inside.
static func make_box(colour: Color, radius: int, margin: int) -> StyleBoxFlat:
	var box := StyleBoxFlat.new()
	box.bg_color = colour
	box.set_corner_radius_all(radius)
	box.set_content_margin_all(margin)
	box.content_margin_top = 0.6 * margin
	box.content_margin_bottom = 0.6 * margin
	return box


static func _make_frame() -> StyleBoxFlat:
	var box := StyleBoxFlat.new()
	box.draw_center = false
	box.border_color = Color(ACCENT, 0.8)
	box.set_border_width_all(2)
	box.set_corner_radius_all(8)
	return box


static func _make_bar(colour: Color) -> StyleBoxFlat:
	var box := StyleBoxFlat.new()
	box.bg_color = colour
	box.set_corner_radius_all(3)
	box.content_margin_top = 2.0
	box.content_margin_bottom = 2.0
	return box


static func _make_knob(size: int, colour: Color) -> ImageTexture:
	var image := Image.create_empty(size, size, false, Image.FORMAT_RGBA8)
	var middle := 0.5 * (size - 1)
	for y in size:
		for x in size:
			var away := Vector2(x - middle, y - middle).length()
			image.set_pixel(x, y, Color(colour, clampf(0.5 * size - away, 0.0, 1.0)))
	return ImageTexture.create_from_image(image)
