@tool
@icon("../icons/lobe_material_3d.svg")
class_name LobeMaterial3D
extends ShaderMaterial
## A metal lit by its surroundings through the lobes of a [LobeTable].
##
## The light comes from the active [LobeEnvironment3D]; without one, from a neutral map. The
## engine's own lights add to it; its ambient and reflected light do not. The material is a metal:
## [member albedo] is its colour at normal incidence, and nothing is diffuse.
## [br][br]
## The shader is generated from the properties and shared by materials of the same kind. It is not
## stored with the material, and neither [member ShaderMaterial.shader] nor shader parameters are to
## be set on it.

const LightRegistry := preload("light_registry.gd")

# Loaded here so that exported projects contain them.
const _INCLUDES: Array[ShaderInclude] = [
	preload("shaders/colour.gdshaderinc"),
	preload("shaders/environment.gdshaderinc"),
	preload("shaders/frame.gdshaderinc"),
	preload("shaders/lobe_table.gdshaderinc"),
	preload("shaders/specular.gdshaderinc"),
	preload("shaders/material.gdshaderinc"),
]

# Shaders in use, by their code.
static var _variants: Dictionary[String, WeakRef] = {}
static var _variants_mutex := Mutex.new()

## The BRDF. Without one, or with an incomplete one, the material has a single wide lobe.
@export var table: LobeTable:
	set(value):
		if table == value:
			return
		if table != null:
			table.changed.disconnect(_queue_update)
		table = value
		if table != null:
			table.changed.connect(_queue_update)
		_queue_update()

@export_group("Albedo")
## The share of light reflected at normal incidence. Towards grazing angles it goes to 1 by
## Schlick's approximation.
@export_color_no_alpha var albedo := Color.WHITE:
	set(value):
		albedo = value
		_set_colour(&"lobelight_albedo", value)
		emit_changed()
## Multiplied with [member albedo].
@export var albedo_texture: Texture2D:
	set(value):
		albedo_texture = value
		_queue_update()

@export_group("Normal Map")
## A tangent-space normal map. The mesh needs tangents.
@export var normal_texture: Texture2D:
	set(value):
		normal_texture = value
		_queue_update()
## The strength of the normal map.
@export_range(-16.0, 16.0, 0.01) var normal_scale := 1.0:
	set(value):
		normal_scale = value
		_queue_update()

@export_group("Anisotropy")
## The angle from the mesh's tangent, towards its bitangent, to the direction in which the table's
## first width is measured. Isotropic tables ignore it.
@export_range(-180.0, 180.0, 0.1, "radians_as_degrees") var anisotropy_rotation := 0.0:
	set(value):
		anisotropy_rotation = value
		_queue_update()

@export_group("Emission")
## Light that the surface sends out by itself.
@export_color_no_alpha var emission := Color.BLACK:
	set(value):
		emission = value
		_queue_update()
## Multiplied with [member emission].
@export_range(0.0, 16.0, 0.01, "or_greater") var emission_energy := 1.0:
	set(value):
		emission_energy = value
		_queue_update()

# Kept, because the object is no longer whole when it is told of its end.
var _rid := get_rid()
var _queued := false
var _shader: Shader
# What the material shows while `table` is missing or incomplete.
var _stand_in: LobeTable
# The textures of the rendering server's parameters, kept alive.
var _table_texture: Texture2D


func _init() -> void:
	LightRegistry.add_material(_rid)
	_set_colour(&"lobelight_albedo", albedo)
	_queue_update()


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE:
		LightRegistry.remove_material(_rid)


func _validate_property(property: Dictionary) -> void:
	if property.name == "shader":
		property.usage = PROPERTY_USAGE_NONE
	elif property.name == "render_priority" or property.name == "next_pass":
		property.usage = PROPERTY_USAGE_DEFAULT


