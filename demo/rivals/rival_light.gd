extends RefCounted
## The surroundings as the other methods take them: a cube map with mip levels.

const Pyramid := preload("res://addons/lobelight/runtime/pyramid/pyramid.gd")

var cubemap: TextureLayered
## Texels along the side of a face.
var size := 1
## Whether the levels blur alike in all directions; otherwise they are means of 2 × 2 texels.
var is_round := false


## A panorama with means of 2 × 2 texels, as the methods were published with; null where there is
## no renderer. To be awaited.
static func of_panorama(panorama: Texture2D) -> RefCounted:
	if not Pyramid.has_renderer():
		return null
	var environment := LobeEnvironment3D.new()
	environment.filter = LobeEnvironment3D.Filter.BOX
	environment.panorama = panorama
	# The methods have no suns and lamps apart from their map.
	environment.max_sources = 0
	var made: RefCounted = null
	if await environment.rebuild():
		made = new()
		made.cubemap = environment.get_cubemap()
		made.size = made.cubemap.get_width()
	environment.free()
	return made


## The map that [param environment] lights the scene with.
static func of_environment(environment: LobeEnvironment3D) -> RefCounted:
	if environment.get_cubemap() == null:
		return null
	var made := new()
	made.cubemap = environment.get_cubemap()
	made.size = made.cubemap.get_width()
	made.is_round = Pyramid.is_round(environment.filter as Pyramid.Filter)
	return made


## Published rules for levels are for 2 × 2 means, whose level l blurs by (1/12 + 1/6) 4^l of a
## texel's solid angle; here it is (c + 1/6) 4^l, c as in shaders/environment.gdshaderinc. The
## rules' solid angles times this ask for the level that blurs as much.
func box_share() -> float:
	var box := Pyramid.LEVEL_VARIANCES[Pyramid.Filter.BOX] + 1.0 / 6.0
	var filter := Pyramid.Filter.DISC if is_round else Pyramid.Filter.BOX
	return box / (Pyramid.LEVEL_VARIANCES[filter] + 1.0 / 6.0)
