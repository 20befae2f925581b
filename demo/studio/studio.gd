extends Node3D
## The live environment: a dark studio with soft boxes, strips of light, and a lamp that moves.

const GlowShader := preload("glow.gdshader")
const Layers := preload("../layers.gd")
const _LAMP_RADIUS := 0.42
# So near and high that it is never between the camera and the objects.
const _ORBIT := 2.9

var _lamp: MeshInstance3D


func _ready() -> void:
	_add_dome()
	# Position, size, radiance.
	_add_panel(Vector3(-5.5, 3.2, 1.5), Vector2(3.6, 2.6), Vector3(3.2, 3.0, 2.7))
	_add_panel(Vector3(5.8, 2.2, -1.0), Vector2(0.7, 4.4), Vector3(1.6, 2.2, 3.4))
	_add_panel(Vector3(4.6, 1.6, 4.6), Vector2(0.5, 3.6), Vector3(3.4, 2.0, 1.1))
	_add_panel(Vector3(0.4, 6.2, -0.6), Vector2(4.2, 2.4), Vector3(2.2, 2.3, 2.5))
	_add_panel(Vector3(-3.2, 2.4, -6.5), Vector2(0.4, 4.2), Vector3(2.6, 0.9, 0.7))
	_add_panel(Vector3(2.2, 2.6, -6.8), Vector2(0.4, 4.6), Vector3(0.6, 1.5, 2.6))
	var sphere := SphereMesh.new()
	sphere.radius = _LAMP_RADIUS
	sphere.height = 2.0 * _LAMP_RADIUS
	_lamp = _add(sphere, Vector3(34.0, 29.0, 21.0), Vector3(34.0, 29.0, 21.0), Vector2(-1.0, 1.0))
	turn_lamp(0.0)


## Where the lamp is on its orbit, in radians.
func turn_lamp(angle: float) -> void:
	if _lamp != null:
		var height := 3.0 + 0.4 * sin(2.0 * angle)
		_lamp.position = Vector3(_ORBIT * sin(angle), height, _ORBIT * cos(angle))


func _add_dome() -> void:
	var dome := SphereMesh.new()
	dome.radius = 40.0
	dome.height = 80.0
	_add(dome, Vector3(0.012, 0.012, 0.014), Vector3(0.09, 0.1, 0.13), Vector2(-8.0, 26.0))


func _add_panel(at: Vector3, size: Vector2, radiance: Vector3) -> void:
	var quad := QuadMesh.new()
	quad.size = size
	var panel := _add(quad, 0.55 * radiance, radiance, 0.5 * size.y * Vector2(-1.0, 1.0))
	panel.look_at_from_position(
		at, Vector3(0.0, 0.6, 0.0), Vector3.BACK if at.y > 5.0 else Vector3.UP
	)


func _add(mesh: Mesh, lower: Vector3, upper: Vector3, heights: Vector2) -> MeshInstance3D:
	var glow := ShaderMaterial.new()
	glow.shader = GlowShader
	glow.set_shader_parameter(&"lower", lower)
	glow.set_shader_parameter(&"upper", upper)
	glow.set_shader_parameter(&"heights", heights)
	var instance := MeshInstance3D.new()
	instance.mesh = mesh
	instance.material_override = glow
	instance.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF
	instance.layers = Layers.STUDIO
	add_child(instance)
	return instance
