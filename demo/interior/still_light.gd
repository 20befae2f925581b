extends RefCounted
## The light that does not change in the interior: from windows, through doorways, from the sky, and
## from wall to wall. It is added up at the vertices of what the interior is built of.

const Plan := preload("plan.gd")
const SKY := Vector3(0.62, 0.7, 0.95)
const WINDOW := Vector3(7.5, 9.6, 12.0)
## The windows of the cool room, in the wall that is cut away: the middle, and half the size.
const WINDOWS: Array[Vector3] = [Vector3(0.95, 1.5, Plan.DEPTH), Vector3(2.45, 1.5, Plan.DEPTH)]
const WINDOW_HALF := Vector2(0.42, 0.6)
# What comes from wall to wall, over pi.
const _WARM_FILL := Vector3(0.034, 0.026, 0.024)
const _COOL_FILL := Vector3(0.24, 0.27, 0.3)
const _YARD_FILL := Vector3(0.1, 0.085, 0.075)
# Of a wall with a doorway as seen from the other side.
const _WARM_SEEN := Vector3(0.1, 0.07, 0.05)
const _COOL_SEEN := Vector3(0.42, 0.44, 0.46)
const _CORNER := 0.3


## A lit rectangle: points on it, and what each sends out times its area.
class Source:
	extends RefCounted
	var points: PackedVector3Array = []
	var facing: Vector3
	var strength: Vector3

	func _init(middle: Vector3, u: Vector3, v: Vector3, radiance: Vector3) -> void:
		const COLUMNS := 3
		const ROWS := 4
		for row in ROWS:
			for column in COLUMNS:
				var at := Vector2((column + 0.5) / COLUMNS, (row + 0.5) / ROWS) * 2.0 - Vector2.ONE
				points.append(middle + at.x * u + at.y * v)
		facing = u.cross(v).normalized()
		strength = radiance * 4.0 * u.cross(v).length() / points.size()

	## The light on a surface, over pi.
	func on(place: Vector3, normal: Vector3) -> Vector3:
		var sum := 0.0
		for point in points:
			var way := point - place
			var squared := maxf(way.length_squared(), 0.01)
			sum += maxf(normal.dot(way), 0.0) * maxf(-facing.dot(way), 0.0) / (squared * squared)
		return strength * sum / PI


var _warm: Array[Source] = []
var _cool: Array[Source] = []


func _init() -> void:
	var up := 0.5 * Plan.DOORWAY.z * Vector3.UP
	var side := 0.5 * (Plan.DOORWAY.y - Plan.DOORWAY.x) * Vector3.BACK
	var middle := Vector3(0.0, 0.5 * Plan.DOORWAY.z, 0.5 * (Plan.DOORWAY.x + Plan.DOORWAY.y))
	# Both face away from the side they are seen from: to −x, to +x.
	_warm.append(Source.new(middle + Plan.WALLS.x * Vector3.RIGHT, side, -up, _COOL_SEEN))
	_warm[0].facing = Vector3.LEFT
	_cool.append(Source.new(middle + Plan.WALLS.y * Vector3.RIGHT, side, up, _WARM_SEEN))
	_cool[0].facing = Vector3.RIGHT
	_cool.append(Source.new(middle + Plan.WALLS.z * Vector3.RIGHT, side, up, SKY))
	_cool[1].facing = Vector3.LEFT
	for window in WINDOWS:
		var source := Source.new(
			window, WINDOW_HALF.x * Vector3.RIGHT, WINDOW_HALF.y * Vector3.UP, WINDOW
		)
		source.facing = Vector3.FORWARD
		_cool.append(source)


## What falls on a surface, over pi, in linear light.
func on(place: Vector3, normal: Vector3) -> Vector3:
	var before := place + 0.02 * normal
	if Plan.WARM.grow(0.1).has_point(before):
		return _in_room(Plan.WARM, _warm, _WARM_FILL, place, normal)
	if Plan.COOL.grow(0.1).has_point(before):
		return _in_room(Plan.COOL, _cool, _COOL_FILL, place, normal)
	# The house hides a part of the sky.
	var hidden := 0.45 * exp(-maxf(before.x - Plan.WALLS.w, 0.0) / 0.8) * absf(normal.y)
	return SKY * (0.5 + 0.5 * normal.y) * (1.0 - hidden) + _YARD_FILL * (0.5 - 0.5 * normal.y)


static func _in_room(
	room: AABB, sources: Array[Source], fill: Vector3, place: Vector3, normal: Vector3
) -> Vector3:
	var open := 1.0
	for axis in 3:
		if absf(normal[axis]) > 0.5:
			continue
		for side: float in [room.position[axis], room.end[axis]]:
			open *= 1.0 - 0.42 * exp(-absf(place[axis] - side) / _CORNER)
	var light := fill * open
	for source in sources:
		light += source.on(place, normal) * (0.35 + 0.65 * open)
	return light
