@tool
extends Object
## The numbers that line.gdshaderinc takes: where lobes lie on the long axis of a BRDF, in slopes
## over alpha, and how heavy and wide they are.
##
## The axis is cut into cells that are equally long in u, from -1 to 1; t goes by it. A lobe has the
## slopes' mass of its cell.

# Ward's slopes have the density e^-t² / pi: t = reach (u + bend (u³ - u)). Beyond are 0.2 %.
const _WARD_REACH := 2.2
const _WARD_BEND := 0.226
const _WARD_VARIANCE := 0.5
# GGX's, 1 / (pi (1 + t²)²), with tails that want ever longer cells:
#     t = scale u / (end + 1 - u²)^power.
const _GGX_SCALE := 2.1
const _GGX_END := 0.05
const _GGX_POWER := 0.75
# The density across the axis at t is 2 (1 + t²)^1.5 / (pi (1 + t² + b²)²): what is far off along
# the axis is more so across it. Lobes are wider than its peak, pi / 8 (1 + t²), for its tails.
const _GGX_VARIANCE := 0.42
const _GGX_GROWTH := 1.25
# See lobelight_line_width.
const _GAP_POWER := 0.3


## What the shader takes for [param places] lobes that are as dense as [param count], any number up
## to that: where it grows, the outermost lobes come in gradually.
static func get_parameters(
	brdf: String, count: float, places: int
) -> Dictionary[StringName, Variant]:
	var is_ggx := brdf == "ggx"
	var lobes := PackedVector4Array()
	var mass := 0.0
	for place in places:
		var from := clampf((2.0 * place - places) / count, -1.0, 1.0)
		var to := clampf((2.0 * place + 2.0 - places) / count, -1.0, 1.0)
		var weight := _mass_below(to, is_ggx) - _mass_below(from, is_ggx)
		var t := _place(0.5 * (from + to), is_ggx)
		var across := _WARD_VARIANCE
		if is_ggx:
			across = _GGX_VARIANCE * pow(1.0 + t * t, _GGX_GROWTH)
		elif to > from:
			var start := _place(from, false)
			var end := _place(to, false)
			t = (exp(-start * start) - exp(-end * end)) / (2.0 * sqrt(PI) * weight)
		lobes.append(Vector4(t, weight, across, _get_widening(0.5 * (from + to), count, is_ggx)))
		mass += weight
	var square := 0.0
	for i in places:
		lobes[i].y /= mass
		square += lobes[i].y * lobes[i].x * lobes[i].x
	var spread := Vector2(
		1.0 if is_ggx else _WARD_VARIANCE / square, _get_widening(0.0, count, is_ggx)
	)
	return {&"lobelight_line": lobes, &"lobelight_line_spread": spread}


static func _place(u: float, is_ggx: bool) -> float:
	if is_ggx:
		return _GGX_SCALE * u / pow(_GGX_END + 1.0 - u * u, _GGX_POWER)
	return _WARD_REACH * (u + _WARD_BEND * (u * u * u - u))


# Of the slopes; the last cells have all that is beyond.
static func _mass_below(u: float, is_ggx: bool) -> float:
	if u <= -1.0 or u >= 1.0:
		return 0.5 + 0.5 * u if is_ggx else 0.5 + 0.5 * _erf(u * _WARD_REACH)
	var t := _place(u, is_ggx)
	return 0.5 + 0.5 * (t / sqrt(1.0 + t * t) if is_ggx else _erf(t))


static func _get_widening(u: float, count: float, is_ggx: bool) -> float:
	var gap := (
		_place(minf(u + 1.0 / count, 1.0), is_ggx) - _place(maxf(u - 1.0 / count, -1.0), is_ggx)
	)
	var t := _place(u, is_ggx)
	var across := _GGX_VARIANCE * pow(1.0 + t * t, _GGX_GROWTH) if is_ggx else _WARD_VARIANCE
	return pow(0.25 * gap * gap / across, _GAP_POWER)


# 1.5e-7 off at most (Abramowitz and Stegun 1964, "Handbook of Mathematical Functions", 7.1.26).
static func _erf(x: float) -> float:
	var t := 1.0 / (1.0 + 0.3275911 * absf(x))
	var sum := (
		0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429)))
	)
	return signf(x) * (1.0 - sum * t * exp(-x * x))
