extends RefCounted
## What the interior is built of: walls, floors, windows and furniture, and the light on them.

const Builder := preload("builder.gd")
const Layers := preload("../layers.gd")
const Plan := preload("plan.gd")
const StillLight := preload("still_light.gd")
const SurfaceShader := preload("surface.gdshader")
const _LAMP_LIGHT := Vector3(1.9, 1.12, 0.5)
const _SUN_LIGHT := Vector3(2.3, 1.22, 0.52)
# Of the lamp's glass.
const _GLOW := Vector3(11.0, 6.6, 3.2)

var _looks: Array[ShaderMaterial] = []
var _glass: ShaderMaterial
var _still_light := StillLight.new()
var _builder := Builder.new(_still_light)


## Adds all of it to [param parent].
func build(parent: Node3D) -> void:
	_add_warm_room()
	_add_cool_room()
	_add_walls()
	_add_yard()
	_builder.build(parent, Layers.COMMON)
	_add_reflected(parent)
	_add_lamp(parent)
	set_lamp(true)


func set_lamp(is_on: bool) -> void:
	_set_everywhere(&"lamp_light", _LAMP_LIGHT if is_on else Vector3.ZERO)
	_glass.set_shader_parameter(&"emission", _GLOW if is_on else Vector3(0.02, 0.02, 0.02))


## Where the ball is, for its shadows.
func set_ball(place: Vector3) -> void:
	_set_everywhere(&"ball", Vector4(place.x, place.y, place.z, Plan.BALL_RADIUS))


func _set_everywhere(parameter: StringName, value: Variant) -> void:
	for look in _looks:
		look.set_shader_parameter(parameter, value)


func _make_look(colour: Vector3, more := {}) -> ShaderMaterial:
	var look := ShaderMaterial.new()
	look.shader = SurfaceShader
	look.set_shader_parameter(&"colour", colour)
	look.set_shader_parameter(&"second", colour)
	look.set_shader_parameter(&"lamp_place", Plan.LAMP)
	look.set_shader_parameter(&"sun_light", _SUN_LIGHT)
	look.set_shader_parameter(&"to_sun", Plan.TO_SUN.normalized())
	look.set_shader_parameter(&"walls", Plan.WALLS)
	look.set_shader_parameter(&"doorway", Plan.DOORWAY)
	for parameter: StringName in more:
		look.set_shader_parameter(parameter, more[parameter])
	_looks.append(look)
	return look


# The inside of a room: floor, ceiling, back and front. The front and the ceiling face inwards only,
# so that one looks through them from outside.
func _add_inside(room: AABB, floor_look: Material, wall: Material, ceiling: Material) -> void:
	var x := room.size.x * Vector3.RIGHT
	var y := room.size.y * Vector3.UP
	var z := room.size.z * Vector3.BACK
	var low := room.position
	_builder.add_rectangle(floor_look, low + z, x, -z)
	_builder.add_rectangle(ceiling, low + y, x, z)
	_builder.add_rectangle(wall, low, x, y)
	_builder.add_rectangle(wall, low + x + z, -x, y)


