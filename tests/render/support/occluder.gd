extends RefCounted
## What stands around a point of a surface and hides light from it: walls that are endless along
## one axis of the tangent frame. Asked direction by direction, it is what shaders are compared
## with that know no more than occlusion and a bent normal.

const DIRECTIONS := 2000
const SAMPLES := 300

## What the walls are called.
var title := ""
## What a baker of textures would find: the share of the light, weighted by the cosine, and the mean
## direction of what is open.
var ao := 1.0
var bent := Vector3.BACK

# Each (axis that the profile runs along: 0 or 1, from, to), the profile's z being the normal's.
var _walls: Array[Array] = []


## A wall of a height at a distance; one that leans over the point, if `lean` is positive.
func add_wall(axis: int, distance: float, height: float, lean := 0.0) -> void:
	var from := Vector2(distance, 0.0)
	var to := from + absf(height) * Vector2(-sin(lean) * signf(distance), cos(lean))
	_walls.append([axis, from, to])


## Looks around; to be called when all walls are there.
func bake() -> void:
	var open := 0.0
	var all := 0.0
	var sum := Vector3.ZERO
	for i in DIRECTIONS:
		var z := (i + 0.5) / DIRECTIONS
		var direction := _on_circle(z, i)
		all += z
		if sees(direction):
			open += z
			sum += direction
	ao = open / all
	bent = sum.normalized()


## Whether light comes from the direction, which is in the tangent frame.
func sees(direction: Vector3) -> bool:
	if direction.z <= 0.0:
		return false
	for wall in _walls:
		var axis: int = wall[0]
		var from: Vector2 = wall[1]
		var to: Vector2 = wall[2]
		var ray := Vector2(direction[axis], direction.z)
		var along := to - from
		var area := ray.cross(along)
		if absf(area) < 1e-9:
			continue
		var t := from.cross(along) / area
		var s := from.cross(ray) / area
		if t > 0.0 and s >= 0.0 and s <= 1.0:
			return false
	return true


## The share of a spherical Gaussian's light from above the horizon that is not hidden.
func share_of(mean: Vector3, kappa: float) -> float:
	return share_within(mean, kappa, sees)


## Of what is above the horizon, the share of a spherical Gaussian for which a function of the
## direction is true.
static func share_within(mean: Vector3, kappa: float, is_open: Callable) -> float:
	var side := mean.cross(Vector3(0.36, 0.48, 0.8)).normalized()
	var other := mean.cross(side)
	var above := 0
	var open := 0
	for i in SAMPLES:
		# The cosine's distribution is exponential.
		var u := (i + 0.5) / SAMPLES
		var c := 1.0 + log(u + (1.0 - u) * exp(-2.0 * kappa)) / kappa
		var p := _on_circle(c, i)
		var direction := p.x * side + p.y * other + p.z * mean
		if direction.z > 0.0:
			above += 1
			open += 1 if is_open.call(direction) else 0
	return open / maxf(above, 1.0)


# A unit vector of the height z; successive ones lie apart.
static func _on_circle(z: float, number: int) -> Vector3:
	var azimuth := TAU * fmod(0.6180339887 * number, 1.0)
	var radius := sqrt(maxf(1.0 - z * z, 0.0))
	return Vector3(radius * cos(azimuth), radius * sin(azimuth), z)
