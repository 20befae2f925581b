extends RefCounted
## Points on a line for line_lobes.gdshaderinc, in slopes over alpha.

# How far the lobes reach: beyond are 2.8 % of Ward's slopes and 5 % of GGX's.
const _WARD_REACH := 1.556
const _GGX_REACH := 3.04
# Cells have equal integrals of the density to this power: 0 makes them equally long, 1 equally
# heavy. Sparse lobes want long cells.
const _EVENNESS := 0.15
# Ward's e^-t² / pi has it along each axis.
const _WARD_VARIANCE := 0.5
# The density across the line at t is 2 (1 + t²)^1.5 / (pi (1 + t² + b²)²) with GGX; the Gaussian
# of the same peak has pi / 8 (1 + t²).
const _GGX_VARIANCE := PI / 8.0
const _STEPS := 8192


## The shader parameters for [param count] lobes of Ward's slopes or GGX's.
static func get_parameters(count: int, is_ggx: bool) -> Dictionary[StringName, Variant]:
	var reach := _GGX_REACH if is_ggx else _WARD_REACH
	var step := 2.0 * reach / _STEPS
	var whole := 0.0
	for index in _STEPS:
		whole += pow(_density((index + 0.5) * step - reach, is_ggx), _EVENNESS)
	var masses := PackedFloat64Array()
	var moments := PackedFloat64Array()
	masses.resize(count)
	moments.resize(count)
	var mass := 0.0
	var square := 0.0
	var reached := 0.0
	for index in _STEPS:
		var t := (index + 0.5) * step - reach
		var density := _density(t, is_ggx) * step
		var cell := mini(int(reached / whole * count), count - 1)
		reached += pow(density / step, _EVENNESS)
		masses[cell] += density
		moments[cell] += density * t
		mass += density
		square += density * t * t
	var variance := square / mass if is_ggx else _WARD_VARIANCE
	var lobes := PackedVector3Array()
	var of_points := 0.0
	for cell in count:
		var t := moments[cell] / masses[cell]
		var across := _GGX_VARIANCE * (1.0 + t * t) if is_ggx else _WARD_VARIANCE
		lobes.append(Vector3(t, masses[cell] / mass, across))
		of_points += masses[cell] / mass * t * t
	var distance := (lobes[count - 1].x - lobes[0].x) / (count - 1)
	return {
		&"line_lobes": lobes,
		&"line_spread": Vector2(variance / of_points, distance / sqrt(variance)),
	}


# Of slopes over alpha along any line through the middle, summed up across it.
static func _density(t: float, is_ggx: bool) -> float:
	return 0.5 * pow(1.0 + t * t, -1.5) if is_ggx else exp(-t * t) / sqrt(PI)
