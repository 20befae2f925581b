@tool
extends "plot.gd"
## The first view's mean log-likelihood over the iterations of the fit.

var _curve: PackedFloat32Array = []


func _init() -> void:
	super()
	title = "Log-likelihood"
	tooltip_text = (
		"Of the view along the normal, the first to be fitted, after each iteration, in nats. It "
		+ "rises until the fit stops."
	)


func show_curve(curve: PackedFloat32Array) -> void:
	_curve = curve
	queue_redraw()


func _draw() -> void:
	draw_title()
	var area := get_area()
	if _curve.size() < 2:
		draw_text(area.position, "Bake the table to see it.", get_pale())
		return
	var text := get_pale()
	var least: float = Array(_curve).min()
	var span := maxf(Array(_curve).max() - least, 1e-9)
	var plot := Rect2(area.position, area.size - Vector2(0.0, get_line_height()))
	draw_line(plot.position, Vector2(plot.position.x, plot.end.y), get_faint(), scaled(1.0))
	draw_line(Vector2(plot.position.x, plot.end.y), plot.end, get_faint(), scaled(1.0))
	var points: PackedVector2Array = []
	for n in _curve.size():
		var place := Vector2(float(n) / (_curve.size() - 1), 1.0 - (_curve[n] - least) / span)
		points.append(plot.position + plot.size * place)
	draw_polyline(points, get_accent(), scaled(1.5), true)
	draw_text_left_of(plot.end, "%d iterations" % (_curve.size() - 1), text)
	var below := plot.end - Vector2(0.0, get_line_height() + scaled(2.0))
	draw_text_left_of(below, "%.3f → %.3f" % [_curve[0], _curve[-1]], text)
