@tool
extends "plot.gd"
## The lobes of one view on the hemisphere, seen from above: each as the circle of one standard
## deviation around its mean, which the projection makes an ellipse. The heavier, the more opaque.

const _POINTS := 48
# Wider ones would go around the sphere.
const _WIDEST := 1.2

var _lobes: Array[Dictionary] = []
var _view := Vector3.BACK


func _init() -> void:
	super()
	title = "Lobes from above"
	tooltip_text = (
		"The hemisphere above the surface, the tangent to the right. Each ellipse is a lobe at one "
		+ "standard deviation, the dot is the view."
	)


func show_view(table: LobeTable, view: Vector3) -> void:
	_view = view
	_lobes = table.lobes_at(view)
	queue_redraw()


func _draw() -> void:
	draw_title()
	var area := get_area()
	var radius := 0.5 * minf(area.size.x, area.size.y)
	var centre := area.get_center()
	draw_arc(centre, radius, 0.0, TAU, 96, get_faint(), scaled(1.0), true)
	draw_line(centre - Vector2(radius, 0), centre + Vector2(radius, 0), get_faint(), scaled(1.0))
	draw_line(centre - Vector2(0, radius), centre + Vector2(0, radius), get_faint(), scaled(1.0))
	var heaviest := 1e-9
	for lobe in _lobes:
		heaviest = maxf(heaviest, lobe["weight"])
	for lobe in _lobes:
		var weight: float = lobe["weight"]
		var outline := get_outline(lobe["mean"], lobe["kappa"])
		for n in outline.size():
			outline[n] = centre + radius * outline[n]
		var share := clampf(weight / heaviest, 0.0, 1.0)
		if outline.size() > 1 and share > 0.0:
			draw_polyline(outline, Color(get_accent(), lerpf(0.15, 1.0, share)), scaled(1.5), true)
	draw_circle(centre + radius * Vector2(_view.x, -_view.y), scaled(3.0), get_ink())


## The visible part of a lobe's outline in the unit disc, y upwards on the screen.
static func get_outline(mean: Vector3, kappa: float) -> PackedVector2Array:
	var angle := minf(1.0 / sqrt(maxf(kappa, 1e-9)), _WIDEST)
	var side := mean.cross(Vector3.RIGHT if absf(mean.x) < 0.9 else Vector3.UP).normalized()
	var other := mean.cross(side)
	var outline: PackedVector2Array = []
	for n in _POINTS + 1:
		var turn := TAU * n / _POINTS
		var offset := cos(turn) * side + sin(turn) * other
		var point := cos(angle) * mean + sin(angle) * offset
		if point.z >= 0.0:
			outline.append(Vector2(point.x, -point.y))
	return outline
