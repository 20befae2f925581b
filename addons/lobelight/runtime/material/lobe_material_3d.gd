@tool
@icon("../../icons/lobe_material_3d.svg")
class_name LobeMaterial3D
extends ShaderMaterial
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
## [br]- Its own lights, their shadows, and fog work as on any material. Its lights are not
## compensated for lost energy, and in Compatibility, lights with shadows are added in sRGB.
## [br]- Its ambient light, reflections of the sky, [ReflectionProbe]s, lightmaps, [VoxelGI] and
## SDFGI do not light the material: the environment does, once. When they ask what the material
## sends out, it answers with its [member emission] alone, not with what it reflects. A [VoxelGI]
## takes static objects with any [ShaderMaterial] for white.
## [br]- [Decal]s change what the engine's lights show, and add their emission; the environment's
## light does not know of them.
## [br]- Compatibility, as of Godot 4.6, gives skinned meshes one and the same tangent everywhere:
## anisotropy and normal maps need another renderer there.
## [br][br]
## The shader is generated from the properties and shared by materials of the same kind; what is not
## used is not in it. It is not stored with the material, and neither [member ShaderMaterial.shader]
## nor shader parameters are to be set on it.

## As [enum BaseMaterial3D.Transparency]. Compatibility has no alpha hash; there it blends.
enum Transparency {
	DISABLED,  ## Opaque.
	ALPHA,  ## Blended by alpha, drawn from back to front.
	ALPHA_SCISSOR,  ## Cut out where alpha is below a threshold.
	ALPHA_HASH,  ## Cut out by a dither of alpha. Compatibility blends instead.
	ALPHA_DEPTH_PRE_PASS,  ## Blended, with the opaque parts in the depth buffer first.
}
## As [enum BaseMaterial3D.BlendMode].
enum BlendMode {
	MIX,  ## By alpha.
	ADD,  ## Added to what is behind.
	SUBTRACT,  ## Subtracted from what is behind.
	MULTIPLY,  ## Multiplied with what is behind.
	PREMULTIPLIED_ALPHA,  ## By alpha, with colours that contain it already.
}
## As [enum BaseMaterial3D.CullMode].
enum CullMode {
	BACK,  ## Back faces are not drawn.
	FRONT,  ## Front faces are not drawn.
	DISABLED,  ## Both sides are drawn.
}
## As [enum BaseMaterial3D.TextureChannel].
enum TextureChannel {
	RED,  ## Red.
	GREEN,  ## Green.
	BLUE,  ## Blue.
	ALPHA,  ## Alpha.
	GRAYSCALE,  ## The mean of red, green and blue.
}
## As [enum BaseMaterial3D.EmissionOperator].
enum EmissionOperator {
	ADD,  ## The colour plus the texture.
	MULTIPLY,  ## The colour times the texture.
}

const Conversion := preload("conversion.gd")
const LightRegistry := preload("../light/light_registry.gd")
const MaterialInputs := preload("material_inputs.gd")
const MaterialParameters := preload("material_parameters.gd")
const MaterialShader := preload("material_shader.gd")
const TableChoice := preload("table_choice.gd")
const Widths := preload("../table/widths.gd")

# Loaded here so that exported projects contain them.
const _INCLUDES: Array[ShaderInclude] = [
	preload("../clear_coat/clear_coat.gdshaderinc"),
	preload("../shaders/colour.gdshaderinc"),
	preload("../diffuse/diffuse.gdshaderinc"),
	preload("../shaders/environment.gdshaderinc"),
	preload("../shaders/frame.gdshaderinc"),
	preload("../shaders/lobe_table.gdshaderinc"),
	preload("../shaders/material.gdshaderinc"),
	preload("../shaders/material_inputs.gdshaderinc"),
	preload("../shaders/specular.gdshaderinc"),
	preload("../shaders/widths.gdshaderinc"),
]

