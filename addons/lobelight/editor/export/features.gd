@tool
extends RefCounted
## Which features with files of their own the project's files can reach.
##
## A feature that a script so much as names counts as reached, and so do those in the metadata
## [code]lobelight_features[/code] of a scene's root, an array of their names.

const DiffuseSource := preload("../../runtime/light/diffuse_source.gd")
const LobeEnvironment := preload("../../runtime/light/lobe_environment_3d.gd")
const LightSettings := preload("../../runtime/light/light_settings.gd")
const LobeProbe := preload("../../runtime/probes/lobe_probe_3d.gd")
const OnDemand := preload("../../runtime/on_demand.gd")
const TableChoice := preload("../../runtime/material/table_choice.gd")

const RUN_TIME := "res://addons/lobelight/runtime/"
## What shaders of one's own include.
const FOR_OTHERS := "res://addons/lobelight/lobelight.gdshaderinc"
const DECLARATION := "metadata/lobelight_features"
const COAT := "clear coats"
const DIFFUSE := "diffuse light"
const OCCLUSION := "occlusion of reflections"
const DETAIL := "detail textures"
const MSDF := "distance fields"
const PARALLAX := "height maps"
const TRIPLANAR := "triplanar mapping"
const VERTICES := "billboards and moved vertices"
const SHEEN := "sheen"
const GLTF := "import of glTF files"
const FADES := "fades and refraction"
const LAMPS := "rims, back light and light below the surface"
const FROZEN := "materials that nothing changes"
const NODES := "nodes of visual shaders"
const WARNINGS := "warnings, which the editor shows"

## Folders of the run time that nothing but the feature needs. Each of them stays or goes whole.
const FOLDERS: Dictionary[String, String] = {
	"antialiasing": OnDemand.ANTIALIASING,
	"clear_coat": COAT,
	"compatibility": OnDemand.COMPATIBILITY,
	"conversion": OnDemand.CONVERSION,
	"detail": DETAIL,
	"diffuse": DIFFUSE,
	"fades": FADES,
	"frozen": FROZEN,
	"engine_light": OnDemand.ENGINE_LIGHT,
	"filters": OnDemand.FILTERS,
	"mixing": OnDemand.MIXING,
	"own_shaders": OnDemand.OWN_SHADERS,
	"occlusion": OCCLUSION,
	"msdf": MSDF,
	"parallax": PARALLAX,
	"lamps": LAMPS,
	"line": OnDemand.LINES,
	"live": OnDemand.LIVE,
	"probes": OnDemand.PLACES,
	"sheen": SHEEN,
	"sources": OnDemand.SOURCES,
	"gltf": GLTF,
	"rendering_device": OnDemand.RENDERING_DEVICE,
	"skies": OnDemand.SKIES,
	"triplanar": TRIPLANAR,
	"vertices": VERTICES,
	"visual_shader": NODES,
	"warnings": WARNINGS,
}
## What shaders that others share ask for where they are to draw the feature.
const DEFINES: Dictionary[String, String] = {
	OnDemand.ANTIALIASING: "LOBELIGHT_ANTIALIASED",
	DIFFUSE: "LOBELIGHT_DIFFUSE",
	DETAIL: "LOBELIGHT_DETAIL",
	MSDF: "LOBELIGHT_MSDF",
	PARALLAX: "LOBELIGHT_PARALLAX",
	OCCLUSION: "LOBELIGHT_OCCLUDED",
	OnDemand.ENGINE_LIGHT: "LOBELIGHT_ENGINE",
	OnDemand.LINES: "LOBELIGHT_LINE",
	OnDemand.PLACES: "LOBELIGHT_PLACED",
	SHEEN: "LOBELIGHT_SHEEN",
	OnDemand.SOURCES: "LOBELIGHT_SOURCES",
	TRIPLANAR: "LOBELIGHT_TRIPLANAR",
	VERTICES: "LOBELIGHT_VERTICES",
}
# What scripts and animations name where they may ask for it.
const _WORDS: Dictionary[String, String] = {
	COAT: "clearcoat\\w*",
	DIFFUSE: "metallic|metallic_texture|orm_texture",
	OnDemand.ANTIALIASING: "bake_normal_variance|specular_antialiasing|normal_(enabled|texture)",
	OCCLUSION: "ao_enabled|ao_texture|orm_texture|normal_enabled|normal_texture",
	SHEEN: "sheen_\\w+",
	FADES: "\\w+_fade_\\w+|refraction_\\w+",
	LAMPS: "(rim|backlight|subsurf_scatter)_\\w+",
	OnDemand.ENGINE_LIGHT:
	"diffuse_light|sdfgi_enabled|ssao_enabled|ssil_enabled|VoxelGI|LightmapGI|ReflectionProbe",
	OnDemand.FILTERS: "filter",
	OnDemand.LINES: "roughness|anisotropy(_enabled)?|Quality\\.(AUTOMATIC|LOBES_\\d+)",
	OnDemand.MIXING: "roughness|anisotropy",
	OnDemand.SKIES: "source|panorama|LobeEnvironment3D|LobeProbe3D",
	OnDemand.LIVE: "source|panorama|LobeEnvironment3D",
	OnDemand.SOURCES: "source|sources|max_sources|panorama|LobeEnvironment3D",
	GLTF: "LobeGLTFExtension",
	OnDemand.CONVERSION: "LobeGLTFExtension|from_standard|to_standard|get_losses_from",
	OnDemand.OWN_SHADERS:
	(
		"LobeLight\\s*\\.\\s*(un)?bind|lobe_light(?=\\.gd)|(?<=[\"'])(un)?bind(?=[\"'])"
		+ "|LobeShaderMaterial|lobe_shader_material(?=\\.gd)|lobelight(?=\\.gdshaderinc)"
	),
	OnDemand.PLACES: "LobeProbe3D|own_world_3d|world_3d|fade_time",
	DETAIL: "detail_\\w+",
	MSDF: "albedo_texture_msdf|msdf_\\w+",
	PARALLAX: "heightmap_\\w+",
	TRIPLANAR: "uv[12]_(world_)?triplanar\\w*",
	VERTICES:
	(
		"billboard_\\w+|particles_anim_\\w+|grow|grow_amount|fixed_size|(use_)?point_size"
		+ "|(use_)?z_clip_scale|(use_)?fov_override"
	),
}
# What a material has that a script gives its properties.
const _OF_MATERIALS: PackedStringArray = [
	OnDemand.ANTIALIASING,
	COAT,
	DETAIL,
	DIFFUSE,
	FADES,
	LAMPS,
	OnDemand.LINES,
	MSDF,
	OnDemand.MIXING,
	OCCLUSION,
	PARALLAX,
	SHEEN,
	TRIPLANAR,
	VERTICES
]
const _METHOD := "rendering/renderer/rendering_method"
const _FALLBACK := "rendering/rendering_device/fallback_to_opengl3"

