@tool
extends Object
## Converts numbers of a [LobeMaterial3D] to those that its shader takes.


static func linear(colour: Color) -> Vector3:
	var decoded := colour.srgb_to_linear()
	return Vector3(decoded.r, decoded.g, decoded.b)


## What is reflected at normal incidence by what is no metal, and the share of it that the engine's
## lamps show at the rim: what reflects less than 2 % is taken for occluded (Godot 4.6,
## scene_forward_lights_inc.glsl, F0 and light_compute).
static func dielectric(specular: float) -> Vector2:
	var f0 := 0.16 * specular * specular
	return Vector2(f0, minf(50.0 * f0, 1.0))


## The light that is sent out, and the factor of the texture's.
static func emitted(colour: Color, energy: float, multiplies: bool) -> PackedVector3Array:
	var light := linear(colour) * energy
	return [Vector3.ZERO, light] if multiplies else [light, energy * Vector3.ONE]


## Of texture coordinates.
static func transform(scale: Vector3, offset: Vector3) -> Vector4:
	return Vector4(scale.x, scale.y, offset.x, offset.y)


## Godot's own unit of heights is a hundredth.
static func relief(scale: float) -> float:
	return 0.01 * scale


## Of half a field of view in degrees.
static func cotangent(fov: float) -> float:
	return 1.0 / tan(deg_to_rad(0.5 * fov))