func _add_warm_room() -> void:
	var boards := _make_look(
		Vector3(0.36, 0.19, 0.09),
		{
			&"second": Vector3(0.31, 0.155, 0.07),
			&"joint": Vector3(0.05, 0.025, 0.015),
			&"tile": Vector2(1.1, 0.14),
			&"joint_width": 0.006,
			&"shift": 0.37,
			&"variety": 0.35,
			&"grain": 0.22,
		}
	)
	var ochre := _make_look(Vector3(0.66, 0.34, 0.14), {&"variety": 0.06})
	_add_inside(Plan.WARM, boards, ochre, _make_look(Vector3(0.7, 0.62, 0.5)))
	var low := Plan.WARM.position
	_builder.add_rectangle(
		ochre,
		low + 2.0 * Plan.DEPTH * Vector3.BACK,
		2.0 * Plan.DEPTH * Vector3.FORWARD,
		Plan.HEIGHT * Vector3.UP
	)
	# A sideboard with books, two pictures, a rug.
	var walnut := _make_look(
		Vector3(0.17, 0.075, 0.035),
		{
			&"tile": Vector2(0.8, 0.33),
			&"joint": Vector3(0.02, 0.01, 0.006),
			&"joint_width": 0.012,
			&"grain": 0.3,
		}
	)
	_builder.add_box(walnut, AABB(Vector3(-3.1, 0.1, -1.66), Vector3(1.6, 0.62, 0.42)), "z")
	_builder.add_box(walnut, AABB(Vector3(-3.0, 0.0, -1.6), Vector3(1.4, 0.1, 0.3)), "zYy")
	var at := -2.92
	var books: Array[Vector3] = [
		Vector3(0.42, 0.05, 0.04),
		Vector3(0.05, 0.16, 0.2),
		Vector3(0.55, 0.42, 0.22),
		Vector3(0.08, 0.2, 0.1),
		Vector3(0.5, 0.2, 0.05),
		Vector3(0.1, 0.1, 0.22),
		Vector3(0.6, 0.52, 0.4),
		Vector3(0.3, 0.03, 0.08),
	]
	for index in books.size():
		var size := Vector3(0.045 + 0.012 * (index * 5 % 3), 0.24 + 0.03 * (index * 3 % 4), 0.19)
		var book := AABB(Vector3(at, 0.72, -1.62), size)
		_builder.add_box(_make_look(books[index]), book, "zy")
		at += size.x + 0.004
	var frame := _make_look(Vector3(0.05, 0.035, 0.025))
	var pictures: Array[Array] = [
		[Vector3(-2.95, 1.25, 0.0), Vector3(0.62, 0.8, 0.03), Vector3(0.1, 0.22, 0.24)],
		[Vector3(-2.15, 1.37, 0.0), Vector3(0.46, 0.56, 0.03), Vector3(0.52, 0.13, 0.06)],
	]
	for picture in pictures:
		var corner: Vector3 = picture[0]
		corner.z = low.z
		var size: Vector3 = picture[1]
		_builder.add_box(frame, AABB(corner, size), "z")
		var paint: Vector3 = picture[2]
		var canvas := _make_look(
			paint,
			{
				&"second": 1.7 * paint,
				&"joint": Vector3(0.72, 0.6, 0.42),
				&"joint_width": 0.02,
				&"tile": Vector2(0.17, 0.19),
				&"variety": 0.5,
			}
		)
		var inset := Vector3(0.05, 0.05, size.z + 0.002)
		_builder.add_rectangle(
			canvas, corner + inset, (size.x - 0.1) * Vector3.RIGHT, (size.y - 0.1) * Vector3.UP
		)
	var rug := _make_look(
		Vector3(0.36, 0.055, 0.045),
		{
			&"second": Vector3(0.42, 0.09, 0.06),
			&"joint": Vector3(0.6, 0.42, 0.22),
			&"joint_width": 0.012,
			&"tile": Vector2(0.2, 0.2),
			&"variety": 0.2,
		}
	)
	_builder.add_box(rug, AABB(Vector3(-2.6, 0.0, -0.75), Vector3(1.8, 0.012, 2.0)), "y")


