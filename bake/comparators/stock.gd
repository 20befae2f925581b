extends ComparisonMethod
## `stock`: Godot's own StandardMaterial3D under its own sky, of the same panorama.
##
## Metallic 1, white, nothing but reflected light, by a shader that hands the engine's lighting what
## StandardMaterial3D's does, on the quad that all methods are drawn on.
## Roughness and anisotropy have the widths as [LobeMaterial3D] does; where the bitangent is wider,
## the flow turns them. The camera is so far away that the engine's directions to the viewer, which
## are those of a perspective camera, are parallel.
##
## What cannot be matched: the engine's BRDF is GGX, its albedo an approximation (0.83 at a
## roughness of 0.32), widths go to 10:1; its radiance map ends at 2 in Mobile (RGB10A2); in
## Compatibility the sky's linear texels are taken for sRGB.

const FRAGMENT_PATH := "res://bake/comparators/stock.gdshaderinc"
const Widths := preload("res://addons/lobelight/runtime/table/widths.gd")
# The engine's directions to the viewer are off by the sphere's radius over this.
const _DISTANCE := 1000.0
## Of the engine's map; its default is 256.
var radiance_size := Sky.RADIANCE_SIZE_512

var _panorama: Texture2D
var _roughness := 0.0
var _anisotropy := 0.0
var _is_turned := false


func prepare(stage: ComparisonStage) -> String:
	_panorama = stage.panorama
	var widths := Vector2(alpha[0], alpha[1])
	_is_turned = widths.y > widths.x
	var parameters := Widths.to_roughness(Vector2(widths.y, widths.x) if _is_turned else widths)
	_roughness = parameters.x
	_anisotropy = minf(parameters.y, 1.0)
	return ""


func make_sphere() -> MeshInstance3D:
	var material := ShaderMaterial.new()
	material.shader = Shader.new()
	# What is not written is not in the compiled shader: an isotropic one is without anisotropy.
	var defines := "#define STOCK_ANISOTROPIC\n" if _anisotropy > 0.0 else ""
	material.shader.code = (
		'shader_type spatial;\nrender_mode specular_schlick_ggx, %s;\n%s#include "%s"\n'
		% ["specular_occlusion_disabled", defines, FRAGMENT_PATH]
	)
	material.set_shader_parameter(&"stock_metallic", 1.0)
	material.set_shader_parameter(&"stock_roughness", _roughness)
	material.set_shader_parameter(&"stock_anisotropy", _anisotropy)
	material.set_shader_parameter(&"stock_flow", Vector2.DOWN if _is_turned else Vector2.RIGHT)
	return SphereImpostor.make_quad(material)


func set_up_viewport(viewport: LinearViewport) -> void:
	var sky_material := PanoramaSkyMaterial.new()
	sky_material.panorama = _panorama
	var surroundings := viewport.camera.environment
	surroundings.sky = Sky.new()
	surroundings.sky.sky_material = sky_material
	surroundings.sky.radiance_size = radiance_size
	surroundings.sky.process_mode = Sky.PROCESS_MODE_QUALITY
	surroundings.reflected_light_source = Environment.REFLECTION_SOURCE_SKY
	viewport.camera.position = Vector3(0.0, 0.0, _DISTANCE)
	viewport.camera.set_orthogonal(2.0, _DISTANCE - 2.0, _DISTANCE + 2.0)


## What the engine does with its map, seen from the shader: one look-up in a map of blurred levels,
## between two of which it may mix, and one in a table.
func cost() -> Dictionary:
	return {"fetches": 1, "probes": 1, "table_fetches": 1}


func settings() -> Dictionary:
	return {
		"shader": "as StandardMaterial3D makes it, on the methods' quad",
		"roughness": _roughness,
		"anisotropy": _anisotropy,
		# RADIANCE_SIZE_32 is 0, each next one twice as large.
		"radiance_size": 32 << radiance_size,
		"sky": "the engine's, as it shows the panorama",
	}
