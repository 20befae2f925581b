extends Node3D
## From room to room: each has a [LobeProbe3D] of its size, and what goes from one to the other is
## lit by the one it is in, and by both in the doorway.
##
## The probes capture their rooms when the scene begins; lamps that never change need no more.

const ROOM := Vector3(4.0, 3.0, 4.0)
const WALL := 0.1
const DOOR := Vector2(1.6, 2.2)
const COLOURS: Array[Color] = [Color(0.8, 0.25, 0.15), Color(0.15, 0.35, 0.8)]
# Of the ball, from room to room.
const PATH := 1.6

## Seconds for the ball's way there and back; 0 to leave it where it is.
@export var period := 6.0

var _time := 0.0

@onready var _ball: Node3D = $Ball
@onready var _probes: Array[LobeProbe3D] = [$LeftProbe, $RightProbe]


func _ready() -> void:
	for i in 2:
		_build(0.5 * ROOM.x * (2 * i - 1), COLOURS[i])


func _process(delta: float) -> void:
	if period > 0.0:
		_time += delta
		put_ball(sin(TAU * _time / period))


## From the left room's middle, -1, to the right one's, 1.
func put_ball(place: float) -> void:
	_ball.position.x = PATH * place


## To be awaited: until both rooms' light has been captured anew.
func rebuild() -> void:
	for probe in _probes:
		await probe.rebuild()


## As it is shown in the documentation.
func pose() -> void:
	period = 0.0
	put_ball(-0.4)
	await rebuild()


# Floor, ceiling and walls of a room about x; the wall between the two has a door.
func _build(x: float, colour: Color) -> void:
	var half := 0.5 * ROOM
	var sideways := signf(x)
	_add_box(Vector3(x, -WALL * 0.5, 0.0), Vector3(ROOM.x, WALL, ROOM.z), Color(0.6, 0.6, 0.6))
	_add_box(Vector3(x, ROOM.y, 0.0), Vector3(ROOM.x, WALL, ROOM.z), Color(0.8, 0.8, 0.8))
	_add_box(Vector3(x, half.y, -half.z), Vector3(ROOM.x, ROOM.y, WALL), colour)
	_add_box(Vector3(2.0 * x, half.y, 0.0), Vector3(WALL, ROOM.y, ROOM.z), colour)
	var beside := 0.5 * (ROOM.z - DOOR.x)
	for side: float in [-1.0, 1.0]:
		var z := side * 0.5 * (ROOM.z - beside)
		_add_box(
			Vector3(sideways * 0.25 * WALL, half.y, z), Vector3(0.5 * WALL, ROOM.y, beside), colour
		)
	_add_box(
		Vector3(sideways * 0.25 * WALL, 0.5 * (ROOM.y + DOOR.y), 0.0),
		Vector3(0.5 * WALL, ROOM.y - DOOR.y, DOOR.x),
		colour
	)


func _add_box(place: Vector3, size: Vector3, colour: Color) -> void:
	var box := MeshInstance3D.new()
	var mesh := BoxMesh.new()
	mesh.size = size
	var paint := StandardMaterial3D.new()
	paint.albedo_color = colour
	mesh.material = paint
	box.mesh = mesh
	box.position = place
	add_child(box)