## The generated shader's code: [code]#define[/code]s that choose the variant, and an
## [code]#include[/code].
func get_shader_code() -> String:
	var used := _get_table()
	var code := "shader_type spatial;\nrender_mode ambient_light_disabled;\n"
	code += "#define LOBELIGHT_LOBES %d\n" % used.lobe_count
	if used.is_isotropic():
		code += "#define LOBELIGHT_ISOTROPIC\n"
	elif anisotropy_rotation != 0.0:
		code += "#define LOBELIGHT_ANISOTROPY_ROTATION\n"
	if used.has_second_texels():
		code += "#define LOBELIGHT_SECOND_TEXELS\n"
	if albedo_texture != null:
		code += "#define LOBELIGHT_ALBEDO_TEXTURE\n"
	if normal_texture != null:
		code += "#define LOBELIGHT_NORMAL_TEXTURE\n"
	if _emits():
		code += "#define LOBELIGHT_EMISSION\n"
	return code + '#include "%s"\n' % _get_fragment_path()


## The path of the shader include that has the fragment function. Materials that draw something else
## with the same lobes override it.
func _get_fragment_path() -> String:
	var folder: String = (LobeMaterial3D as Script).resource_path.get_base_dir()
	return folder.path_join("shaders/material.gdshaderinc")


func _get_table() -> LobeTable:
	if table != null and table.get_problem().is_empty():
		_stand_in = null
		return table
	if _stand_in == null:
		_stand_in = LobeTable.make_single_lobe()
	return _stand_in


func _emits() -> bool:
	return emission_energy != 0.0 and (emission.r != 0.0 or emission.g != 0.0 or emission.b != 0.0)


# Several changed properties, as a file's are, make one shader. It is there before the next frame.
func _queue_update() -> void:
	if not _queued:
		_queued = true
		_update.call_deferred()
	emit_changed()


func _update() -> void:
	_queued = false
	var used := _get_table()
	var code := get_shader_code()
	if _shader == null or _shader.code != code:
		_shader = _get_variant(code)
		RenderingServer.material_set_shader(_rid, _shader.get_rid())

	_table_texture = used.get_texture()
	_set_parameter(&"lobelight_table", _table_texture.get_rid())
	_set_parameter(&"lobelight_table_alpha", used.alpha)
	_set_parameter(&"lobelight_table_lookup", used.get_lookup())
	_set_engine_lights(used)

	if albedo_texture != null:
		_set_parameter(&"lobelight_albedo_texture", albedo_texture.get_rid())
	if normal_texture != null:
		_set_parameter(&"lobelight_normal_texture", normal_texture.get_rid())
		_set_parameter(&"lobelight_normal_scale", normal_scale)
	if _emits():
		_set_colour(&"lobelight_emitted", emission, emission_energy)


# Roughness and anisotropy for the engine's own lights. The engine's widths are
# r² / aspect and r² · aspect, aspect = sqrt(1 - 0.9 anisotropy), the first along the flow
# (Burley 2012, "Physically-Based Shading at Disney", B.1).
func _set_engine_lights(used: LobeTable) -> void:
	_set_parameter(&"lobelight_roughness", pow(used.alpha.x * used.alpha.y, 0.25))
	if used.is_isotropic():
		return
	var ratio := minf(used.alpha.x, used.alpha.y) / maxf(used.alpha.x, used.alpha.y)
	_set_parameter(&"lobelight_anisotropy", minf((1.0 - ratio * ratio) / 0.9, 1.0))
	var turn := Vector2.from_angle(anisotropy_rotation)
	_set_parameter(&"lobelight_anisotropy_rotation", turn)
	var flow := turn if used.alpha.x >= used.alpha.y else turn.rotated(0.5 * PI)
	_set_parameter(&"lobelight_anisotropy_flow", flow)


func _set_colour(name: StringName, colour: Color, factor := 1.0) -> void:
	var linear := colour.srgb_to_linear() * factor
	_set_parameter(name, Vector3(linear.r, linear.g, linear.b))


# Not ShaderMaterial's own parameters: those would be stored with the material, pyramid and all.
func _set_parameter(name: StringName, value: Variant) -> void:
	RenderingServer.material_set_param(_rid, name, value)


static func _get_variant(code: String) -> Shader:
	_variants_mutex.lock()
	var shader: Shader
	if _variants.has(code):
		shader = _variants[code].get_ref()
	if shader == null:
		for other: String in _variants.keys():
			if _variants[other].get_ref() == null:
				_variants.erase(other)
		shader = Shader.new()
		shader.code = code
		_variants[code] = weakref(shader)
	_variants_mutex.unlock()
	return shader
