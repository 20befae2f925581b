extends RefCounted
## Two rooms in a row along x and the open behind them, of surfaces that shine by a formula: as a
## scene that probes capture, and as a reference that traces the rays of a ball through it.

const ROOMS := preload("two_rooms.gdshaderinc")
## The boxes' sizes and middles, as in two_rooms.gdshaderinc.
const SIZE := Vector3(3.0, 2.5, 3.4)
const MIDDLES: Array[Vector3] = [Vector3(-1.5, 0.0, 0.0), Vector3(1.5, 0.0, 0.0)]
## Where the ball is on its way, besides x.
const WAY := Vector3(0.0, -0.6, 0.1)
## What is captured.
const SCENE_LAYER := 1
const BALL_LAYER := 2
const REFERENCE_LAYER := 4
const RADIUS := 0.3

const _SKY_RADIUS := 900.0


## Rooms and sky as children of [param parent].
static func add_scene(parent: Node3D) -> void:
	var material := _make_material(
		"render_mode ambient_light_disabled, cull_disabled, shadows_disabled;",
		"""
varying highp vec3 place;
void vertex() { place = (MODEL_MATRIX * vec4(VERTEX, 1.0)).xyz; }
void fragment() {
	if (is_open(place)) discard;
	ALBEDO = vec3(0.0);
	SPECULAR = 0.0;
	EMISSION = lobelight_emission(dot(place, place) > 1e4 ? sky(normalize(place)) : wall(place));
}"""
	)
	for middle in MIDDLES:
		var box := BoxMesh.new()
		# Walls that rooms share are drawn for both.
		box.size = SIZE - 2e-3 * Vector3.ONE
		_add(parent, box, middle, material, SCENE_LAYER)
	var sphere := SphereMesh.new()
	sphere.radius = _SKY_RADIUS
	sphere.height = 2.0 * _SKY_RADIUS
	_add(parent, sphere, Vector3.ZERO, material, SCENE_LAYER)


## A probe in each room, and the sky's light everywhere else.
static func add_lights(parent: Node3D, blend_distance := 1.0) -> Array[LobeProbe3D]:
	var environment := LobeEnvironment3D.new()
	environment.source = LobeEnvironment3D.Source.CAPTURE
	environment.update_mode = LobeEnvironment3D.UpdateMode.ONCE
	environment.capture_cull_mask = SCENE_LAYER
	environment.capture_near = 100.0
	environment.size = 64
	parent.add_child(environment)
	var probes: Array[LobeProbe3D] = []
	for middle in MIDDLES:
		var probe := LobeProbe3D.new()
		probe.size = SIZE
		probe.position = middle
		probe.blend_distance = blend_distance
		probe.cull_mask = SCENE_LAYER
		probe.max_distance = 1000.0
		parent.add_child(probe)
		probes.append(probe)
	return probes


## The ball with a material that reflects all, GGX of a width.
static func add_ball(parent: Node3D, alpha: float) -> MeshInstance3D:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.albedo_color = Color.WHITE
	material.roughness = sqrt(alpha)
	return _add(parent, _make_ball(), WAY, material, BALL_LAYER)


## The same ball, lit by rays.
static func add_reference(parent: Node3D, alpha: float) -> MeshInstance3D:
	var material := _make_material(
		"render_mode ambient_light_disabled, shadows_disabled;",
		"""
uniform float alpha;
varying highp vec3 place;
varying highp vec3 facing;
void vertex() {
	place = (MODEL_MATRIX * vec4(VERTEX, 1.0)).xyz;
	facing = mat3(MODEL_MATRIX) * NORMAL;
}
void fragment() {
	ALBEDO = vec3(0.0);
	SPECULAR = 0.0;
	// The camera looks along -z.
	EMISSION = lobelight_emission(reflected(place, normalize(facing), vec3(0.0, 0.0, 1.0), alpha));
}"""
	)
	material.set_shader_parameter(&"alpha", alpha)
	return _add(parent, _make_ball(), WAY, material, REFERENCE_LAYER)


## A camera for a picture of the ball alone, which is as large as the picture.
static func make_camera(layer: int) -> Camera3D:
	var camera := Camera3D.new()
	camera.projection = Camera3D.PROJECTION_ORTHOGONAL
	camera.size = 2.0 * RADIUS
	camera.near = 0.01
	camera.cull_mask = layer
	camera.environment = Environment.new()
	camera.environment.background_mode = Environment.BG_COLOR
	camera.environment.background_color = Color.BLACK
	return camera


static func _make_ball() -> SphereMesh:
	var mesh := SphereMesh.new()
	mesh.radius = RADIUS
	mesh.height = 2.0 * RADIUS
	return mesh


static func _make_material(modes: String, functions: String) -> ShaderMaterial:
	var material := ShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = (
		'shader_type spatial;\n%s\n#include "%s"\n%s' % [modes, ROOMS.resource_path, functions]
	)
	return material


static func _add(
	parent: Node3D, mesh: Mesh, at: Vector3, material: Material, layer: int
) -> MeshInstance3D:
	var instance := MeshInstance3D.new()
	instance.mesh = mesh
	instance.position = at
	instance.material_override = material
	instance.layers = layer
	instance.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF
	parent.add_child(instance)
	return instance