# Shaders in use, by their code.
static var _variants: Dictionary[String, WeakRef] = {}
static var _variants_mutex := Mutex.new()

@export_group("BRDF")
## Where the lobes of any [member roughness] and [member anisotropy] come from. Without one, GGX
## with eight lobes, which is the BRDF of Godot's own materials; [code]ward_8.res[/code], beside
## it in [code]addons/lobelight/tables[/code], is Ward's.
@export var table_set: LobeTableSet:
	set(value):
		_follow(table_set, value)
		table_set = value
		_queue_update()
## The lobes of one BRDF, measured ones for instance. With a table, [member table_set],
## [member roughness] and [member anisotropy] do not count; the engine's own lights take the widths
## of the table. It is drawn as it is, without compensation for lost energy.
@export var table: LobeTable:
	set(value):
		_follow(table, value)
		table = value
		_queue_update()

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

@export_group("Transparency")
## Whether and how [member albedo]'s alpha makes the surface transparent.
@export var transparency := Transparency.DISABLED:
	set(value):
		transparency = value
		notify_property_list_changed()
		_queue_update()
## What is less opaque is not drawn.
@export_range(0.0, 1.0, 0.001) var alpha_scissor_threshold := 0.5:
	set(value):
		alpha_scissor_threshold = value
		_queue_update()
## The size of the grain.
@export_range(0.0, 2.0, 0.01) var alpha_hash_scale := 1.0:
	set(value):
		alpha_hash_scale = value
		_queue_update()
## How the surface is blended with what is behind it.
@export var blend_mode := BlendMode.MIX:
	set(value):
		blend_mode = value
		_queue_update()
## The side that is not drawn. With DISABLED, back faces are lit as front faces of the other side.
@export var cull_mode := CullMode.BACK:
	set(value):
		cull_mode = value
		_queue_update()

@export_group("Vertex Color", "vertex_color_")
## Multiplies [member albedo] with the mesh's colours.
@export var vertex_color_use_as_albedo := false:
	set(value):
		vertex_color_use_as_albedo = value
		_queue_update()
## Whether the mesh's colours are sRGB.
@export var vertex_color_is_srgb := false:
	set(value):
		vertex_color_is_srgb = value
		_queue_update()

@export_group("Albedo")
## The colour. Metals reflect this share of the light at normal incidence, and at grazing angles all
## of it, by Schlick's approximation; other materials scatter it. Alpha is the opacity, see
## [member transparency].
@export var albedo := Color.WHITE:
	set(value):
		albedo = value
		MaterialParameters.set_albedo(get_rid(), albedo)
		emit_changed()
## Multiplied with [member albedo].
@export var albedo_texture: Texture2D:
	set(value):
		albedo_texture = value
		_queue_update()

@export_group("ORM")
## Occlusion in red, and factors of [member roughness] and [member metallic] in green and blue. It
## replaces the textures of the three.
@export var orm_texture: Texture2D:
	set(value):
		orm_texture = value
		_queue_update()

@export_group("Metallic")
## 1 for metals, 0 for everything else. Pure metals cost less, as they have no diffuse light.
@export_range(0.0, 1.0, 0.01) var metallic := 1.0:
	set(value):
		metallic = clampf(value, 0.0, 1.0)
		_queue_update()
## How much light is reflected by what is no metal: 16 % of the square, so that 0.5 is the 4 % of
## plastic and glass. The same as [member BaseMaterial3D.metallic_specular].
@export_range(0.0, 1.0, 0.01) var specular := 0.5:
	set(value):
		specular = clampf(value, 0.0, 1.0)
		_queue_update()
## A factor of [member metallic].
@export var metallic_texture: Texture2D:
	set(value):
		metallic_texture = value
		_queue_update()
## The channel of [member metallic_texture].
@export var metallic_texture_channel := TextureChannel.RED:
	set(value):
		metallic_texture_channel = value
		_queue_update()

