extends Control
## The line between the two methods, with a handle to drag.

## It has been dragged to a place, in widths of the parent.
signal moved(to: float)

const Look := preload("look.gd")

var _is_dragged := false


func _ready() -> void:
	mouse_default_cursor_shape = Control.CURSOR_HSIZE
	size.x = Look.TOUCH


func _gui_input(event: InputEvent) -> void:
	var button := event as InputEventMouseButton
	var motion := event as InputEventMouseMotion
	if button != null and button.button_index == MOUSE_BUTTON_LEFT:
		_is_dragged = button.pressed
		queue_redraw()
	elif motion != null and _is_dragged:
		moved.emit((position.x + motion.position.x) / get_parent_area_size().x)


func _draw() -> void:
	var middle := 0.5 * size.x
	var colour := Look.ACCENT if _is_dragged else Look.TEXT
	draw_line(Vector2(middle, 0.0), Vector2(middle, size.y), Color(0.0, 0.0, 0.0, 0.35), 4.0)
	draw_line(Vector2(middle, 0.0), Vector2(middle, size.y), colour, 2.0)
	var handle := Vector2(middle, 0.5 * size.y)
	draw_circle(handle, 20.0, Look.PANEL, true, -1.0, true)
	draw_circle(handle, 20.0, colour, false, 2.0, true)
	for side: float in [-1.0, 1.0]:
		var tip := handle + Vector2(12.0 * side, 0.0)
		draw_polyline(
			[tip + Vector2(-6.0 * side, -6.0), tip, tip + Vector2(-6.0 * side, 6.0)],
			colour,
			2.0,
			true
		)
