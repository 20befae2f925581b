extends Node3D
## Two rooms and a yard: a ball rolls from one to the next, past a lift door. Each room has light of
## its own. It is built when it is first shown.

const DemoObject := preload("../demo_object.gd")
const House := preload("house.gd")
const LiftDoor := preload("lift_door.gd")
const OrbitCamera := preload("../orbit_camera.gd")
const Plan := preload("plan.gd")
const Rooms := preload("rooms.gd")

## Whether the lamp of the warm room is on.
var is_lamp_on := true:
	set(value):
		is_lamp_on = value
		if _house != null:
			_house.set_lamp(value)
			_rooms.rebuild_warm_room()
## From where it is seen at the start.
var view := OrbitCamera.View.new(Vector3.ZERO, 0.12, 0.22, 8.4)
## What is of metal.
var objects: Array[DemoObject] = []

var _house: House
var _rooms: Rooms
var _ball: DemoObject


## Builds it, unless it is there.
func build() -> void:
	if _house != null:
		return
	_house = House.new()
	_house.build(self)
	_house.set_lamp(is_lamp_on)
	_ball = _add_object(
		"Chrome ball", DemoObject.Shape.SPHERE, Vector3.ZERO, Color(0.9, 0.91, 0.92)
	)
	_ball.material.roughness = 0.2
	_ball.scale = 2.0 * Plan.BALL_RADIUS * Vector3.ONE
	var door := _add_object(
		"Lift door",
		DemoObject.Shape.SPHERE,
		Vector3(1.7, 0.0, -Plan.DEPTH),
		Color(0.8, 0.81, 0.83),
		LiftDoor.build()
	)
	door.material.roughness = 0.3
	door.material.anisotropy = 0.8333
	# Wide across the brushing.
	door.material.anisotropy_rotation = 0.5 * PI
	var teapot := _add_object(
		"Blue teapot", DemoObject.Shape.TEAPOT, Vector3(2.85, 0.725, -0.97), Color(0.3, 0.5, 0.85)
	)
	teapot.scale = 0.26 * Vector3.ONE
	teapot.rotation.y = -0.6
	teapot.material.roughness = 0.3
	var vase := _add_object(
		"Copper vase", DemoObject.Shape.VASE, Vector3(-1.8, 0.72, -1.45), Color(0.96, 0.64, 0.54)
	)
	vase.scale = Vector3(0.4, 0.46, 0.4)
	vase.material.roughness = 0.35
	vase.material.anisotropy = 0.6
	vase.material.anisotropy_rotation = 0.5 * PI
	var knot := _add_object(
		"Golden knot", DemoObject.Shape.KNOT, Vector3(5.65, 0.96, -1.05), Color(1.0, 0.78, 0.38)
	)
	knot.scale = 0.78 * Vector3.ONE
	knot.rotation = Vector3(1.3, 0.35, 0.0)
	knot.material.roughness = 0.25
	roll(0.0)
	_rooms = Rooms.new()
	add_child(_rooms)


## Whether the engine's own material is shown, which has probes of its own.
func show_engine_probes(are_shown: bool) -> void:
	if _rooms != null:
		_rooms.show_engine_probes(are_shown)


## Captures all rooms. Returns "" once it is done, or one sentence.
func prepare_light() -> String:
	return await _rooms.prepare()


## Rolls the ball to a part of its way there and back, as a turn in radians.
func roll(turn: float) -> void:
	if _ball == null:
		return
	_ball.position = Plan.ball_at(turn)
	_ball.rotation.z = -_ball.position.x / Plan.BALL_RADIUS
	_house.set_ball(_ball.position)


## Where the ball is.
func get_ball_place() -> Vector3:
	return Plan.ball_at(0.0) if _ball == null else _ball.position


## What the camera looks at: it follows the ball.
func get_target() -> Vector3:
	return Vector3(0.8 * get_ball_place().x + 0.3, 1.0, 0.0)


func _add_object(
	title: String, shape: DemoObject.Shape, at: Vector3, colour: Color, mesh: Mesh = null
) -> DemoObject:
	var object := DemoObject.new()
	object.name = title.to_pascal_case()
	object.title = title
	object.shape = shape
	if mesh != null:
		object.mesh = mesh
	object.position = at
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.4
	material.albedo_color = colour
	object.material_override = material
	add_child(object)
	objects.append(object)
	return object
