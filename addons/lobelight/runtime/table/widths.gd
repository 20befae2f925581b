@tool
extends Object
## Between Godot's roughness and anisotropy and the widths of a BRDF.

## Where the widths are 100:1.
const MAX_ANISOTROPY := 1.1
# Godot's, from Burley 2012, "Physically-Based Shading at Disney", B.1.
const _STRENGTH := 0.9


## Widths along the tangent and the bitangent: r² / aspect and r² · aspect,
## aspect = √(1 − 0.9 anisotropy) (Godot 4.6, scene_forward_lights_inc.glsl, light_compute).
static func from_roughness(roughness: float, anisotropy: float) -> Vector2:
	var mean := roughness * roughness
	var aspect := sqrt(maxf(1.0 - _STRENGTH * anisotropy, 0.01))
	return Vector2(mean / aspect, mean * aspect)


## The roughness and the anisotropy that have these widths.
static func to_roughness(widths: Vector2) -> Vector2:
	var roughness := pow(widths.x * widths.y, 0.25)
	return Vector2(roughness, (1.0 - widths.y / widths.x) / _STRENGTH)


## The positive anisotropy that has the widths of a negative one, exchanged.
static func exchanged(anisotropy: float) -> float:
	return -anisotropy / (1.0 - _STRENGTH * anisotropy)


## The width of a clear coat (Godot 4.6, scene_forward_lights_inc.glsl, LIGHT_CLEARCOAT_USED).
static func from_coat_roughness(roughness: float) -> float:
	return lerpf(0.001, 0.1, roughness)
