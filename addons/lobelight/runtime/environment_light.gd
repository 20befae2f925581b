extends RefCounted
## The light of an environment as the shaders take it: a pyramid, a rotation and a factor.

## Half-float cube map with all its mip levels, linear radiance.
var cubemap: Cubemap
## Texels along the side of a face.
var size := 1
## c in shaders/environment.gdshaderinc: how much the levels blur.
var level_variance := 0.25
## From the environment to the world; orthonormal.
var rotation := Basis.IDENTITY
var energy := 1.0


## Hands the light to a material of the rendering server.
func apply(material: RID) -> void:
	var level := Vector2(size * size / (4.0 * level_variance), 1.0 - 1.0 / (6.0 * level_variance))
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
