@tool
extends RefCounted
## The light of an environment as the shaders take it: a pyramid, a rotation and a factor.

# A unit vector's largest component is at least this.
const _LEAST_COMPONENT := 0.57735027

## Half-float cube map with all its mip levels, linear radiance.
var cubemap: TextureLayered
## Texels along the side of a face.
var size := 1
## How much the levels blur: c in shaders/environment.gdshaderinc; at first that of 2 × 2 means.
var level_variance := 1.0 / 12.0
## How much level 0 is blurred: b in shaders/environment.gdshaderinc.
var base_variance := 0.0
## Whether they blur alike in all directions, rather than as the texels of the cube are stretched;
## if not, materials need LOBELIGHT_STRETCHED_LEVELS.
var is_even := false
## From the environment to the world; orthonormal.
var rotation := Basis.IDENTITY
var energy := 1.0


## No light, at levels that blur alike in all directions or not.
static func make_dark(even: bool) -> RefCounted:
	var light := new()
	light.cubemap = Cubemap.new()
	var faces: Array[Image] = []
	for face in 6:
		faces.append(Image.create_empty(1, 1, false, Image.FORMAT_RGBAH))
	light.cubemap.create_from_images(faces)
	light.is_even = even
	light.energy = 0.0
	return light


## Hands the light to a material of the rendering server.
func apply(material: RID) -> void:
	var server := RenderingServer
	server.material_set_param(material, &"lobelight_environment", cubemap.get_rid())
	server.material_set_param(material, &"lobelight_environment_sharpest", _get_sharpest())
	server.material_set_param(material, &"lobelight_environment_level", _get_level())
	apply_placement(material)


## The same for what may change from one frame to the next.
func apply_placement(material: RID) -> void:
	var server := RenderingServer
	var to_environment := rotation.transposed()
	server.material_set_param(material, &"lobelight_environment_rotation", to_environment)
	server.material_set_param(material, &"lobelight_environment_energy", energy)


# Of the formula in shaders/environment.gdshaderinc, s; of stretched levels a line through its ends.
func _get_sharpest() -> Vector2:
	var texel := 4.0 / (size * size)
	var slope := 0.0
	if not is_even:
		slope = level_variance * (1.0 - pow(_LEAST_COMPONENT, 3.0)) / (1.0 - _LEAST_COMPONENT)
	return texel * Vector2(level_variance - base_variance - slope, slope)


# Of the same, k; of stretched levels a parabola through its ends and its middle.
func _get_level() -> Vector3:
	if is_even:
		return Vector3(_get_level_at(1.0), 0.0, 0.0)
	var middle := 0.5 * (_LEAST_COMPONENT + 1.0)
	var first := _get_level_at(_LEAST_COMPONENT)
	var last := _get_level_at(1.0)
	var slope := (last - first) / (1.0 - _LEAST_COMPONENT)
	# Newton's divided differences.
	var bend := slope - (_get_level_at(middle) - first) / (middle - _LEAST_COMPONENT)
	bend /= 1.0 - middle
	var linear := slope - bend * (_LEAST_COMPONENT + 1.0)
	return Vector3(last - linear - bend, linear, bend)


func _get_level_at(component: float) -> float:
	var texel := 4.0 / (size * size) * pow(component, 3.0)
	return -0.5 * log(texel * (level_variance + 1.0 / 6.0)) / log(2.0)