func _add_cool_room() -> void:
	var slabs := _make_look(
		Vector3(0.52, 0.55, 0.58),
		{
			&"second": Vector3(0.2, 0.27, 0.33),
			&"joint": Vector3(0.12, 0.13, 0.14),
			&"tile": Vector2(0.4, 0.4),
			&"joint_width": 0.008,
			&"variety": 0.12,
		}
	)
	var plaster := _make_look(Vector3(0.72, 0.75, 0.76))
	_add_inside(Plan.COOL, slabs, plaster, _make_look(Vector3(0.78, 0.79, 0.79)))
	# Glazed tiles up to a rail, on the walls that are seen.
	var tiles := _make_look(
		Vector3(0.16, 0.42, 0.44),
		{
			&"second": Vector3(0.19, 0.47, 0.48),
			&"joint": Vector3(0.6, 0.64, 0.64),
			&"tile": Vector2(0.2, 0.1),
			&"joint_width": 0.006,
			&"shift": 0.5,
			&"variety": 0.25,
		}
	)
	var room := Plan.COOL
	_builder.add_box(tiles, AABB(room.position, Vector3(room.size.x, 1.1, 0.02)), "xXyz")
	# What is seen of the lift besides its door, and the button.
	var frame := _make_look(Vector3(0.1, 0.105, 0.11))
	for box: AABB in [
		AABB(Vector3(0.98, 0.0, -1.7), Vector3(0.1, 2.15, 0.09)),
		AABB(Vector3(2.32, 0.0, -1.7), Vector3(0.1, 2.15, 0.09)),
		AABB(Vector3(1.08, 2.05, -1.7), Vector3(1.24, 0.1, 0.09)),
	]:
		_builder.add_box(frame, box, "zy")
	_builder.add_box(frame, AABB(Vector3(2.55, 1.0, -1.69), Vector3(0.09, 0.22, 0.03)), "z")
	var button := _make_look(Vector3.ZERO, {&"emission": Vector3(3.2, 1.1, 0.25)})
	_builder.add_rectangle(
		button, Vector3(2.58, 1.09, -1.656), 0.03 * Vector3.RIGHT, 0.03 * Vector3.UP
	)
	var stand := _make_look(Vector3(0.5, 0.5, 0.48), {&"variety": 0.1})
	_builder.add_box(stand, AABB(Vector3(2.62, 0.0, -1.2), Vector3(0.46, 0.72, 0.46)), "y")
	var pane := _make_look(
		Vector3(0.05, 0.05, 0.05),
		{&"emission": StillLight.WINDOW, &"tile": Vector2(0.42, 0.4), &"joint_width": 0.05}
	)
	for window in StillLight.WINDOWS:
		var half := StillLight.WINDOW_HALF
		_builder.add_rectangle(
			pane,
			window + Vector3(half.x, -half.y, -0.01),
			2.0 * half.x * Vector3.LEFT,
			2.0 * half.y * Vector3.UP
		)


func _add_walls() -> void:
	var brick := _make_look(
		Vector3(0.42, 0.17, 0.1),
		{
			&"second": Vector3(0.36, 0.14, 0.085),
			&"joint": Vector3(0.46, 0.42, 0.36),
			&"tile": Vector2(0.24, 0.08),
			&"joint_width": 0.012,
			&"shift": 0.5,
			&"variety": 0.4,
		}
	)
	var ochre := _make_look(Vector3(0.66, 0.34, 0.14), {&"variety": 0.06})
	var plaster := _make_look(Vector3(0.72, 0.75, 0.76))
	# Where the house is cut.
	var cut := _make_look(Vector3(0.035, 0.035, 0.038))
	_add_wall_with_doorway(Plan.WALLS.x, ochre, plaster, plaster, cut)
	_add_wall_with_doorway(Plan.WALLS.z, plaster, brick, plaster, cut)
	var back := -Plan.DEPTH - Plan.WALL
	var length := Plan.WALLS.w + 3.5
	# The outer walls' sides that are turned outwards, and their cuts.
	_builder.add_rectangle(
		brick,
		Vector3(-3.5, 0.0, back),
		(Plan.WALL + 2.0 * Plan.DEPTH) * Vector3.BACK,
		Plan.HEIGHT * Vector3.UP
	)
	_builder.add_rectangle(
		brick, Vector3(Plan.WALLS.w, 0.0, back), length * Vector3.LEFT, Plan.HEIGHT * Vector3.UP
	)
	_builder.add_rectangle(
		cut,
		Vector3(-3.5, Plan.HEIGHT, -Plan.DEPTH),
		length * Vector3.RIGHT,
		Plan.WALL * Vector3.FORWARD
	)
	_builder.add_rectangle(
		cut,
		Vector3(-3.5, Plan.HEIGHT, Plan.DEPTH),
		Plan.WALL * Vector3.RIGHT,
		2.0 * Plan.DEPTH * Vector3.FORWARD
	)
	_builder.add_rectangle(
		cut, Vector3(-3.5, 0.0, Plan.DEPTH), Plan.WALL * Vector3.RIGHT, Plan.HEIGHT * Vector3.UP
	)
	_builder.add_rectangle(
		brick,
		Vector3(Plan.WALLS.w, 0.0, -Plan.DEPTH),
		Plan.WALL * Vector3.FORWARD,
		Plan.HEIGHT * Vector3.UP
	)
	# What the house stands on.
	_builder.add_box(cut, AABB(Vector3(-3.5, -0.22, back), Vector3(10.7, 0.22, 3.6)), "Y")


