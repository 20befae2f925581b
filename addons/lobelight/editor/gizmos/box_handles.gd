@tool
extends Object
## Boxes that are sized by handles in the middle of their faces, as the engine's own gizmos do it.
## Handles 2i and 2i + 1 are those of the faces at the ends of axis i, the positive one first.

# The ends of what a handle can be dragged to, in metres, as in the engine.
const _FARTHEST := 4096.0
# Of a ray along the axis: no place on the axis is nearer to it than another.
const _LEAST_ANGLE := 1e-6


## Where the handles of a box around the origin are.
static func get_places(size: Vector3) -> PackedVector3Array:
	var places: PackedVector3Array = []
	for axis in 3:
		var place := Vector3.ZERO
		place[axis] = 0.5 * size[axis]
		places.append(place)
		places.append(-place)
	return places


static func get_handle_name(id: int) -> String:
	@warning_ignore("integer_division")
	return "Size " + "XYZ"[id / 2]


## The box that one of [param size] around the origin becomes when the face of a handle is dragged
## to [param place] along its axis. The opposite face stays; with [param symmetric] it mirrors the
## dragged one. Lengths are multiples of [param step], if it is above 0, and at least
## [param least].
static func drag(
	size: Vector3, id: int, place: float, symmetric: bool, step: float, least: float
) -> AABB:
	@warning_ignore("integer_division")
	var axis := id / 2
	var outwards := -1.0 if id % 2 else 1.0
	var half := 0.5 * size[axis]
	var length := 2.0 * outwards * place if symmetric else outwards * place + half
	if step > 0.0:
		length = snappedf(length, step)
	length = maxf(length, least)
	var box := AABB(-0.5 * size, size)
	box.size[axis] = length
	if symmetric:
		box.position[axis] = -0.5 * length
	elif outwards < 0.0:
		box.position[axis] = half - length
	return box


## Where on the line through [param start] along an axis the mouse points: the coordinate along that
## axis of the place on the line that is nearest to the camera's ray. [param frame] takes the axes
## to the world. Where the camera looks along the line, it is that of [param start].
static func find_place(
	frame: Transform3D, start: Vector3, axis: int, camera: Camera3D, point: Vector2
) -> float:
	var inverse := frame.affine_inverse()
	var origin := inverse * camera.project_ray_origin(point) - start
	var direction := (inverse.basis * camera.project_ray_normal(point)).normalized()
	# |t e − o|² − (d · (t e − o))² is least at t (1 − d_i²) = o_i − d_i (d · o).
	var along := direction[axis]
	var aside := 1.0 - along * along
	if aside < _LEAST_ANGLE:
		return start[axis]
	var t := (origin[axis] - along * direction.dot(origin)) / aside
	# Behind the camera nothing is pointed at: of the ray, its start is nearest then.
	if along * t < direction.dot(origin):
		t = origin[axis]
	return start[axis] + clampf(t, -_FARTHEST, _FARTHEST)
