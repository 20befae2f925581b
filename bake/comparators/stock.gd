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
# For reflection probes: one, its faces as large as help, and its levels made of more samples.
const _PROBE_SETTINGS: Dictionary[String, int] = {
	"rendering/reflections/reflection_atlas/reflection_count": 1,
	"rendering/reflections/reflection_atlas/reflection_size": 512,
	"rendering/reflections/sky_reflections/ggx_samples": 128,
}
const _PROBE_FRAMES := 40

## Of the engine's map; its default is 256.
var radiance_size := Sky.RADIANCE_SIZE_512

var _panorama: Texture2D
var _roughness := 0.0
var _anisotropy := 0.0
var _is_turned := false
# The project's own, while the ones for probes are set.
var _settings_before: Dictionary[String, Variant] = {}


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE:
		for setting: String in _settings_before:
			ProjectSettings.set_setting(setting, _settings_before[setting])


func prepare(stage: ComparisonStage) -> String:
	_panorama = stage.panorama
	var widths := Vector2(alpha[0], alpha[1])
	_is_turned = widths.y > widths.x
	var parameters := Widths.to_roughness(Vector2(widths.y, widths.x) if _is_turned else widths)
	_roughness = parameters.x
	_anisotropy = minf(parameters.y, 1.0)
	if room != null:
		# Read when a world is made: the viewport's comes later. Worlds of others, which may have more
		# probes, have the project's again.
		for setting: String in _PROBE_SETTINGS:
			_settings_before[setting] = ProjectSettings.get_setting(setting)
			ProjectSettings.set_setting(setting, _PROBE_SETTINGS[setting])
	return ""


func make_sphere() -> MeshInstance3D:
	var material := ShaderMaterial.new()
	material.shader = Shader.new()
	# What is not written is not in the compiled shader: an isotropic one is without anisotropy.
	var defines := "#define STOCK_ANISOTROPIC\n" if _anisotropy > 0.0 else ""
	if room != null:
		defines += "#define STOCK_IN_ROOM\n"
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
	var centre := Vector3.ZERO
	var radius := 1.0
	if room != null:
		centre = room.centre
		radius = room.radius
		viewport.add_child(room.make_walls())
		viewport.add_child(_make_probe())
	else:
		_set_sky(viewport)
	viewport.camera.position = centre + Vector3(0.0, 0.0, _DISTANCE)
	viewport.camera.set_orthogonal(2.0 * radius, _DISTANCE - 2.0, _DISTANCE + 2.0)


func settle(viewport: LinearViewport) -> void:
	if room == null:
		return
	# The probe's faces and levels are drawn one after the other, in frames of their own.
	viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	for frame in _PROBE_FRAMES:
		await RenderingServer.frame_post_draw
	viewport.render_target_update_mode = SubViewport.UPDATE_DISABLED


# Box projection, nothing but the walls, no fading towards them, and the filtering of probes that
# are drawn once, which is the engine's best.
func _make_probe() -> ReflectionProbe:
	var probe := ReflectionProbe.new()
	probe.size = room.size
	probe.origin_offset = room.probe
	probe.box_projection = true
	probe.interior = true
	probe.blend_distance = 0.0
	probe.ambient_mode = ReflectionProbe.AMBIENT_DISABLED
	probe.cull_mask = CompareRoom.WALL_LAYER
	probe.update_mode = ReflectionProbe.UPDATE_ONCE
	return probe


func _set_sky(viewport: LinearViewport) -> void:
	var sky_material := PanoramaSkyMaterial.new()
	sky_material.panorama = _panorama
	var surroundings := viewport.camera.environment
	surroundings.sky = Sky.new()
	surroundings.sky.sky_material = sky_material
	surroundings.sky.radiance_size = radiance_size
	surroundings.sky.process_mode = Sky.PROCESS_MODE_QUALITY
	surroundings.reflected_light_source = Environment.REFLECTION_SOURCE_SKY


## What the engine does with its map, seen from the shader: one look-up in a map of blurred levels,
## between two of which it may mix, and one in a table.
func cost() -> Dictionary:
	return {"fetches": 1, "probes": 1, "table_fetches": 1}


func settings() -> Dictionary:
	if room != null:
		return {
			"shader": "as StandardMaterial3D makes it, on the methods' quad",
			"roughness": _roughness,
			"anisotropy": _anisotropy,
			"reflection_size": _PROBE_SETTINGS.values()[1],
			"probe": "an interior ReflectionProbe with box projection, drawn once",
		}
	return {
		"shader": "as StandardMaterial3D makes it, on the methods' quad",
		"roughness": _roughness,
		"anisotropy": _anisotropy,
		# RADIANCE_SIZE_32 is 0, each next one twice as large.
		"radiance_size": 32 << radiance_size,
		"sky": "the engine's, as it shows the panorama",
	}
