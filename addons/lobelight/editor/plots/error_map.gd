@tool
extends "plot.gd"
## How far the lobes are from the BRDF at each view that was fitted: a disc of view directions, the
## normal in the middle, the horizon at the rim. Clicking chooses a view.

## A view has been clicked: its elevation and azimuth in radians.
signal view_chosen(elevation: float, azimuth: float)

# From good to bad: dark, middle, bright, as in perceptually uniform maps.
const _COLORS: Array[Color] = [
	Color("#30123b"), Color("#4662d7"), Color("#1ae4b6"), Color("#faba39"), Color("#d23105")
]
const _ARC_STEPS := 6

var _errors: PackedFloat32Array = []
var _views := Vector2i.ZERO
var _elevations: PackedFloat64Array = []


func _init() -> void:
	super()
	title = "Error over views"
	mouse_default_cursor_shape = Control.CURSOR_POINTING_HAND


## Shows the errors of a bake; without any, says so.
func show_errors(table: LobeTable, errors: PackedFloat32Array) -> void:
	_errors = errors if errors.size() == table.views.x * table.views.y else PackedFloat32Array()
	_views = table.views
	_elevations = []
	for t in table.views.x:
		_elevations.append(acos(clampf(table.get_view(t, 0).z, -1.0, 1.0)))
	queue_redraw()


## The greatest error of a view.
func get_worst() -> float:
	return Array(_errors).max() if not _errors.is_empty() else 0.0


func get_mean() -> float:
	var sum := 0.0
	for error in _errors:
		sum += error
	return sum / maxi(_errors.size(), 1)


static func get_color(share: float) -> Color:
	var place := clampf(share, 0.0, 1.0) * (_COLORS.size() - 1)
	var low := mini(floori(place), _COLORS.size() - 2)
	return _COLORS[low].lerp(_COLORS[low + 1], place - low)


func _draw() -> void:
	draw_title()
	var area := get_area()
	if _errors.is_empty():
		draw_text(area.position, "Bake the table to see it.", get_pale())
		return
	var worst := maxf(get_worst(), 1e-9)
	draw_text_left_of(
		Vector2(size.x, area.end.y - get_line_height()), _percent(worst), get_color(1.0)
	)
	var centre := _centre()
	# From the middle outwards, rings are drawn over the larger ones.
	for t in range(_views.x - 1, -1, -1):
		var radius := _ring(t)
		for p in _views.y:
			var sector := _make_sector(p, radius)
			var color := get_color(_errors[p * _views.x + t] / worst)
			for mirrored: Vector2 in [
				Vector2(1, 1), Vector2(-1, 1), Vector2(1, -1), Vector2(-1, -1)
			]:
				draw_colored_polygon(Transform2D(0.0, mirrored, 0.0, centre) * sector, color)


func _get_tooltip(at: Vector2) -> String:
	var cell := _find_cell(at)
	if _errors.is_empty() or cell.x < 0:
		return "The part of the light that the lobes put elsewhere than the BRDF."
	return (
		"View %d° from the normal, azimuth %d°: error %s"
		% [
			roundi(rad_to_deg(_elevations[cell.x])),
			roundi(rad_to_deg(_azimuth(cell.y))),
			_percent(_errors[cell.y * _views.x + cell.x]),
		]
	)


func _gui_input(event: InputEvent) -> void:
	var click := event as InputEventMouseButton
	if click == null or not click.pressed or click.button_index != MOUSE_BUTTON_LEFT:
		return
	var cell := _find_cell(click.position)
	if not _errors.is_empty() and cell.x >= 0:
		view_chosen.emit(_elevations[cell.x], _azimuth(cell.y))
		accept_event()


static func _percent(error: float) -> String:
	return "%s %%" % String.num(100.0 * error, 1)


func _azimuth(p: int) -> float:
	return 0.0 if _views.y < 2 else 0.5 * PI * p / (_views.y - 1)


func _centre() -> Vector2:
	return get_area().get_center() - Vector2(scaled(10.0), 0.0)


func _radius() -> float:
	# The worst error stands in the corner.
	return 0.5 * minf(get_area().size.x, get_area().size.y) - scaled(6.0)


# The outer end of a ring: half-way to the next elevation.
func _ring(t: int) -> float:
	var outer := 0.5 * PI
	if t < _views.x - 1:
		outer = 0.5 * (_elevations[t] + _elevations[t + 1])
	return _radius() * outer / (0.5 * PI)


# Around the middle, in the quadrant of the tangent and the bitangent.
func _make_sector(p: int, radius: float) -> PackedVector2Array:
	var first := 0.0
	var last := 0.5 * PI
	if _views.y > 1:
		first = clampf(_azimuth(p) - 0.25 * PI / (_views.y - 1), 0.0, 0.5 * PI)
		last = clampf(_azimuth(p) + 0.25 * PI / (_views.y - 1), 0.0, 0.5 * PI)
	var points: PackedVector2Array = [Vector2.ZERO]
	for step in _ARC_STEPS + 1:
		var azimuth := lerpf(first, last, float(step) / _ARC_STEPS)
		points.append(radius * Vector2(cos(azimuth), -sin(azimuth)))
	return points


# The view (elevation, azimuth) at a place, or (-1, -1).
func _find_cell(at: Vector2) -> Vector2i:
	var offset := at - _centre()
	if _errors.is_empty() or offset.length() > _radius():
		return Vector2i(-1, -1)
	for t in _views.x:
		if offset.length() <= _ring(t):
			var azimuth := atan2(absf(offset.y), absf(offset.x))
			return Vector2i(t, roundi(azimuth / (0.5 * PI) * (_views.y - 1)))
	return Vector2i(-1, -1)