## By feature: who needs it.
var reached: Dictionary[String, String] = {}
## The same of what scenes say themselves.
var declared: Dictionary[String, String] = {}
## Of each [LobeEnvironment3D] in a scene, [file, properties].
var environments: Array[Array] = []
## The same of those that show a baked light.
var baked: Array[Array] = []
## Who may give one another size or panorama, in a sentence; empty if nobody does.
var resizing := ""

var _words: Dictionary[String, RegEx] = {}
# Not what is given a vector: that is of another class.
var _resizing := RegEx.create_from_string(
	(
		"\\b(panorama|LobeEnvironment3D)\\b|\\.size\\s*[-+*/]?=(?!=)(?!\\s*Vector)"
		+ "|(?<!get\\()(?<!get\\(&)[\"':]size\\b"
	)
)


## The feature that a file belongs to; empty if it goes along without one.
static func of_file(path: String) -> String:
	if path == FOR_OTHERS:
		return OnDemand.OWN_SHADERS
	return FOLDERS.get(path.trim_prefix(RUN_TIME).get_slice("/", 0), "")


func _init() -> void:
	for feature in _WORDS:
		_words[feature] = RegEx.create_from_string("\\b(%s)\\b" % _WORDS[feature])


## For what may set any property.
func add_all(file: String) -> void:
	for feature in _OF_MATERIALS:
		add(feature, file)
	add(OnDemand.ENGINE_LIGHT, file)
	add(OnDemand.FILTERS, file)
	add(OnDemand.LIVE, file)
	add(OnDemand.SKIES, file)
	add(OnDemand.SOURCES, file)
	resizing = "%s may change environments" % file


