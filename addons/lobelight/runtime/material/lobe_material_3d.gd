@tool
@icon("../../icons/lobe_material_3d.svg")
class_name LobeMaterial3D
extends LobeBaseMaterial3D
## A material lit by its surroundings through the lobes of its BRDF: metals, brushed ones too,
## and everything that [StandardMaterial3D] draws with a diffuse colour.
##
## The light comes from the [LobeEnvironment3D] of the world and the [LobeProbe3D]s around each
## pixel; without any, from a neutral map. Set
## [member roughness] and [member anisotropy], and the lobes come from a [LobeTableSet];
## [member table] has those of a single BRDF. Properties are named and behave as those of
## [StandardMaterial3D], see [method widths_of] for where they go further.
## [br][br]
## Metals and all else send back the light they take: GGX, which loses light between its
## microfacets, is compensated for it, and the diffuse colour gets what is not reflected.
## [br][br]
## What the engine makes of the material:
## [br]- Its own lights, their shadows, and fog work as on any material. In Compatibility, lights
## with shadows are added in sRGB.
## [br]- Diffuse light comes from the environment or from the engine, see [member diffuse_light]: by
## default from the engine where it has lightmaps, [VoxelGI], SDFGI or, without [LobeProbe3D]s, a
## [ReflectionProbe], so that the surface is as bright as what is beside it. Then the engine's
## ambient light, its occlusion and its indirect light act as on a [StandardMaterial3D], without
## regard to what the lobes reflect already. Reflections are the environment's in either case: those
## of the sky, of [ReflectionProbe]s, of GI and of the screen do not show.
## [br]- SSAO and SSIL act on diffuse light in Forward+, wherever it comes from; with physical light
## units only on the engine's. While they act on the environment's, lightmaps add to it, and
## [ReflectionProbe]s with an ambient light, [VoxelGI] and SDFGI replace it. In Compatibility SSAO
## darkens the whole picture.
## [br]- Where the engine has a hand in diffuse light, its lamps' reflections are compensated for
## the energy that lobes lose, and lamps have no size. Otherwise they are not compensated.
## [br]- When lightmaps and GI ask what the material sends out, it answers with its
## [member emission] alone, not with what it reflects. A [VoxelGI] takes static objects with any
## [ShaderMaterial] for white.
## [br]- [Decal]s change what the engine's lights show, and add their emission. Where the engine has
## a hand in diffuse light, they colour it. Lobes do not know of them.
## [br]- Compatibility, as of Godot 4.6, gives skinned meshes one and the same tangent everywhere:
## anisotropy, normal and bent normal maps need another renderer there.
## [br][br]
## The shader is generated from the properties and shared by materials of the same kind; what is not
## used is not in it. It is not stored with the material, and neither [member ShaderMaterial.shader]
## nor shader parameters are to be set on it.

## Where the diffuse light of a [LobeMaterial3D] comes from.
enum DiffuseLight {
	## What the project setting [code]lobelight/materials/diffuse_light[/code] says. With its default,
	## Automatic: the engine where a world that a [LobeEnvironment3D] or a [LobeProbe3D] lights has
	## engine light of its own, that is SDFGI, a visible [VoxelGI] or [LightmapGI] with data, or, where
	## there is no [LobeProbe3D], a visible [ReflectionProbe] with ambient light (not in
	## Compatibility); otherwise the environment. It counts for all materials, as these belong to no
	## world.
	AUTOMATIC,
	## The environment and the probes around each pixel light the surface, as they do its reflections.
	ENVIRONMENT,
	## Ambient light, lightmaps, [VoxelGI] and SDFGI light the surface as they do any
	## [StandardMaterial3D]; the environment's light is reflected only.
	ENGINE,
}

const Conversion := preload("conversion.gd")
const DiffuseSource := preload("../light/diffuse_source.gd")
const LightRegistry := preload("../light/light_registry.gd")
const MaterialParameters := preload("material_parameters.gd")
const MaterialShader := preload("material_shader.gd")
const OnDemand := preload("../on_demand.gd")
const ShaderVariants := preload("../light/shader_variants.gd")
const ShownProperties := preload("shown_properties.gd")
const TableChoice := preload("table_choice.gd")

