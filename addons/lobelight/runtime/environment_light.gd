@tool
extends RefCounted
## The light of an environment as the shaders take it: a pyramid, a rotation and a factor.

## Half-float cube map with all its mip levels, linear radiance.
var cubemap: TextureLayered
## Texels along the side of a face.
var size := 1
## How much the levels blur: c in shaders/environment.gdshaderinc.
var level_variance := 1.0 / 12.0
## How much level 0 is blurred: b in shaders/environment.gdshaderinc.
var base_variance := 0.0
## Whether they blur alike in all directions, rather than as the texels of the cube are stretched.
var is_even := false
## From the environment to the world; orthonormal.
var rotation := Basis.IDENTITY
var energy := 1.0


## Hands the light to a material of the rendering server.
func apply(material: RID) -> void:
	var level := Vector4(0.25 * size * size, level_variance, 1.0 if is_even else 0.0, base_variance)
	var server := RenderingServer
	server.material_set_param(material, &"lobelight_environment", cubemap.get_rid())
	server.material_set_param(material, &"lobelight_environment_level", level)
	apply_placement(material)


## The same for what may change from one frame to the next.
func apply_placement(material: RID) -> void:
	var server := RenderingServer
	var to_environment := rotation.transposed()
	server.material_set_param(material, &"lobelight_environment_rotation", to_environment)
	server.material_set_param(material, &"lobelight_environment_energy", energy)
