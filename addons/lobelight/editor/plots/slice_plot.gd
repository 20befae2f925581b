@tool
extends "plot.gd"
## The slice BRDF × cosine for one view, in the plane of incidence, beside the lobes that stand for
## it. The radius is the square root of the value: linear in it, sharp slices would be needles.

const Mixture := preload("mixture.gd")
const NativeLibrary := preload("../bake/native_library.gd")

const _COUNT := 721

var _slice: PackedFloat32Array = []
var _mixture: PackedFloat32Array = []
var _view := Vector3.BACK


func _init() -> void:
	super()
	title = "BRDF × cosine and lobes"
	tooltip_text = (
		"In the plane of incidence: the BRDF times the cosine of the light's angle, and the sum of "
		+ "the lobes, in colour. The radius is the square root of the value."
	)


## Shows the lobes for a view, and the slice where the library is there and knows the BRDF.
func show_view(table: LobeTable, brdf: String, view: Vector3) -> void:
	_view = view
	_mixture = []
	var lobes := table.lobes_at(view)
	for direction in Mixture.plane_directions(view, _COUNT):
		_mixture.append(Mixture.evaluate(lobes, direction) if direction.z > 0.0 else 0.0)
	_slice = []
	var baker := NativeLibrary.create(&"LobeBaker")
	if baker != null and brdf:
		_slice = baker.call("slice_in_plane", brdf, table.alpha, view, _COUNT)
	queue_redraw()


## The greatest value of the two curves, per steradian.
func get_peak() -> float:
	var peak := 0.0
	for values: PackedFloat32Array in [_slice, _mixture]:
		for value in values:
			peak = maxf(peak, value)
	return peak


func get_slice() -> PackedFloat32Array:
	return _slice


func get_mixture() -> PackedFloat32Array:
	return _mixture


func _draw() -> void:
	draw_title()
	var area := get_area()
	var radius := minf(0.5 * area.size.x, area.size.y)
	var centre := Vector2(area.get_center().x, area.end.y)
	draw_arc(centre, radius, PI, TAU, 64, get_faint(), scaled(1.0), true)
	draw_line(centre - Vector2(radius, 0), centre + Vector2(radius, 0), get_faint(), scaled(1.0))
	draw_line(centre, centre - Vector2(0, radius), get_faint(), scaled(1.0))
	var towards_view := Vector2(Vector2(_view.x, _view.y).length(), -_view.z) * radius
	draw_dashed_line(centre, centre + towards_view, get_faint(), scaled(1.0), scaled(4.0))
	var peak := get_peak()
	if peak <= 0.0:
		return
	_draw_curve(_slice, centre, radius, peak, get_ink())
	_draw_curve(_mixture, centre, radius, peak, get_accent())
	draw_text(area.position, "%s / sr" % String.num(peak, 2), get_pale())


func _draw_curve(
	values: PackedFloat32Array, centre: Vector2, radius: float, peak: float, color: Color
) -> void:
	if values.is_empty():
		return
	var points: PackedVector2Array = []
	for n in values.size():
		var angle := PI * (float(n) / (values.size() - 1) - 0.5)
		var length := radius * sqrt(clampf(values[n] / peak, 0.0, 1.0))
		points.append(centre + length * Vector2(sin(angle), -cos(angle)))
	draw_polyline(points, color, scaled(1.5), true)