@export_group("Roughness")
## From 0, nearly a mirror, to 1. [method widths_of] tells what it does.
@export_range(0.0, 1.0, 0.001) var roughness := 0.4:
	set(value):
		roughness = clampf(value, 0.0, 1.0)
		_queue_update()
## A factor of [member roughness]. With it, tables are looked up for each pixel: as many fetches as
## without where [member anisotropy] is 0, otherwise twice as many. The widths of [member table_set]
## must grow by equal factors for it, as those of the ready sets do, and with anisotropy there may
## be 22 of them, since 3D textures have 256 layers; otherwise it is for the engine's own lights
## only.
@export var roughness_texture: Texture2D:
	set(value):
		roughness_texture = value
		_queue_update()
## The channel of [member roughness_texture].
@export var roughness_texture_channel := TextureChannel.RED:
	set(value):
		roughness_texture_channel = value
		_queue_update()

@export_group("Anisotropy")
## How much wider highlights are along the tangent than across: from −1 to 1 the same as
## [member BaseMaterial3D.anisotropy], widths being 10:1 at 1 and 1:1.9 at −1, and beyond that up to
## 100:1 at 1.1. Meshes need tangents for it.
@export_range(-1.0, 1.1, 0.001) var anisotropy := 0.0:
	set(value):
		anisotropy = clampf(value, -1.0, Widths.MAX_ANISOTROPY)
		_queue_update()
## Where the tangent of the lobes points, as in [member BaseMaterial3D.anisotropy_flowmap]: red
## and green are the direction, alpha a factor of [member anisotropy]. It has no say where the
## anisotropy is negative. Without an alpha channel it does not cost more fetches.
@export var anisotropy_flowmap: Texture2D:
	set(value):
		anisotropy_flowmap = value
		_queue_update()
## An angle from the mesh's tangent, towards its bitangent, to the direction in which the first
## width is measured; added to that of [member anisotropy_flowmap].
@export_range(-180.0, 180.0, 0.1, "radians_as_degrees") var anisotropy_rotation := 0.0:
	set(value):
		anisotropy_rotation = value
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

@export_group("Clearcoat", "clearcoat_")
## A clear lacquer over the material, up to 1. It has lobes of its own, and costs as many fetches
## again.
@export_range(0.0, 1.0, 0.01) var clearcoat := 0.0:
	set(value):
		clearcoat = clampf(value, 0.0, 1.0)
		_queue_update()
## The lacquer's roughness, as [member BaseMaterial3D.clearcoat_roughness]: its width is between
## 0.001 and 0.1.
@export_range(0.0, 1.0, 0.01) var clearcoat_roughness := 0.5:
	set(value):
		clearcoat_roughness = clampf(value, 0.0, 1.0)
		_queue_update()
## Factors of [member clearcoat] in red and of [member clearcoat_roughness] in green, the latter for
## the engine's own lights only.
@export var clearcoat_texture: Texture2D:
	set(value):
		clearcoat_texture = value
		_queue_update()

@export_group("Ambient Occlusion", "ao_")
## The share of the surroundings that the surface sees. Reflections are occluded by it as well
## (Lagarde and de Rousiers 2014).
@export var ao_texture: Texture2D:
	set(value):
		ao_texture = value
		_queue_update()
## The channel of [member ao_texture].
@export var ao_texture_channel := TextureChannel.RED:
	set(value):
		ao_texture_channel = value
		_queue_update()
## Whether [member ao_texture] lies on the mesh's second texture coordinates.
@export var ao_on_uv2 := false:
	set(value):
		ao_on_uv2 = value
		_queue_update()
## How much the occlusion darkens the engine's own lights.
@export_range(0.0, 1.0, 0.01) var ao_light_affect := 0.0:
	set(value):
		ao_light_affect = value
		_queue_update()

@export_group("Emission")
## Light that the surface sends out by itself.
@export_color_no_alpha var emission := Color.BLACK:
	set(value):
		emission = value
		_queue_update()
