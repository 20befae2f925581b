extends ComparisonMethod
## `stock`: Godot's own StandardMaterial3D under its own sky, of the same panorama.
##
## Metallic 1, white, nothing but reflected light. Roughness and anisotropy are what
## [method LobeMaterial3D.to_standard] makes of the widths; where the bitangent is wider, the flow
## map turns them. It is drawn on a mesh, because normals cannot be handed to the material, and by a
## camera so far away that the engine's directions to the viewer, which are those of a perspective
## camera, are parallel.
##
## What cannot be matched: the engine's BRDF is GGX, its albedo an approximation (0.83 at a
## roughness of 0.32), widths go to 10:1; its radiance map ends at 2 in Mobile (RGB10A2); in
## Compatibility the sky's linear texels are taken for sRGB.

const Widths := preload("res://addons/lobelight/runtime/widths.gd")
# The engine's directions to the viewer are off by the sphere's radius over this.
const _DISTANCE := 1000.0
# Chords so short that pictures of 256 pixels miss a hundredth of one at the edge.
const _RINGS := 128

## Of the engine's map; its default is 256.
var radiance_size := Sky.RADIANCE_SIZE_512

var _panorama: Texture2D
var _roughness := 0.0
var _anisotropy := 0.0
var _material: BaseMaterial3D


func prepare(stage: ComparisonStage) -> String:
	_panorama = stage.panorama
	var widths := Vector2(alpha[0], alpha[1])
	var is_turned := widths.y > widths.x
	var parameters := Widths.to_roughness(Vector2(widths.y, widths.x) if is_turned else widths)
	_roughness = parameters.x
	_anisotropy = minf(parameters.y, 1.0)
	var material := LobeMaterial3D.new()
	material.albedo = Color.WHITE
	material.metallic = 1.0
	material.roughness = _roughness
	material.anisotropy = _anisotropy
	material.anisotropy_rotation = 0.5 * PI if is_turned else 0.0
	_material = material.to_standard()
	# Where there is no ambient light, the engine takes reflections for occluded.
	_material.disable_specular_occlusion = true
	return ""


func make_sphere() -> MeshInstance3D:
	var mesh := SphereMesh.new()
	mesh.radius = 1.0
	mesh.height = 2.0
	mesh.rings = _RINGS
	mesh.radial_segments = 2 * _RINGS
	mesh.material = _material
	var sphere := MeshInstance3D.new()
	sphere.mesh = mesh
	return sphere


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
		"material": _material.get_class(),
		"roughness": _roughness,
		"anisotropy": _anisotropy,
		# RADIANCE_SIZE_32 is 0, each next one twice as large.
		"radiance_size": 32 << radiance_size,
		"sky": "the engine's, as it shows the panorama",
	}
