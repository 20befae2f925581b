## Surfaces for [code]surface_mesh.gd[/code]: functions of (u, v) in [0, 1]² that give the point,
## with the direction of brushing as tangent.

## A sphere about the origin, brushed along the parallels.
static func sphere(u: float, v: float, radius: float) -> Transform3D:
	var azimuth := TAU * u
	var polar := PI * v
	var normal := _around(azimuth) * sin(polar) + Vector3.UP * cos(polar)
	return _frame(radius * normal, _along(azimuth), normal)


## A torus about the y axis, brushed along its ring.
static func torus(u: float, v: float, ring: float, tube: float) -> Transform3D:
	var azimuth := TAU * u
	var turn := TAU * v
	var normal := _around(azimuth) * cos(turn) + Vector3.UP * sin(turn)
	return _frame(ring * _around(azimuth) + tube * normal, _along(azimuth), normal)


## A round plate that faces up, brushed in circles: its face is hollow by [param hollow], a
## parabola; its edge is a part of a torus that goes on from the face smoothly.
static func plate(
	u: float, v: float, radius: float, thickness: float, hollow: float
) -> Transform3D:
	const FACE := 0.7
	var azimuth := TAU * u
	var edge := 0.5 * thickness
	var face_radius := radius - edge
	var outmost_slope := 2.0 * hollow / face_radius
	# The direction of the profile's normal, from up (0) over outwards (90°) to down.
	var direction: float
	var point: Vector2
	if v < FACE:
		var distance := face_radius * v / FACE
		direction = -atan(outmost_slope * distance / face_radius)
		point = Vector2(
			distance, hollow * (distance * distance / (face_radius * face_radius) - 1.0)
		)
	else:
		var start := -atan(outmost_slope)
		direction = lerpf(start, PI, (v - FACE) / (1.0 - FACE))
		var centre := Vector2(face_radius, 0.0) - edge * Vector2(sin(start), cos(start))
		point = centre + edge * Vector2(sin(direction), cos(direction))
	var normal := _around(azimuth) * sin(direction) + Vector3.UP * cos(direction)
	return _frame(_around(azimuth) * point.x + Vector3.UP * point.y, _along(azimuth), normal)


## A tube along a trefoil knot that is three times [param size] wide, brushed along the tube.
static func knot(u: float, v: float, size: float, tube: float) -> Transform3D:
	var t := TAU * u
	var centre := Vector3(sin(t) + 2.0 * sin(2.0 * t), -sin(3.0 * t), cos(t) - 2.0 * cos(2.0 * t))
	var velocity := Vector3(
		cos(t) + 4.0 * cos(2.0 * t), -3.0 * cos(3.0 * t), -sin(t) + 4.0 * sin(2.0 * t)
	)
	# The horizontal speed is at least 3, so the tangent is never vertical and the frame has no seam.
	# A circle across the tangent has the tube's exact normal, whatever the frame's twist.
	var tangent := velocity.normalized()
	var side := tangent.cross(Vector3.UP).normalized()
	var normal := side * cos(TAU * v) + side.cross(tangent) * sin(TAU * v)
	return _frame(size * centre + tube * normal, tangent, normal)


## A vase that stands on the origin, turned about the y axis and brushed along the parallels: its
## radius is a smooth curve of the height, its wall has no thickness, its brim is open.
static func vase(u: float, v: float, radius: float, height: float) -> Transform3D:
	var azimuth := TAU * u
	# The profile and its derivative, as multiples of radius and height.
	var width := 0.62 + 0.34 * sin(1.0 + 4.6 * v) + 0.1 * v
	var slope := 0.34 * 4.6 * cos(1.0 + 4.6 * v) + 0.1
	var profile := Vector2(slope * radius, height).normalized()
	var point := _around(azimuth) * width * radius + Vector3.UP * (1.0 - v) * height
	# v runs downwards, as on the sphere.
	var normal := _around(azimuth) * profile.y + Vector3.UP * profile.x
	return _frame(point, _along(azimuth), normal)


# The horizontal unit vector at an angle about the y axis.
static func _around(azimuth: float) -> Vector3:
	return Vector3(cos(azimuth), 0.0, sin(azimuth))


# Its derivative.
static func _along(azimuth: float) -> Vector3:
	return Vector3(-sin(azimuth), 0.0, cos(azimuth))


static func _frame(point: Vector3, tangent: Vector3, normal: Vector3) -> Transform3D:
	return Transform3D(Basis(tangent, normal.cross(tangent), normal), point)