## A factor for [member emission] and its texture.
@export_range(0.0, 16.0, 0.01, "or_greater") var emission_energy := 1.0:
	set(value):
		emission_energy = value
		_queue_update()
## Whether [member emission_texture] is added to or multiplied with [member emission].
@export var emission_operator := EmissionOperator.ADD:
	set(value):
		emission_operator = value
		_queue_update()
## More light that the surface sends out.
@export var emission_texture: Texture2D:
	set(value):
		emission_texture = value
		_queue_update()

@export_group("UV1", "uv1_")
## A factor for the texture coordinates.
@export var uv1_scale := Vector2.ONE:
	set(value):
		uv1_scale = value
		_queue_update()
## Added to the texture coordinates after their scale.
@export var uv1_offset := Vector2.ZERO:
	set(value):
		uv1_offset = value
		_queue_update()

@export_group("Sampling", "texture_")
## How textures are filtered.
@export var texture_filter := BaseMaterial3D.TEXTURE_FILTER_LINEAR_WITH_MIPMAPS_ANISOTROPIC:
	set(value):
		texture_filter = value
		_queue_update()
## Whether textures repeat.
@export var texture_repeat := true:
	set(value):
		texture_repeat = value
		_queue_update()

# Kept, because the object is no longer whole when it is told of its end.
var _rid := get_rid()
var _queued := false
var _shader: Shader
var _inputs := MaterialInputs.new()
# What the lobes come from, and the rendering server's textures, kept alive.
var _choice := TableChoice.new()
# A light that comes while a thread loads the material has the main thread look at it as well.
var _mutex := Mutex.new()


## The widths (alpha_x, alpha_y) of the BRDF along and across the brushing:
## [codeblock lang=text]
## alpha_x = r² / aspect    alpha_y = r² · aspect    aspect = √(1 − 0.9 a)
## [/codeblock]
## with the roughness r and the anisotropy a. These are the engine's own, so that a material looks
## the same in its lights. Godot's anisotropy ends at a = 1, 10:1; here it goes on to 1.1, 100:1.
## With a < 0, alpha_y is the larger one. A set's tables end where its widths do, the ready ones at
## 0.005 and 1: what is beyond is taken for the last.
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


func _init() -> void:
	LightRegistry.add_material(_rid, _queue_update)
	MaterialParameters.set_albedo(get_rid(), albedo)
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
		"alpha_scissor_threshold":
			if transparency != Transparency.ALPHA_SCISSOR:
				property.usage = PROPERTY_USAGE_NO_EDITOR
		"alpha_hash_scale":
			if transparency != Transparency.ALPHA_HASH:
				property.usage = PROPERTY_USAGE_NO_EDITOR


## The generated shader's code: [code]#define[/code]s that choose the variant, and an
## [code]#include[/code].
func get_shader_code() -> String:
	_mutex.lock()
	_look()
	var code := MaterialShader.get_code(_inputs, _choice) + '#include "%s"\n' % _get_fragment_path()
	_mutex.unlock()
	return code


## Whether meshes need tangents for the material: with anisotropy and with normal maps. For a mesh
## that has none the engine makes some up, across the normal; the inspector of its node warns of it.
func needs_tangents() -> bool:
	_mutex.lock()
	_look()
	var needed := normal_texture != null or not _choice.is_isotropic
	_mutex.unlock()
	return needed


## How often a pixel looks something up for each light that reaches it, counted from the shader:
## [code]{"environment": int, "table": int, "samplers": int}[/code], the last being the samplers
## besides those of the material's own textures.
func get_fetches() -> Dictionary[String, int]:
	_mutex.lock()
	_look()
	var fetches := MaterialShader.count_fetches(_inputs, _choice)
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


func _follow(before: Resource, after: Resource) -> void:
	if before != null:
		before.changed.disconnect(_queue_update)
	if after != null:
		after.changed.connect(_queue_update)


