@tool
extends RefCounted
## Which features with shaders of their own the project's files can reach.
##
## A feature that a script so much as names counts as reached.

const LobeEnvironment := preload("../../runtime/lobe_environment_3d.gd")
const MaterialShader := preload("../../runtime/material_shader.gd")

## Shaders below runtime/shaders that nothing but the feature draws with.
const SHADERS: Dictionary[String, String] = {
	"clear_coat.gdshaderinc": "a clear coat",
	"diffuse.gdshaderinc": "diffuse light",
	"pyramid_reduce.gdshader": "the filters Box and Binomial",
	"pyramid_views.gdshader": "light of a sky or a captured scene",
}
# What scripts and animations name where they may ask for it.
const _WORDS: Dictionary[String, String] = {
	"clear_coat.gdshaderinc": "clearcoat\\w*",
	"diffuse.gdshaderinc": "metallic|metallic_texture|orm_texture",
	"pyramid_reduce.gdshader": "filter",
	"pyramid_views.gdshader": "source|panorama|LobeEnvironment3D",
}

## By the names of [constant SHADERS]: who needs it.
var reached: Dictionary[String, String] = {}
## Of each [LobeEnvironment3D] in a scene, [file, properties].
var environments: Array[Array] = []

var _words: Dictionary[String, RegEx] = {}


func _init() -> void:
	for shader in _WORDS:
		_words[shader] = RegEx.create_from_string("\\b(%s)\\b" % _WORDS[shader])


## For what may do anything.
func add_all(file: String) -> void:
	for shader in SHADERS:
		_add(shader, file)


func look_at_material(file: String, material: LobeMaterial3D) -> void:
	if material.clearcoat > 0.0:
		_add("clear_coat.gdshaderinc", file)
	if MaterialShader.is_dielectric(material):
		_add("diffuse.gdshaderinc", file)


## A line of a script, or the path of an animation's track.
func read_line(file: String, line: String) -> void:
	for shader in SHADERS:
		if _words[shader].search(line) != null:
			_add(shader, file)


## A node of a scene, by the properties that are not at their defaults.
func look_at_node(file: String, properties: Dictionary, is_instance: bool) -> void:
	if is_instance:
		# What it is an instance of is seen elsewhere; here something of it is changed.
		read_line(file, " ".join(PackedStringArray(properties.keys())))
		return
	var script: Script = properties.get("script") as Script
	while script != null and script != LobeEnvironment:
		script = script.get_base_script()
	if script == null:
		return
	environments.append([file, properties])
	var source: int = properties.get("source", LobeEnvironment3D.Source.AUTOMATIC)
	var has_panorama := properties.get("panorama") is Texture2D
	if source == LobeEnvironment3D.Source.AUTOMATIC and has_panorama:
		source = LobeEnvironment3D.Source.PANORAMA
	if source != LobeEnvironment3D.Source.PANORAMA:
		_add("pyramid_views.gdshader", file)
	var filter: int = properties.get("filter", LobeEnvironment3D.Filter.DISC)
	if filter == LobeEnvironment3D.Filter.BOX or filter == LobeEnvironment3D.Filter.BINOMIAL:
		_add("pyramid_reduce.gdshader", file)


func _add(shader: String, file: String) -> void:
	if not reached.has(shader):
		reached[shader] = file