const _NORMAL_VARIANCE := "res://addons/lobelight/runtime/antialiasing/normal_variance.gd"
# Loaded here so that exported projects contain them.
const _INCLUDES: Array[ShaderInclude] = [
	preload("../antialiasing/normal_variance.gdshaderinc"),
	preload("../clear_coat/clear_coat.gdshaderinc"),
	preload("../shaders/colour.gdshaderinc"),
	preload("../shaders/coordinates.gdshaderinc"),
	preload("../detail/detail.gdshaderinc"),
	preload("../diffuse/diffuse.gdshaderinc"),
	preload("../shaders/environment.gdshaderinc"),
	preload("../fades/fades.gdshaderinc"),
	preload("../shaders/frame.gdshaderinc"),
	preload("../lamps/lamps.gdshaderinc"),
	preload("../line/line.gdshaderinc"),
	preload("../line/line_shift.gdshaderinc"),
	preload("../shaders/lobe_table.gdshaderinc"),
	preload("../shaders/material.gdshaderinc"),
	preload("../shaders/material_inputs.gdshaderinc"),
	preload("../occlusion/occlusion.gdshaderinc"),
	preload("../msdf/msdf.gdshaderinc"),
	preload("../parallax/parallax.gdshaderinc"),
	preload("../sheen/sheen.gdshaderinc"),
	preload("../sources/source_highlights.gdshaderinc"),
	preload("../sources/sources.gdshaderinc"),
	preload("../shaders/specular.gdshaderinc"),
	preload("../triplanar/triplanar.gdshaderinc"),
	preload("../shaders/vertex.gdshaderinc"),
	preload("../vertices/vertices.gdshaderinc"),
	preload("../shaders/widths.gdshaderinc"),
]

@export_group("Light")
## A light that the material shows wherever it is, from [method LobeEnvironment3D.get_light],
## [method LobeProbe3D.get_light] or a file; that of a probe keeps its box. Without one, the
## material shows the light of where it is: that of its world, and of the [LobeProbe3D]s around each
## pixel.
@export var light: LobeLight:
	set(value):
		light = value
		LightRegistry.set_own_light(_rid, light)
		emit_changed()

## Where diffuse light comes from. Metals have none. Materials with a rim, a backlight, light below
## the surface, shading per vertex, or diffuse and specular modes other than the default ones take
## it from the environment always, and SSAO does not act on it.
@export var diffuse_light := DiffuseLight.AUTOMATIC:
	set(value):
		diffuse_light = value
		LightRegistry.set_diffuse_source(_rid, int(value) as DiffuseSource.Source)
		emit_changed()

var _queued := false
# The lobes that the shader's code is for.
var _shape := 0
# The one before is kept: what changes to and fro is compiled once.
var _shader: Shader
var _last_shader: Shader
# What the lobes come from, and the rendering server's textures, kept alive.
var _choice := TableChoice.new()


## The widths (alpha_x, alpha_y) of the BRDF along and across the brushing:
## [codeblock lang=text]
## alpha_x = r² / aspect    alpha_y = r² · aspect    aspect = √(1 − 0.9 a)
## [/codeblock]
## with the roughness r and the anisotropy a. These are the engine's own, so that a material looks
## the same in its lights. Godot's anisotropy ends at a = 1, 10:1; here it goes on to 1.1, 100:1.
## With a < 0, alpha_y is the larger one. A set's tables end where its widths do, the ready ones at
## 0.005 and 1: what is beyond is taken for the last. Lobes without a table, see [member
## LobeBaseMaterial3D.quality], go on to 0.001.
static func widths_of(roughness_of_surface: float, anisotropy_of_surface: float) -> Vector2:
	return Widths.from_roughness(roughness_of_surface, anisotropy_of_surface)


## A material with the look of one of Godot's, a [StandardMaterial3D] or an [ORMMaterial3D], and the
## same textures. [method get_losses_from] names what it does not take over.
## [br][br]
## Exports have this method, that one and [method to_standard] where a script of the project names
## one of them; elsewhere they give [code]null[/code] and nothing, with an error.
static func from_standard(source: BaseMaterial3D) -> LobeMaterial3D:
	var conversion: Conversion = Conversion.find()
	return conversion.from_standard(source) as LobeMaterial3D if conversion != null else null


## The properties of a material of Godot's that [method from_standard] cannot take over and that are
## not at their defaults.
static func get_losses_from(source: BaseMaterial3D) -> PackedStringArray:
	var conversion: Conversion = Conversion.find()
	return conversion.get_losses(source) if conversion != null else PackedStringArray()