# Several changed properties, as a file's are, make one shader. It is there before the next frame.
func _queue_update() -> void:
	if not _queued:
		_queued = true
		_update.call_deferred()
	emit_changed()


# Looks anew at the properties, and at what the lobes come from.
func _look() -> void:
	_write_inputs(_inputs)
	_choice.choose(_inputs)


# What the material says of its surface, for the addon's own scripts.
func _get_inputs() -> MaterialInputs:
	var inputs := MaterialInputs.new()
	_write_inputs(inputs)
	return inputs


func _write_inputs(inputs: MaterialInputs) -> void:
	inputs.rid = _rid
	inputs.table_set = table_set
	inputs.table = table
	inputs.transparency = transparency as BaseMaterial3D.Transparency
	inputs.alpha_scissor_threshold = alpha_scissor_threshold
	inputs.alpha_hash_scale = alpha_hash_scale
	inputs.blend_mode = blend_mode as BaseMaterial3D.BlendMode
	inputs.cull_mode = cull_mode as BaseMaterial3D.CullMode
	inputs.vertex_color_use_as_albedo = vertex_color_use_as_albedo
	inputs.vertex_color_is_srgb = vertex_color_is_srgb
	inputs.albedo_texture = albedo_texture
	inputs.orm_texture = orm_texture
	inputs.metallic = metallic
	inputs.specular = specular
	inputs.metallic_texture = metallic_texture
	inputs.metallic_texture_channel = metallic_texture_channel as BaseMaterial3D.TextureChannel
	inputs.roughness = roughness
	inputs.roughness_texture = roughness_texture
	inputs.roughness_texture_channel = roughness_texture_channel as BaseMaterial3D.TextureChannel
	inputs.anisotropy = anisotropy
	inputs.anisotropy_flowmap = anisotropy_flowmap
	inputs.anisotropy_rotation = anisotropy_rotation
	inputs.normal_texture = normal_texture
	inputs.normal_scale = normal_scale
	inputs.clearcoat = clearcoat
	inputs.clearcoat_roughness = clearcoat_roughness
	inputs.clearcoat_texture = clearcoat_texture
	inputs.ao_texture = ao_texture
	inputs.ao_texture_channel = ao_texture_channel as BaseMaterial3D.TextureChannel
	inputs.ao_on_uv2 = ao_on_uv2
	inputs.ao_light_affect = ao_light_affect
	inputs.emission = emission
	inputs.emission_energy = emission_energy
	inputs.emission_operator = emission_operator as BaseMaterial3D.EmissionOperator
	inputs.emission_texture = emission_texture
	inputs.uv1_scale = uv1_scale
	inputs.uv1_offset = uv1_offset
	inputs.texture_filter = texture_filter
	inputs.texture_repeat = texture_repeat


func _update() -> void:
	_mutex.lock()
	_queued = false
	var code := get_shader_code()
	if _shader == null or _shader.code != code:
		_shader = _get_variant(code)
		RenderingServer.material_set_shader(_rid, _shader.get_rid())
	MaterialParameters.apply(_inputs, _choice)
	_mutex.unlock()


static func _get_variant(code: String) -> Shader:
	var shader := _find_variant(code)
	if shader != null:
		return shader
	# Not under the lock: what the code includes may have to be loaded, and who loads may wait for
	# other threads, and these for the lock.
	var made := Shader.new()
	made.code = code
	_variants_mutex.lock()
	shader = _find_variant(code)
	if shader == null:
		for other: String in _variants.keys():
			if _variants[other].get_ref() == null:
				_variants.erase(other)
		shader = made
		_variants[code] = weakref(shader)
	_variants_mutex.unlock()
	return shader


static func _find_variant(code: String) -> Shader:
	_variants_mutex.lock()
	var shader: Shader
	if _variants.has(code):
		shader = _variants[code].get_ref()
	_variants_mutex.unlock()
	return shader
