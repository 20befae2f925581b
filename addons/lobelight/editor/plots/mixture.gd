@tool
extends Object
## Values of a sum of lobes, as [method LobeTable.lobes_at] gives them.


## Σ weight · kappa / (2π (1 − exp(−2 kappa))) · exp(kappa (mean · i − 1)) at the unit vector
## [param direction].
static func evaluate(lobes: Array[Dictionary], direction: Vector3) -> float:
	var sum := 0.0
	for lobe in lobes:
		var mean: Vector3 = lobe["mean"]
		var kappa: float = lobe["kappa"]
		var weight: float = lobe["weight"]
		# A Vector3 is of single precision, and mean · i − 1 of sharp lobes would be its rounding.
		var exponent := -0.5 * kappa * (direction - mean).length_squared()
		sum += weight * kappa / (TAU * (1.0 - exp(-2.0 * kappa))) * exp(exponent)
	return sum


## Directions of light in the plane of the normal and a view, at equal angles from −90° to 90°,
## positive on the view's side, as [method LobeBaker.slice_in_plane] has them.
static func plane_directions(view: Vector3, count: int) -> PackedVector3Array:
	var side := Vector2(view.x, view.y)
	side = side.normalized() if side.length() > 1e-9 else Vector2.RIGHT
	var directions: PackedVector3Array = []
	for n in count:
		var angle := PI * (float(n) / (count - 1) - 0.5)
		directions.append(Vector3(sin(angle) * side.x, sin(angle) * side.y, cos(angle)))
	return directions