## A [member LobeBaseMaterial3D.normal_variance_texture] for a normal map, from its image. It takes
## a while for large maps, and may be called from a thread. [code]null[/code], and an error, if
## there is no image.
static func bake_normal_variance(normals: Image) -> ImageTexture:
	var baker := OnDemand.fetch(_NORMAL_VARIANCE, OnDemand.ANTIALIASING) as GDScript
	return baker.call(&"bake", normals) as ImageTexture if baker != null else null


func _init() -> void:
	LightRegistry.add_material(_rid, _queue_update)
	_queue_update()


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE:
		LightRegistry.remove_material(_rid)


func _validate_property(property: Dictionary) -> void:
	match property.name:
		"shader":
			property.usage = PROPERTY_USAGE_NONE
		"render_priority", "next_pass":
			property.usage = PROPERTY_USAGE_DEFAULT
		_:
			if ShownProperties.hides(self, property.name):
				# It is stored all the same.
				property.usage &= ~PROPERTY_USAGE_EDITOR


## The generated shader's code: [code]#define[/code]s that choose the variant, and an
## [code]#include[/code].
func get_shader_code() -> String:
	_mutex.lock()
	_look()
	var code := _make_code()
	_mutex.unlock()
	return code


## Whether meshes need tangents for the material: with anisotropy and with maps of normals, also
## bent ones. For a mesh that has none the engine makes some up, across the normal; the inspector of
## its node warns of it.
func needs_tangents() -> bool:
	_mutex.lock()
	_look()
	var needed := has_normal_map() or has_bent_normals() or not _choice.is_isotropic
	needed = needed or has_relief()
	_mutex.unlock()
	return needed and not makes_tangents()


## How often a pixel looks something up for each light that reaches it, counted from the shader:
## [code]{"environment": int, "table": int, "samplers": int}[/code], the last being the samplers
## besides those of the material's own textures.
func get_fetches() -> Dictionary[String, int]:
	_mutex.lock()
	_look()
	var fetches := MaterialShader.count_fetches(self, _choice)
	_mutex.unlock()
	return fetches


## A material of Godot's with the same look in the engine's lights: an [ORMMaterial3D] where its
## texture says all about roughness and metal, otherwise a [StandardMaterial3D]. Anisotropy above 1
## becomes 1, and a [member table] gives its widths only.
func to_standard() -> BaseMaterial3D:
	var conversion: Conversion = Conversion.find()
	return conversion.to_standard(self) if conversion != null else null


## The path of the shader include that has the fragment function. Materials that draw something else
## with the same lobes override it.
func _get_fragment_path() -> String:
	var folder: String = (LobeMaterial3D as Script).resource_path.get_base_dir()
	return folder.path_join("../shaders/material.gdshaderinc").simplify_path()


## Has the rendering server know the shader and its parameters now. Where several properties change,
## as when a file is loaded, they are handed on once, before the next frame is drawn; whoever asks
## the server earlier calls this first.
func update_now() -> void:
	if _queued:
		_update()


func _queue_update() -> void:
	_awaits_update = true
	_queue_look()
	emit_changed()


func _queue_look() -> void:
	if not _queued:
		_queued = true
		update_now.call_deferred()


func _update_widths() -> void:
	_mutex.lock()
	var shown := anisotropy if anisotropy_enabled else 0.0
	if not _queued and not _choice.follow(roughness, shown, _rid):
		_queue_look()
	_mutex.unlock()


func _make_code() -> String:
	return MaterialShader.get_code(self, _choice) + '#include "%s"\n' % _get_fragment_path()


# Looks anew at what the lobes come from.
func _look() -> void:
	_choice.choose(self)


func _update() -> void:
	_mutex.lock()
	# Before the look: what changes meanwhile, on another thread, is looked at again.
	var is_whole := _awaits_update
	_awaits_update = false
	_queued = false
	_look()
	var shape := _choice.get_shape()
	if is_whole or shape != _shape:
		_shape = shape
		_take_shader(_make_code())
	if is_whole:
		_is_physical = has_physical_units()
		MaterialParameters.apply(self, _choice)
	else:
		MaterialParameters.apply_lobes(self, _choice)
	LightRegistry.set_width(_rid, _choice.get_narrowest())
	_mutex.unlock()


func _take_shader(code: String) -> void:
	if _shader != null and _shader.code == code:
		return
	var before := _shader
	var is_last := _last_shader != null and _last_shader.code == code
	_shader = _last_shader if is_last else ShaderVariants.fetch(code)
	_last_shader = before
	RenderingServer.material_set_shader(_rid, _shader.get_rid())