func _add_wall_with_doorway(
	x: float, left: Material, right: Material, inside: Material, cut: Material
) -> void:
	var wall := Plan.WALL
	var high := Plan.HEIGHT
	var door := Plan.DOORWAY
	var parts: Array[AABB] = [
		AABB(Vector3(x, 0.0, -Plan.DEPTH), Vector3(wall, high, door.x + Plan.DEPTH)),
		AABB(Vector3(x, 0.0, door.y), Vector3(wall, high, Plan.DEPTH - door.y)),
		AABB(Vector3(x, door.z, door.x), Vector3(wall, high - door.z, door.y - door.x)),
	]
	for part in parts:
		_builder.add_box(left, part, "XyYzZ")
		_builder.add_box(right, part, "xyYzZ")
		_builder.add_box(cut, part, "xXyzZ")
	_builder.add_box(inside, parts[0], "xXyYz")
	_builder.add_box(inside, parts[1], "xXyYZ")
	_builder.add_box(cut, parts[1], "xXyYz")
	_builder.add_box(inside, parts[2], "xXYzZ")
	# The threshold.
	_builder.add_rectangle(
		inside, Vector3(x, 0.0, door.y), wall * Vector3.RIGHT, (door.y - door.x) * Vector3.FORWARD
	)


func _add_yard() -> void:
	var paving := _make_look(
		Vector3(0.34, 0.3, 0.26),
		{
			&"second": Vector3(0.27, 0.25, 0.23),
			&"joint": Vector3(0.09, 0.11, 0.05),
			&"tile": Vector2(0.62, 0.425),
			&"joint_width": 0.02,
			&"shift": 0.5,
			&"variety": 0.35,
			&"grain": 0.1,
		}
	)
	var yard := Plan.YARD
	_builder.add_rectangle(
		paving,
		yard.position + yard.size.z * Vector3.BACK,
		yard.size.x * Vector3.RIGHT,
		yard.size.z * Vector3.FORWARD
	)
	var stone := _make_look(Vector3(0.5, 0.46, 0.4), {&"variety": 0.25})
	_builder.add_box(stone, AABB(Vector3(3.5, 0.0, -1.9), Vector3(3.7, 0.75, 0.2)), "xy")
	_builder.add_box(stone, AABB(Vector3(5.35, 0.0, -1.35), Vector3(0.6, 0.55, 0.6)), "y")


# Metal as others reflect it. What moves is not among it, as captures are still.
func _add_reflected(parent: Node3D) -> void:
	var reflected := Builder.new(_still_light)
	var steel := _make_look(Vector3(0.5, 0.51, 0.53))
	reflected.add_box(steel, AABB(Vector3(1.08, 0.0, -1.7), Vector3(1.24, 2.05, 0.05)), "xXyYz")
	var copper := _make_look(Vector3(0.5, 0.3, 0.22))
	reflected.add_box(copper, AABB(Vector3(-1.95, 0.72, -1.6), Vector3(0.3, 0.46, 0.3)), "y")
	var blue := _make_look(Vector3(0.1, 0.2, 0.45))
	reflected.add_box(blue, AABB(Vector3(2.62, 0.72, -1.15), Vector3(0.4, 0.3, 0.36)), "y")
	reflected.build(parent, Layers.REFLECTED)


func _add_lamp(parent: Node3D) -> void:
	_glass = _make_look(Vector3(0.75, 0.7, 0.62))
	_looks.erase(_glass)
	var globe := SphereMesh.new()
	globe.radius = Plan.LAMP_RADIUS
	globe.height = 2.0 * Plan.LAMP_RADIUS
	globe.radial_segments = 32
	globe.rings = 16
	_add_mesh(parent, globe, Plan.LAMP, _glass)
	var cord := CylinderMesh.new()
	cord.top_radius = 0.012
	cord.bottom_radius = 0.012
	cord.height = Plan.HEIGHT - Plan.LAMP.y - Plan.LAMP_RADIUS
	cord.radial_segments = 8
	cord.rings = 1
	var black := _make_look(Vector3(0.03, 0.03, 0.03))
	_looks.erase(black)
	_add_mesh(
		parent, cord, Vector3(Plan.LAMP.x, Plan.HEIGHT - 0.5 * cord.height, Plan.LAMP.z), black
	)


static func _add_mesh(parent: Node3D, mesh: Mesh, at: Vector3, look: Material) -> void:
	var instance := MeshInstance3D.new()
	instance.mesh = mesh
	instance.position = at
	instance.material_override = look
	instance.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF
	instance.layers = Layers.COMMON
	parent.add_child(instance)