## What every renderer needs that the project's settings choose for some system, and what else they
## ask for.
func look_at_settings() -> void:
	for property in ProjectSettings.get_property_list():
		var setting: String = property["name"]
		if setting.begins_with(_METHOD):
			var is_compatibility: bool = ProjectSettings.get_setting(setting) == "gl_compatibility"
			add(OnDemand.COMPATIBILITY if is_compatibility else OnDemand.RENDERING_DEVICE, setting)
	if ProjectSettings.get_setting(_FALLBACK, true):
		add(OnDemand.COMPATIBILITY, _FALLBACK)
	if ProjectSettings.get_setting(DiffuseSource.SETTING, 0) == DiffuseSource.Source.ENGINE:
		add(OnDemand.ENGINE_LIGHT, DiffuseSource.SETTING)


func look_at_material(file: String, material: LobeMaterial3D) -> void:
	if material.is_coated():
		add(COAT, file)
	if material.is_dielectric():
		add(DIFFUSE, file)
	if material.is_antialiased():
		add(OnDemand.ANTIALIASING, file)
	if material.occludes_reflections():
		add(OCCLUSION, file)
	var brushing := material.get_shown_anisotropy()
	if TableChoice.find_line(material, material.roughness, brushing).count > 0:
		add(OnDemand.LINES, file)
	if material.detail_enabled:
		add(DETAIL, file)
	if material.shows_msdf():
		add(MSDF, file)
	if material.has_relief():
		add(PARALLAX, file)
	if material.makes_tangents():
		add(TRIPLANAR, file)
	if material.moves_vertices():
		add(VERTICES, file)
	if material.has_sheen():
		add(SHEEN, file)
	if material.has_fades():
		add(FADES, file)
	if material.has_lamp_effects():
		add(LAMPS, file)
	if material.diffuse_light == LobeMaterial3D.DiffuseLight.ENGINE:
		add(OnDemand.ENGINE_LIGHT, file)


## A light that is saved.
func look_at_light(file: String, light: LobeLight) -> void:
	if light.sources != null:
		add(OnDemand.SOURCES, file)


## What of the engine may light or occlude materials.
func look_at_resource(file: String, resource: Resource) -> void:
	var acts := resource is LightmapGIData or resource is VoxelGIData
	var environment := resource as Environment
	if environment != null:
		acts = environment.sdfgi_enabled or environment.ssao_enabled or environment.ssil_enabled
	if acts:
		add(OnDemand.ENGINE_LIGHT, file)


## A line of a script, or the path of an animation's track.
func read_line(file: String, line: String) -> void:
	for feature in _words:
		if _words[feature].search(line) != null:
			add(feature, file)
	if _resizing.search(line) != null:
		resizing = "%s may change environments" % file


## A node of a scene, by the properties that are not at their defaults.
func look_at_node(file: String, properties: Dictionary, type: StringName) -> void:
	if type == &"ReflectionProbe":
		add(OnDemand.ENGINE_LIGHT, file)
	if type.is_empty():
		# What it is an instance of is seen elsewhere; here something of it is changed.
		read_line(file, ":" + " :".join(PackedStringArray(properties.keys())))
		return
	for feature: String in properties.get(DECLARATION, []):
		declared[feature] = file
		add(feature, file)
	if properties.get("own_world_3d", false) or properties.has("world_3d"):
		add(OnDemand.PLACES, file)
	var script: Script = properties.get("script") as Script
	while script != null and script != LobeEnvironment and script != LobeProbe:
		script = script.get_base_script()
	if script == null:
		return
	if script == LobeProbe:
		add(OnDemand.PLACES, file)
		# Unless its light was baked.
		if properties.get("light") == null:
			add(OnDemand.SKIES, file)
		return
	if properties.get("fade_time", 0.0) > 0.0:
		add(OnDemand.PLACES, file)
	# Unless its light was baked.
	if properties.get("light") != null:
		baked.append([file, properties])
		return
	add(OnDemand.LIVE, file)
	if properties.get("max_sources", LightSettings.MAX_SOURCES) > 0:
		add(OnDemand.SOURCES, file)
	environments.append([file, properties])
	var source: int = properties.get("source", LobeEnvironment3D.Source.AUTOMATIC)
	var has_panorama := properties.get("panorama") is Texture2D
	source = LightSettings.decide(source as LightSettings.Source, has_panorama)
	if source != LightSettings.Source.PANORAMA:
		add(OnDemand.SKIES, file)
	var filter: int = properties.get("filter", LobeEnvironment3D.Filter.DISC)
	if filter == LobeEnvironment3D.Filter.BOX or filter == LobeEnvironment3D.Filter.BINOMIAL:
		add(OnDemand.FILTERS, file)


## The feature is reached by a file, or a setting.
func add(feature: String, file: String) -> void:
	if not reached.has(feature):
		reached[feature] = file
