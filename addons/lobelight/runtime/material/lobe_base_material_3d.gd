# gdlint:disable=max-public-methods
# gdlint:disable=max-file-lines
@tool
@abstract class_name LobeBaseMaterial3D
extends ShaderMaterial
## What the surface of a [LobeMaterial3D] looks like, in the words of [BaseMaterial3D].
##
## A property of the same name has the same type, default and effect, so that scripts, tweens and
## animations written for a [StandardMaterial3D] work on a [LobeMaterial3D]. Where a property goes
## further, it says so.

## When [member specular_antialiasing] widens reflections.
enum SpecularAntialiasing {
	## With a normal map.
	AUTOMATIC,
	## Never.
	DISABLED,
	## Always: where meshes are curved, too.
	ENABLED,
}

## How many lobes a material draws.
enum Quality {
	## As many as the widths need: those of the set where they are nearly round or wide, eight with the
	## ready sets; for long ones 12 to 40, up to 24 in the range of Godot's own materials.
	AUTOMATIC = 0,
	## Those of the set, whatever the widths.
	LOBES_8 = 8,
	## Of long widths, 16 lobes at most.
	LOBES_16 = 16,
	## Of long widths, 24 lobes at most.
	LOBES_24 = 24,
	## Of long widths, 32 lobes at most.
	LOBES_32 = 32,
	## Of long widths, 40 lobes at most, as with Automatic.
	LOBES_40 = 40,
}

# The hints of enumerations, as BaseMaterial3D's own.
const _TRANSPARENCIES := "Disabled,Alpha,Alpha Scissor,Alpha Hash,Depth Pre-Pass"
const _BLEND_MODES := "Mix,Add,Subtract,Multiply,Premultiplied Alpha"
const _CULL_MODES := "Back,Front,Disabled"
const _ALPHA_ANTIALIASINGS := "Disabled,Alpha Edge Blend,Alpha Edge Clip"
const _DEPTH_DRAW_MODES := "Opaque Only,Always,Never"
const _DEPTH_TESTS := "Default,Inverted"
const _SHADING_MODES := "Unshaded,Per-Pixel,Per-Vertex"
const _DIFFUSE_MODES := "Burley,Lambert,Lambert Wrap,Toon"
const _SPECULAR_MODES := "SchlickGGX,Toon,Disabled"
const _CHANNELS := "Red,Green,Blue,Alpha,Gray"
const _OPERATORS := "Add,Multiply"
const _QUALITIES := "Automatic:0,8 Lobes:8,16 Lobes:16,24 Lobes:24,32 Lobes:32,40 Lobes:40"
const _FILTERS := (
	"Nearest,Linear,Nearest Mipmap,Linear Mipmap,Nearest Mipmap Anisotropic,"
	+ "Linear Mipmap Anisotropic"
)
const _DETAIL_BLEND_MODES := "Mix,Add,Subtract,Multiply"
const _UV_LAYERS := "UV1,UV2"
const _BILLBOARD_MODES := "Disabled,Enabled,Y-Billboard,Particle Billboard"
const _DISTANCE_FADES := "Disabled,PixelAlpha,PixelDither,ObjectDither"
const _STENCIL_MODES := "Disabled,Outline,X-Ray,Custom"
const _STENCIL_FLAGS := "Read,Write,Write Depth Fail"
const _STENCIL_COMPARISONS := "Always,Less,Equal,Less Or Equal,Greater,Not Equal,Greater Or Equal"
const _PHYSICAL_UNITS := "rendering/lights_and_shadows/use_physical_light_units"

const Numbers := preload("surface_numbers.gd")
const StencilPass := preload("stencil_pass.gd")
const Widths := preload("../table/widths.gd")

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

## How many lobes a pixel is drawn with, each of them a look-up in the environment. Where one width
## is more than three times the other, few lobes show each lamp as often as there are lobes. With
## GGX and Ward such widths have lobes of their own, which are computed instead of looked up in a
## table, as many as are needed. Widths that are nearly round or both wide, all other BRDFs and
## materials with a [member table] are drawn with the lobes that their tables have. Between ratios
## of 3 and 3.6 (of Ward, 4.5 and 5.4), and between narrower widths of 0.06 and 0.1, both are drawn,
## so that nothing is seen of the change.
@export_custom(PROPERTY_HINT_ENUM, _QUALITIES) var quality := Quality.AUTOMATIC:
	set(value):
		quality = value
		_queue_update()

@export_group("Transparency")
## Whether and how [member albedo_color]'s alpha makes the surface transparent. Compatibility has no
## alpha hash; there it blends.
@export_custom(PROPERTY_HINT_ENUM, _TRANSPARENCIES)
var transparency: BaseMaterial3D.Transparency = BaseMaterial3D.TRANSPARENCY_DISABLED:
	set(value):
		transparency = value
		notify_property_list_changed()
		_queue_update()
## What is less opaque is not drawn.
@export_range(0.0, 1.0, 0.001) var alpha_scissor_threshold := 0.5:
	set(value):
		if value != alpha_scissor_threshold:
			alpha_scissor_threshold = value
			_send(&"lobelight_alpha_scissor_threshold", value)
## The size of the grain.
@export_range(0.0, 2.0, 0.01) var alpha_hash_scale := 1.0:
	set(value):
		if value != alpha_hash_scale:
			alpha_hash_scale = value
			_send(&"lobelight_alpha_hash_scale", value)
## Smooth edges for alpha scissor and alpha hash, where the viewport has MSAA.
@export_custom(PROPERTY_HINT_ENUM, _ALPHA_ANTIALIASINGS)
var alpha_antialiasing_mode: BaseMaterial3D.AlphaAntiAliasing = (
	BaseMaterial3D.ALPHA_ANTIALIASING_OFF
):
	set(value):
		alpha_antialiasing_mode = value
		notify_property_list_changed()
		_queue_update()
## How far above the threshold the smooth edge reaches.
@export_range(0.0, 1.0, 0.01) var alpha_antialiasing_edge := 0.3:
	set(value):
		if value != alpha_antialiasing_edge:
			alpha_antialiasing_edge = value
			_send(&"lobelight_alpha_edge", value)
## How the surface is blended with what is behind it.
@export_custom(PROPERTY_HINT_ENUM, _BLEND_MODES)
var blend_mode: BaseMaterial3D.BlendMode = BaseMaterial3D.BLEND_MODE_MIX:
	set(value):
		blend_mode = value
		_queue_update()
## The side that is not drawn. With CULL_DISABLED, back faces are lit as front faces of the other
## side.
@export_custom(PROPERTY_HINT_ENUM, _CULL_MODES)
var cull_mode: BaseMaterial3D.CullMode = BaseMaterial3D.CULL_BACK:
	set(value):
		cull_mode = value
		_queue_update()
## When the surface hides what is drawn later behind it.
@export_custom(PROPERTY_HINT_ENUM, _DEPTH_DRAW_MODES)
var depth_draw_mode: BaseMaterial3D.DepthDrawMode = BaseMaterial3D.DEPTH_DRAW_OPAQUE_ONLY:
	set(value):
		depth_draw_mode = value
		_queue_update()
## Whether the surface is drawn in front of everything that was drawn before.
@export var no_depth_test := false:
	set(value):
		no_depth_test = value
		notify_property_list_changed()
		_queue_update()
## Inverted, the surface is seen only where something is in front of it. Such a surface is
## drawn with the transparent ones.
@export_custom(PROPERTY_HINT_ENUM, _DEPTH_TESTS)
var depth_test: BaseMaterial3D.DepthTest = BaseMaterial3D.DEPTH_TEST_DEFAULT:
	set(value):
		depth_test = value
		_queue_update()

@export_group("Shading")
## Unshaded, the surface shows [member albedo_color] and knows of no light. Per vertex, the
## engine's lamps are computed at the vertices; the surroundings stay per pixel.
@export_custom(PROPERTY_HINT_ENUM, _SHADING_MODES)
var shading_mode: BaseMaterial3D.ShadingMode = BaseMaterial3D.SHADING_MODE_PER_PIXEL:
	set(value):
		shading_mode = value
		notify_property_list_changed()
		_queue_update()
## How the diffuse part shows the engine's lamps.
@export_custom(PROPERTY_HINT_ENUM, _DIFFUSE_MODES)
var diffuse_mode: BaseMaterial3D.DiffuseMode = BaseMaterial3D.DIFFUSE_BURLEY:
	set(value):
		diffuse_mode = value
		_queue_update()
## How the engine's lamps are reflected. The surroundings are reflected in any case.
@export_custom(PROPERTY_HINT_ENUM, _SPECULAR_MODES)
var specular_mode: BaseMaterial3D.SpecularMode = BaseMaterial3D.SPECULAR_SCHLICK_GGX:
	set(value):
		specular_mode = value
		_queue_update()
## Whether the light of the surroundings is left out: that of the environment and the probes as
## well as the engine's ambient light. Lamps still shine.
@export var disable_ambient_light := false:
	set(value):
		disable_ambient_light = value
		_queue_update()
## Whether fog leaves the surface as it is.
@export var disable_fog := false:
	set(value):
		disable_fog = value
		_queue_update()
## Whether reflections do without the occlusion that [member ao_texture], [member
## bent_normal_texture] and [member normal_texture] make. Each lobe is occluded by its own direction
## and width: what is near hides those more that point away from what is open, and those of a bent
## normal that point below the mesh's horizon meet the surface, which is as bright as its colour.
## Diffuse light is occluded all the same.
@export var disable_specular_occlusion := false:
	set(value):
		disable_specular_occlusion = value
		_queue_update()

@export_group("Vertex Color", "vertex_color")
## Multiplies [member albedo_color] with the mesh's colours.
@export var vertex_color_use_as_albedo := false:
	set(value):
		vertex_color_use_as_albedo = value
		_queue_update()
## Whether the mesh's colours are sRGB.
@export var vertex_color_is_srgb := false:
	set(value):
		vertex_color_is_srgb = value
		_queue_update()

@export_group("Albedo", "albedo_")
## The colour. Metals reflect this share of the light at normal incidence, and at grazing angles all
## of it, by Schlick's approximation; other materials scatter it. Alpha is the opacity, see
## [member transparency].
@export var albedo_color := Color.WHITE:
	set(value):
		if value != albedo_color:
			var before := albedo_color
			albedo_color = value
			_update_albedo(before)
## Multiplied with [member albedo_color].
@export var albedo_texture: Texture2D:
	set(value):
		albedo_texture = value
		_queue_update()
## Decodes [member albedo_texture] from sRGB, though it says that it is linear.
@export var albedo_texture_force_srgb := false:
	set(value):
		albedo_texture_force_srgb = value
		_queue_update()
## Takes [member albedo_texture] for a signed distance field in several channels, as those of fonts
## are. It has no effect with [member uv1_triplanar].
@export var albedo_texture_msdf := false:
	set(value):
		albedo_texture_msdf = value
		notify_property_list_changed()
		_queue_update()

@export_group("ORM", "orm_")
## Factors of [member roughness] and [member metallic] in green and blue, and with [member
## ao_enabled], occlusion in red. It replaces the textures of the three, as in [ORMMaterial3D].
@export var orm_texture: Texture2D:
	set(value):
		orm_texture = value
		_queue_update()

@export_group("Metallic", "metallic_")
## 1 for metals, 0 for everything else. Pure metals cost less, as they have no diffuse light.
@export_range(0.0, 1.0, 0.01) var metallic := 0.0:
	set(value):
		value = clampf(value, 0.0, 1.0)
		if value != metallic:
			var before := metallic
			metallic = value
			_update_metallic(before)
## How much light is reflected by what is no metal: 16 % of the square, so that 0.5 is the 4 % of
## plastic and glass.
@export_range(0.0, 1.0, 0.01) var metallic_specular := 0.5:
	set(value):
		value = clampf(value, 0.0, 1.0)
		if value != metallic_specular:
			metallic_specular = value
			_send(&"lobelight_specular_amount", value)
			_send(&"lobelight_dielectric", Numbers.dielectric(value))
## A factor of [member metallic].
@export var metallic_texture: Texture2D:
	set(value):
		metallic_texture = value
		_queue_update()
## The channel of [member metallic_texture].
@export_custom(PROPERTY_HINT_ENUM, _CHANNELS)
var metallic_texture_channel: BaseMaterial3D.TextureChannel = BaseMaterial3D.TEXTURE_CHANNEL_RED:
	set(value):
		metallic_texture_channel = value
		_queue_update()

@export_group("Roughness", "roughness_")
## From 0, nearly a mirror, to 1. [method LobeMaterial3D.widths_of] tells what it does.
@export_range(0.0, 1.0, 0.001) var roughness := 1.0:
	set(value):
		value = clampf(value, 0.0, 1.0)
		if value != roughness:
			roughness = value
			_update_widths()
## A factor of [member roughness]. With it, tables are looked up for each pixel: as many fetches as
## without where the material is not anisotropic, otherwise twice as many. The widths of [member
## LobeMaterial3D.table_set] must grow by equal factors for it, as those of the ready sets do, and
## with anisotropy there may be 22 of them, since 3D textures have 256 layers; otherwise it is for
## the engine's own lights only.
@export var roughness_texture: Texture2D:
	set(value):
		roughness_texture = value
		_queue_update()
## The channel of [member roughness_texture].
@export_custom(PROPERTY_HINT_ENUM, _CHANNELS)
var roughness_texture_channel: BaseMaterial3D.TextureChannel = BaseMaterial3D.TEXTURE_CHANNEL_RED:
	set(value):
		roughness_texture_channel = value
		_queue_update()

@export_group("Emission", "emission_")
## Whether the surface sends out light by itself.
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var emission_enabled := false:
	set(value):
		emission_enabled = value
		_queue_update()
## The light that it sends out.
@export_color_no_alpha var emission := Color.BLACK:
	set(value):
		if value != emission:
			var was_dark := emission.r == 0.0 and emission.g == 0.0 and emission.b == 0.0
			emission = value
			if was_dark or value.r == 0.0 and value.g == 0.0 and value.b == 0.0:
				_queue_update()
			elif emission_enabled:
				_send_emission()
## A factor for [member emission] and its texture.
@export_range(0.0, 16.0, 0.01, "or_greater") var emission_energy_multiplier := 1.0:
	set(value):
		if value != emission_energy_multiplier:
			var before := emission_energy_multiplier
			emission_energy_multiplier = value
			_update_emission_energy((before == 0.0) != (value == 0.0))
## What [member emission] is in nits, with physical light units; [member
## emission_energy_multiplier] is a factor of it. Without such units it does not count.
@export_range(0.0, 100000.0, 0.01, "or_greater", "suffix:nt") var emission_intensity := 1000.0:
	set(value):
		if value != emission_intensity:
			emission_intensity = value
			_update_emission_energy(false)
## Whether [member emission_texture] is added to or multiplied with [member emission].
@export_custom(PROPERTY_HINT_ENUM, _OPERATORS)
var emission_operator: BaseMaterial3D.EmissionOperator = BaseMaterial3D.EMISSION_OP_ADD:
	set(value):
		emission_operator = value
		_queue_update()
## Whether [member emission_texture] lies on the mesh's second texture coordinates.
@export var emission_on_uv2 := false:
	set(value):
		emission_on_uv2 = value
		_queue_update()
## More light that the surface sends out.
@export var emission_texture: Texture2D:
	set(value):
		emission_texture = value
		_queue_update()

@export_group("Normal Map", "normal_")
## Whether [member normal_texture] bends the normal. The mesh needs tangents.
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var normal_enabled := false:
	set(value):
		normal_enabled = value
		_queue_update()
## The strength of the normal map.
@export_range(-16.0, 16.0, 0.01) var normal_scale := 1.0:
	set(value):
		if value != normal_scale:
			normal_scale = value
			_send(&"lobelight_normal_scale", value if normal_enabled else 1.0)
## A tangent-space normal map.
@export var normal_texture: Texture2D:
	set(value):
		normal_texture = value
		_queue_update()
## How much the normals of [member normal_texture] differ within each texel of its smaller levels.
## Bumps seen from afar need it to look as rough as they are. The inspector makes it, with [b]Bake
## Normal Variance[/b], and so does [method LobeMaterial3D.bake_normal_variance]. It takes one
## fetch. [BaseMaterial3D] has none.
@export var normal_variance_texture: Texture2D:
	set(value):
		normal_variance_texture = value
		_queue_update()
## Whether reflections are as wide as the BRDF and the normals within each pixel together, so that
## bumps do not sparkle when the camera moves. [BaseMaterial3D] has none.
@export var specular_antialiasing := SpecularAntialiasing.AUTOMATIC:
	set(value):
		specular_antialiasing = value
		_queue_update()

@export_group("Bent Normal Map", "bent_normal_")
## Whether [member bent_normal_texture] tells where the light comes from. The mesh needs tangents.
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var bent_normal_enabled := false:
	set(value):
		bent_normal_enabled = value
		_queue_update()
## A tangent-space map of the mean directions of what the surface sees. Diffuse light arrives from
## there, and with [member ao_enabled], reflections are occluded away from there.
@export var bent_normal_texture: Texture2D:
	set(value):
		bent_normal_texture = value
		_queue_update()

@export_group("Rim", "rim_")
## Whether lamps light the rim of the surface, as on velvet. The surroundings do not.
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var rim_enabled := false:
	set(value):
		rim_enabled = value
		_queue_update()
## The strength of the rim.
@export_range(0.0, 1.0, 0.01) var rim := 1.0:
	set(value):
		if value != rim:
			rim = value
			_send(&"lobelight_rim_amount", Vector2(rim, rim_tint))
## How far the rim goes from white to [member albedo_color].
@export_range(0.0, 1.0, 0.01) var rim_tint := 0.5:
	set(value):
		if value != rim_tint:
			rim_tint = value
			_send(&"lobelight_rim_amount", Vector2(rim, rim_tint))
## Factors of [member rim] in red and of [member rim_tint] in green.
@export var rim_texture: Texture2D:
	set(value):
		rim_texture = value
		_queue_update()

@export_group("Clearcoat", "clearcoat_")
## Whether there is a clear lacquer over the material. It has lobes of its own, and costs as many
## fetches again.
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var clearcoat_enabled := false:
	set(value):
		clearcoat_enabled = value
		_queue_update()
## The strength of the lacquer.
@export_range(0.0, 1.0, 0.01) var clearcoat := 1.0:
	set(value):
		value = clampf(value, 0.0, 1.0)
		if value != clearcoat:
			var before := clearcoat
			clearcoat = value
			_update_coat_amount((before == 0.0) != (value == 0.0))
## The lacquer's roughness: its width is between 0.001 and 0.1.
@export_range(0.0, 1.0, 0.01) var clearcoat_roughness := 0.5:
	set(value):
		value = clampf(value, 0.0, 1.0)
		if value != clearcoat_roughness:
			clearcoat_roughness = value
			_queue_look()
## Factors of [member clearcoat] in red and of [member clearcoat_roughness] in green, the latter for
## the engine's own lights only.
@export var clearcoat_texture: Texture2D:
	set(value):
		clearcoat_texture = value
		_queue_update()

@export_group("Sheen", "sheen_")
## Whether there are upright fibres over the material, as on velvet and other cloth. They have four
## lobes of their own, fitted to Charlie's BRDF, and take their light from what lies below. The
## engine's own lights do not show them. [BaseMaterial3D] has none.
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var sheen_enabled := false:
	set(value):
		sheen_enabled = value
		_queue_update()
## The colour of the fibres.
@export_color_no_alpha var sheen_color := Color.WHITE:
	set(value):
		if value != sheen_color:
			var before := sheen_color
			sheen_color = value
			_update_sheen_tint(_is_dark(before) != _is_dark(value))
## Multiplied with [member sheen_color].
@export var sheen_texture: Texture2D:
	set(value):
		sheen_texture = value
		_queue_update()
## How much the fibres diverge: with little, the sheen is at the rim only. What is less than 0.2 is
## taken for 0.2.
@export_range(0.0, 1.0, 0.01) var sheen_roughness := 0.5:
	set(value):
		value = clampf(value, 0.0, 1.0)
		if value != sheen_roughness:
			sheen_roughness = value
			_queue_look()

@export_group("Anisotropy", "anisotropy_")
## Whether highlights are wider along the tangent than across, as on brushed metal. Meshes need
## tangents for it.
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var anisotropy_enabled := false:
	set(value):
		anisotropy_enabled = value
		_queue_update()
## How much wider highlights are along the tangent than across: from −1 to 1 the same as [member
## BaseMaterial3D.anisotropy], widths being 10:1 at 1 and 1:1.9 at −1, and beyond that up to 100:1
## at 1.1.
@export_range(-1.0, 1.1, 0.001) var anisotropy := 0.0:
	set(value):
		value = clampf(value, -1.0, Widths.MAX_ANISOTROPY)
		if value != anisotropy:
			anisotropy = value
			if anisotropy_enabled:
				_update_widths()
## Where the tangent of the lobes points: red and green are the direction, alpha a factor of [member
## anisotropy]. It has no say where the anisotropy is negative. Without an alpha channel it does not
## cost more fetches.
@export var anisotropy_flowmap: Texture2D:
	set(value):
		anisotropy_flowmap = value
		_queue_update()
## An angle from the mesh's tangent, towards its bitangent, to the direction in which the first
## width is measured; added to that of [member anisotropy_flowmap]. [BaseMaterial3D] has none.
@export_range(-180.0, 180.0, 0.1, "radians_as_degrees") var anisotropy_rotation := 0.0:
	set(value):
		if value != anisotropy_rotation:
			var before := anisotropy_rotation
			anisotropy_rotation = value
			_update_rotation((before == 0.0) != (value == 0.0))

@export_group("Ambient Occlusion", "ao_")
## Whether [member ao_texture], or the red channel of [member orm_texture], darkens the light of the
## surroundings.
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var ao_enabled := false:
	set(value):
		ao_enabled = value
		_queue_update()
## How much the occlusion darkens the engine's own lights.
@export_range(0.0, 1.0, 0.01) var ao_light_affect := 0.0:
	set(value):
		if value != ao_light_affect:
			ao_light_affect = value
			_send(&"lobelight_ao_light_affect", value)
## The share of the surroundings that the surface sees. Reflections are occluded by it as well, see
## [member disable_specular_occlusion].
@export var ao_texture: Texture2D:
	set(value):
		ao_texture = value
		_queue_update()
## Whether [member ao_texture] lies on the mesh's second texture coordinates.
@export var ao_on_uv2 := false:
	set(value):
		ao_on_uv2 = value
		_queue_update()
## The channel of [member ao_texture].
@export_custom(PROPERTY_HINT_ENUM, _CHANNELS)
var ao_texture_channel: BaseMaterial3D.TextureChannel = BaseMaterial3D.TEXTURE_CHANNEL_RED:
	set(value):
		ao_texture_channel = value
		_queue_update()

@export_group("Height", "heightmap_")
## Whether [member heightmap_texture] moves textures as a relief would. The mesh needs tangents. It
## has no effect with [member uv1_triplanar].
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var heightmap_enabled := false:
	set(value):
		heightmap_enabled = value
		_queue_update()
## How deep the relief is, in hundredths of the texture's breadth.
@export_range(-16.0, 16.0, 0.001) var heightmap_scale := 5.0:
	set(value):
		if value != heightmap_scale:
			heightmap_scale = value
			_send(&"lobelight_relief", Numbers.relief(value))
## Whether the view is followed through the relief, layer by layer, so that high places cover low
## ones. It costs a fetch a layer.
@export var heightmap_deep_parallax := false:
	set(value):
		heightmap_deep_parallax = value
		notify_property_list_changed()
		_queue_update()
## Layers where the surface is seen from the front.
@export_range(1, 64, 1) var heightmap_min_layers := 8:
	set(value):
		heightmap_min_layers = value
		_queue_update()
## Layers where the surface is seen from the side.
@export_range(1, 64, 1) var heightmap_max_layers := 32:
	set(value):
		heightmap_max_layers = value
		_queue_update()
## Whether the mesh's tangents point the other way.
@export var heightmap_flip_tangent := false:
	set(value):
		heightmap_flip_tangent = value
		_queue_update()
## Whether the mesh's bitangents point the other way.
@export var heightmap_flip_binormal := false:
	set(value):
		heightmap_flip_binormal = value
		_queue_update()
## The heights, in red: white is as high as the mesh. Without it, [member heightmap_enabled] has no
## effect.
@export var heightmap_texture: Texture2D:
	set(value):
		heightmap_texture = value
		_queue_update()
## Whether the texture has depths in place of heights.
@export var heightmap_flip_texture := false:
	set(value):
		heightmap_flip_texture = value
		_queue_update()

@export_group("Subsurf Scatter", "subsurf_scatter_")
## Whether light spreads below the surface, in Forward+ only. It spreads all that the surface
## shows but the reflections of lamps.
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var subsurf_scatter_enabled := false:
	set(value):
		subsurf_scatter_enabled = value
		_queue_update()
## The strength of the spread.
@export_range(0.0, 1.0, 0.01) var subsurf_scatter_strength := 0.0:
	set(value):
		if value != subsurf_scatter_strength:
			subsurf_scatter_strength = value
			_send(&"lobelight_scattering", value)
## Whether it spreads as in skin.
@export var subsurf_scatter_skin_mode := false:
	set(value):
		subsurf_scatter_skin_mode = value
		notify_property_list_changed()
		_queue_update()
## A factor of [member subsurf_scatter_strength], in red.
@export var subsurf_scatter_texture: Texture2D:
	set(value):
		subsurf_scatter_texture = value
		_queue_update()

@export_subgroup("Transmittance", "subsurf_scatter_transmittance_")
## Whether lamps shine through thin parts, with [member subsurf_scatter_enabled].
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var subsurf_scatter_transmittance_enabled := false:
	set(value):
		subsurf_scatter_transmittance_enabled = value
		_queue_update()
## The colour of what shines through.
@export var subsurf_scatter_transmittance_color := Color.WHITE:
	set(value):
		if value != subsurf_scatter_transmittance_color:
			subsurf_scatter_transmittance_color = value
			_send(&"lobelight_transmitted", value)
## A factor of [member subsurf_scatter_transmittance_color].
@export var subsurf_scatter_transmittance_texture: Texture2D:
	set(value):
		subsurf_scatter_transmittance_texture = value
		_queue_update()
## The depth to which lamps shine through.
@export_range(0.001, 8.0, 0.001, "or_greater") var subsurf_scatter_transmittance_depth := 0.1:
	set(value):
		if value != subsurf_scatter_transmittance_depth:
			subsurf_scatter_transmittance_depth = value
			_update_transmittance()
## Makes what shines through brighter.
@export_range(0.0, 1.0, 0.01) var subsurf_scatter_transmittance_boost := 0.0:
	set(value):
		if value != subsurf_scatter_transmittance_boost:
			subsurf_scatter_transmittance_boost = value
			_update_transmittance()

@export_group("Back Lighting", "backlight_")
## Whether lamps behind the surface shine through it, as through a leaf.
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var backlight_enabled := false:
	set(value):
		backlight_enabled = value
		_queue_update()
## The colour of what shines through.
@export_color_no_alpha var backlight := Color.BLACK:
	set(value):
		if value != backlight:
			backlight = value
			_send(&"lobelight_backlight", value)
## Added to [member backlight].
@export var backlight_texture: Texture2D:
	set(value):
		backlight_texture = value
		_queue_update()

@export_group("Refraction", "refraction_")
## Whether what is behind the surface is seen through it, bent, and blurred by [member roughness].
## The alpha of [member albedo_color] says how much of it.
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var refraction_enabled := false:
	set(value):
		refraction_enabled = value
		_queue_update()
## How much is bent.
@export_range(-1.0, 1.0, 0.01) var refraction_scale := 0.05:
	set(value):
		if value != refraction_scale:
			refraction_scale = value
			_send(&"lobelight_refraction", value)
## A factor of [member refraction_scale].
@export var refraction_texture: Texture2D:
	set(value):
		refraction_texture = value
		_queue_update()
## The channel of [member refraction_texture].
@export_custom(PROPERTY_HINT_ENUM, _CHANNELS)
var refraction_texture_channel: BaseMaterial3D.TextureChannel = BaseMaterial3D.TEXTURE_CHANNEL_RED:
	set(value):
		refraction_texture_channel = value
		_queue_update()

@export_group("Detail", "detail_")
## Whether the detail textures lie over the others.
@export_custom(PROPERTY_HINT_GROUP_ENABLE, "") var detail_enabled := false:
	set(value):
		detail_enabled = value
		_queue_update()
## Where there is detail, in red; without it, everywhere. It lies on the first texture
## coordinates.
@export var detail_mask: Texture2D:
	set(value):
		detail_mask = value
		_queue_update()
## How [member detail_albedo] is put over the colour.
@export_custom(PROPERTY_HINT_ENUM, _DETAIL_BLEND_MODES)
var detail_blend_mode: BaseMaterial3D.BlendMode = BaseMaterial3D.BLEND_MODE_MIX:
	set(value):
		detail_blend_mode = value
		_queue_update()
## The texture coordinates of [member detail_albedo] and [member detail_normal].
@export_custom(PROPERTY_HINT_ENUM, _UV_LAYERS)
var detail_uv_layer: BaseMaterial3D.DetailUV = BaseMaterial3D.DETAIL_UV_1:
	set(value):
		detail_uv_layer = value
		_queue_update()
## The detail's colour; its alpha is how much of it, and of [member detail_normal], there is.
## Without it, white.
@export var detail_albedo: Texture2D:
	set(value):
		detail_albedo = value
		_queue_update()
## A tangent-space normal map, in place of [member normal_texture] where there is detail. Without
## it, flat.
@export var detail_normal: Texture2D:
	set(value):
		detail_normal = value
		_queue_update()

@export_group("UV1", "uv1_")
## A factor for the texture coordinates. The third is for [member uv1_triplanar].
@export_custom(PROPERTY_HINT_LINK, "") var uv1_scale := Vector3.ONE:
	set(value):
		if value != uv1_scale:
			var is_other := value == Vector3.ONE or uv1_scale == Vector3.ONE
			uv1_scale = value
			_update_uv1(is_other)
## Added to the texture coordinates after their scale. The third is for [member uv1_triplanar].
@export var uv1_offset := Vector3.ZERO:
	set(value):
		if value != uv1_offset:
			var is_other := value == Vector3.ZERO or uv1_offset == Vector3.ZERO
			uv1_offset = value
			_update_uv1(is_other)
## Whether textures are laid on the surface along its three axes, and mixed by the normal, in place
## of by texture coordinates. It costs three fetches for one, and gives meshes tangents of its own.
@export var uv1_triplanar := false:
	set(value):
		uv1_triplanar = value
		notify_property_list_changed()
		_queue_update()
## How quickly the three change into one another.
@export_exp_easing var uv1_triplanar_sharpness := 1.0:
	set(value):
		if value != uv1_triplanar_sharpness:
			uv1_triplanar_sharpness = value
			_send(&"lobelight_uv1_sharpness", value)
## Whether the three axes are the world's.
@export var uv1_world_triplanar := false:
	set(value):
		uv1_world_triplanar = value
		_queue_update()

@export_group("UV2", "uv2_")
## A factor for the second texture coordinates. As with [BaseMaterial3D], it has an effect where
## [member detail_uv_layer] is the second, and with [member uv2_triplanar].
@export_custom(PROPERTY_HINT_LINK, "") var uv2_scale := Vector3.ONE:
	set(value):
		if value != uv2_scale:
			var is_other := value == Vector3.ONE or uv2_scale == Vector3.ONE
			uv2_scale = value
			_update_uv2(is_other)
## Added to the second texture coordinates after their scale, where that has an effect.
@export var uv2_offset := Vector3.ZERO:
	set(value):
		if value != uv2_offset:
			var is_other := value == Vector3.ZERO or uv2_offset == Vector3.ZERO
			uv2_offset = value
			_update_uv2(is_other)
## The same as [member uv1_triplanar] for textures on the second texture coordinates.
@export var uv2_triplanar := false:
	set(value):
		uv2_triplanar = value
		notify_property_list_changed()
		_queue_update()
## How quickly the three change into one another.
@export_exp_easing var uv2_triplanar_sharpness := 1.0:
	set(value):
		if value != uv2_triplanar_sharpness:
			uv2_triplanar_sharpness = value
			_send(&"lobelight_uv2_sharpness", value)
## Whether the three axes are the world's.
@export var uv2_world_triplanar := false:
	set(value):
		uv2_world_triplanar = value
		_queue_update()

@export_group("Sampling", "texture_")
## How textures are filtered.
@export_custom(PROPERTY_HINT_ENUM, _FILTERS)
var texture_filter := BaseMaterial3D.TEXTURE_FILTER_LINEAR_WITH_MIPMAPS:
	set(value):
		texture_filter = value
		_queue_update()
## Whether textures repeat.
@export var texture_repeat := true:
	set(value):
		texture_repeat = value
		_queue_update()

@export_group("Shadows")
## Whether shadows leave the surface as it is.
@export var disable_receive_shadows := false:
	set(value):
		disable_receive_shadows = value
		_queue_update()
## Whether the surface is opaque where shadows fall, and transparent elsewhere. As its opacity comes
## from it, the engine's ambient light is then the light of the surroundings.
@export var shadow_to_opacity := false:
	set(value):
		shadow_to_opacity = value
		_queue_update()

@export_group("Billboard", "billboard_")
## How the object turns to the camera.
@export_custom(PROPERTY_HINT_ENUM, _BILLBOARD_MODES)
var billboard_mode: BaseMaterial3D.BillboardMode = BaseMaterial3D.BILLBOARD_DISABLED:
	set(value):
		billboard_mode = value
		notify_property_list_changed()
		_queue_update()
## Whether an object that turns to the camera keeps its scale.
@export var billboard_keep_scale := false:
	set(value):
		billboard_keep_scale = value
		_queue_update()

@export_group("Particles Anim", "particles_anim_")
## The columns of the pictures in a sheet of them. Particles show one after the other.
@export_range(1, 128, 1) var particles_anim_h_frames := 1:
	set(value):
		particles_anim_h_frames = value
		_queue_update()
## The rows of the pictures in a sheet of them.
@export_range(1, 128, 1) var particles_anim_v_frames := 1:
	set(value):
		particles_anim_v_frames = value
		_queue_update()
## Whether the last picture is followed by the first.
@export var particles_anim_loop := false:
	set(value):
		particles_anim_loop = value
		_queue_update()

@export_group("Grow", "grow_")
## Whether vertices move along their normals.
@export var grow := false:
	set(value):
		grow = value
		notify_property_list_changed()
		_queue_update()
## How far they move.
@export_range(-16.0, 16.0, 0.001, "suffix:m") var grow_amount := 0.0:
	set(value):
		if value != grow_amount:
			grow_amount = value
			_send(&"lobelight_grow_amount", value)

@export_group("Transform")
## Whether the object has the same size on the screen, however far away it is.
@export var fixed_size := false:
	set(value):
		fixed_size = value
		_queue_update()
## Whether points have a [member point_size]; [member albedo_texture] is then laid on each of them.
@export var use_point_size := false:
	set(value):
		use_point_size = value
		notify_property_list_changed()
		_queue_update()
## The size of points.
@export_range(0.1, 128.0, 0.1, "suffix:px") var point_size := 1.0:
	set(value):
		if value != point_size:
			point_size = value
			_send(&"lobelight_point_size", value)
## For particles with trails.
@export var use_particle_trails := false:
	set(value):
		use_particle_trails = value
		_queue_update()
## Whether [member z_clip_scale] moves the object towards the camera in depth.
@export var use_z_clip_scale := false:
	set(value):
		use_z_clip_scale = value
		notify_property_list_changed()
		_queue_update()
## A factor for depths, so that an object in the hand does not reach into walls. Shadows and
## effects of the screen do not follow it.
@export_range(0.01, 1.0, 0.01) var z_clip_scale := 1.0:
	set(value):
		if value != z_clip_scale:
			z_clip_scale = value
			_send(&"lobelight_z_clip_scale", value)
## Whether [member fov_override] stands in for the camera's field of view.
@export var use_fov_override := false:
	set(value):
		use_fov_override = value
		notify_property_list_changed()
		_queue_update()
## The field of view that the object is drawn with.
@export_range(1.0, 179.0, 0.1, "degrees") var fov_override := 75.0:
	set(value):
		if value != fov_override:
			fov_override = value
			_send(&"lobelight_fov_cotangent", Numbers.cotangent(value))

@export_group("Proximity Fade", "proximity_fade_")
## Whether the surface fades out where it comes close to what is behind it.
@export var proximity_fade_enabled := false:
	set(value):
		proximity_fade_enabled = value
		notify_property_list_changed()
		_queue_update()
## The distance over which it fades.
@export_range(0.01, 4096.0, 0.01, "suffix:m") var proximity_fade_distance := 1.0:
	set(value):
		if value != proximity_fade_distance:
			proximity_fade_distance = value
			_send(&"lobelight_proximity", value)

@export_group("MSDF", "msdf_")
## The breadth of the field around outlines, in texels.
@export_range(1.0, 100.0, 1.0) var msdf_pixel_range := 4.0:
	set(value):
		if value != msdf_pixel_range:
			msdf_pixel_range = value
			_send(&"lobelight_msdf_range", value)
## The breadth of an outline, in texels.
@export_range(0.0, 250.0, 1.0) var msdf_outline_size := 0.0:
	set(value):
		if value != msdf_outline_size:
			msdf_outline_size = value
			_send(&"lobelight_msdf_outline", value)

@export_group("Distance Fade", "distance_fade_")
## Whether and how the surface fades with its distance from the camera.
@export_custom(PROPERTY_HINT_ENUM, _DISTANCE_FADES)
var distance_fade_mode: BaseMaterial3D.DistanceFadeMode = BaseMaterial3D.DISTANCE_FADE_DISABLED:
	set(value):
		distance_fade_mode = value
		notify_property_list_changed()
		_queue_update()
## The distance at which nothing is seen of the surface.
@export_range(0.0, 4096.0, 0.01, "suffix:m") var distance_fade_min_distance := 0.0:
	set(value):
		if value != distance_fade_min_distance:
			distance_fade_min_distance = value
			_update_fade_limits()
## The distance at which all is seen of the surface. Where it is the smaller one, the surface fades
## as it goes away.
@export_range(0.0, 4096.0, 0.01, "suffix:m") var distance_fade_max_distance := 10.0:
	set(value):
		if value != distance_fade_max_distance:
			distance_fade_max_distance = value
			_update_fade_limits()

@export_group("Stencil", "stencil_")
## An effect with the stencil buffer. Outline and X-Ray put a material of their own before [member
## Material.next_pass], as in [BaseMaterial3D].
@export_custom(PROPERTY_HINT_ENUM, _STENCIL_MODES)
var stencil_mode: BaseMaterial3D.StencilMode = BaseMaterial3D.STENCIL_MODE_DISABLED:
	set(value):
		if value == stencil_mode or not StencilPass.is_possible(self, value):
			return
		stencil_mode = value
		StencilPass.choose(self, value)
		if has_stencil_pass():
			stencil_flags = BaseMaterial3D.STENCIL_FLAG_WRITE
			stencil_compare = BaseMaterial3D.STENCIL_COMPARE_ALWAYS
		_hand_on_stencil()
		notify_property_list_changed()
		_queue_update()
## What is done with the stencil buffer.
@export_custom(PROPERTY_HINT_FLAGS, _STENCIL_FLAGS) var stencil_flags := 0:
	set(value):
		stencil_flags = StencilPass.without_conflict(value, stencil_flags)
		_queue_update()
## How [member stencil_reference] has to compare with the stencil buffer where the surface is drawn.
@export_custom(PROPERTY_HINT_ENUM, _STENCIL_COMPARISONS)
var stencil_compare: BaseMaterial3D.StencilCompare = BaseMaterial3D.STENCIL_COMPARE_ALWAYS:
	set(value):
		stencil_compare = value
		_queue_update()
## What is written into the stencil buffer, or compared with it.
@export_range(0, 255, 1) var stencil_reference := 1:
	set(value):
		stencil_reference = value
		_hand_on_stencil()
		_queue_update()
## The colour of Outline and X-Ray.
@export var stencil_color := Color.BLACK:
	set(value):
		stencil_color = value
		_hand_on_stencil()
		_queue_update()
## How far the outline reaches.
@export_range(0.0, 1.0, 0.001, "or_greater", "suffix:m") var stencil_outline_thickness := 0.01:
	set(value):
		stencil_outline_thickness = value
		_hand_on_stencil()
		_queue_update()

# Kept, because the object is no longer whole when it is told of its end.
var _rid := get_rid()
# Whether everything will be handed on anew.
var _awaits_update := false
# Whether light is measured in physical units, as of the last update.
var _is_physical := has_physical_units()
# Materials may be made, changed and looked at on several threads.
var _mutex := Mutex.new()


## Whether the albedo texture is a distance field.
func shows_msdf() -> bool:
	return albedo_texture_msdf and not uv1_triplanar


## Whether there is diffuse light.
func is_dielectric() -> bool:
	return metallic_texture != null or orm_texture != null or metallic < 1.0


## Whether the surface sends out light by itself.
func emits() -> bool:
	if not emission_enabled or emission_energy_multiplier == 0.0:
		return false
	if not _is_dark(emission):
		return true
	return emission_texture != null and emission_operator == BaseMaterial3D.EMISSION_OP_ADD


## Whether the light of the surroundings comes from the environment and the probes.
func is_lit_by_surroundings() -> bool:
	return not (disable_ambient_light or shadow_to_opacity or is_unshaded())


## Whether no light matters.
func is_unshaded() -> bool:
	return shading_mode == BaseMaterial3D.SHADING_MODE_UNSHADED


## The light that it sends out, and the factor of its texture's.
func get_emitted() -> PackedVector3Array:
	var energy := emission_energy_multiplier
	if _is_physical:
		energy *= emission_intensity
	var multiplies := emission_operator == BaseMaterial3D.EMISSION_OP_MULTIPLY
	return Numbers.emitted(emission, energy, multiplies and emission_texture != null)


## Whether the surface needs an opacity.
func has_alpha() -> bool:
	if transparency != BaseMaterial3D.TRANSPARENCY_DISABLED or shadow_to_opacity:
		return true
	if proximity_fade_enabled or refraction_enabled:
		return true
	return distance_fade_mode == BaseMaterial3D.DISTANCE_FADE_PIXEL_ALPHA


## Whether alpha's edges are smooth.
func has_smooth_alpha() -> bool:
	return can_smooth_alpha() and alpha_antialiasing_mode != BaseMaterial3D.ALPHA_ANTIALIASING_OFF


## Whether alpha has edges.
func can_smooth_alpha() -> bool:
	return (
		transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_SCISSOR
		or transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_HASH
	)


## Whether normals are bent by a map.
func has_normal_map() -> bool:
	if detail_enabled and detail_normal != null:
		return true
	return normal_enabled and normal_texture != null


## Whether a map tells where what the surface sees is.
func has_bent_normals() -> bool:
	return bent_normal_enabled and bent_normal_texture != null


## Whether parts of the surface, or it itself, may hide light from its reflections.
func occludes_reflections() -> bool:
	return not disable_specular_occlusion and (is_occluded() or has_normal_map())


## Whether a relief moves textures.
func has_relief() -> bool:
	return heightmap_enabled and heightmap_texture != null and not uv1_triplanar


## Whether vertices are not where the mesh and its node have them.
func moves_vertices() -> bool:
	if billboard_mode != BaseMaterial3D.BILLBOARD_DISABLED:
		return true
	return fixed_size or use_point_size or grow or use_z_clip_scale or use_fov_override


## Whether what the mesh has for tangents does not count.
func makes_tangents() -> bool:
	return uv1_triplanar or uv2_triplanar


## Whether a texture tells what the normal map's levels have lost. It knows nothing of projections
## from three sides.
func has_normal_variance() -> bool:
	if not normal_enabled or normal_texture == null or uv1_triplanar:
		return false
	return normal_variance_texture != null and is_antialiased()


## Whether normals that differ within a pixel widen reflections.
func is_antialiased() -> bool:
	if specular_antialiasing == SpecularAntialiasing.AUTOMATIC:
		return has_normal_map()
	return specular_antialiasing == SpecularAntialiasing.ENABLED


## Whether a texture occludes the surface.
func is_occluded() -> bool:
	return ao_enabled and (ao_texture != null or orm_texture != null)


## Whether there is a coat.
func is_coated() -> bool:
	return clearcoat_enabled and clearcoat > 0.0


## Whether there is a sheen.
func has_sheen() -> bool:
	return sheen_enabled and sheen_color.get_luminance() > 0.0


## [member anisotropy], or 0 where it is not enabled.
func get_shown_anisotropy() -> float:
	return anisotropy if anisotropy_enabled else 0.0


## The largest number of lobes that [member quality] allows.
func get_most_lobes() -> int:
	return quality if quality != Quality.AUTOMATIC else Quality.LOBES_40


## Whether the widths vary from pixel to pixel.
func varies() -> bool:
	if orm_texture != null or roughness_texture != null:
		return true
	return varies_in_anisotropy()


## Whether the anisotropy varies from pixel to pixel.
func varies_in_anisotropy() -> bool:
	if get_shown_anisotropy() == 0.0:
		return false
	return anisotropy_flowmap != null and anisotropy_flowmap.has_alpha()


func _follow(before: Resource, after: Resource) -> void:
	if before != null:
		before.changed.disconnect(_queue_update)
	if after != null:
		after.changed.connect(_queue_update)


## Whether opacity depends on where the surface is, or something is seen through it.
func has_fades() -> bool:
	var fades := distance_fade_mode != BaseMaterial3D.DISTANCE_FADE_DISABLED
	return fades or proximity_fade_enabled or refraction_enabled


## Whether lamps show more of it than the surroundings.
func has_lamp_effects() -> bool:
	var is_lit_below := subsurf_scatter_enabled or subsurf_scatter_transmittance_enabled
	return not is_unshaded() and (rim_enabled or backlight_enabled or is_lit_below)


## Whether something draws Outline or X-Ray.
func has_stencil_pass() -> bool:
	return StencilPass.has_pass(stencil_mode)


## Whether light is measured in physical units.
static func has_physical_units() -> bool:
	return ProjectSettings.get_setting(_PHYSICAL_UNITS)


func _hand_on_stencil() -> void:
	StencilPass.hand_on(self, stencil_reference, stencil_color, stencil_outline_thickness)


# One parameter of the shader, at once. It may be none of the shader's at the moment.
func _send(name: StringName, value: Variant) -> void:
	# Under the lock, so that an update under way on another thread does not put the old number back.
	_mutex.lock()
	if not _awaits_update:
		RenderingServer.material_set_param(_rid, name, value)
	_mutex.unlock()


func _update_albedo(before: Color) -> void:
	_send(&"lobelight_albedo", Numbers.linear(albedo_color))
	if before.a != albedo_color.a:
		_send(&"lobelight_alpha", albedo_color.a)


func _update_metallic(before: float) -> void:
	# At both ends something is left out of the shader.
	if before == 0.0 or before == 1.0 or metallic == 0.0 or metallic == 1.0:
		_queue_update()
	else:
		_send(&"lobelight_metallic", metallic)


func _update_emission_energy(is_other_shader: bool) -> void:
	if is_other_shader:
		_queue_update()
	elif emission_enabled:
		_send_emission()
		_send(&"lobelight_emission_factor", get_emitted()[1])


# The texture's factor is the light itself where the two are multiplied.
func _send_emission() -> void:
	var light := emission.srgb_to_linear() * emission_energy_multiplier
	if _is_physical:
		light *= emission_intensity
	var multiplies := emission_operator == BaseMaterial3D.EMISSION_OP_MULTIPLY
	if multiplies and emission_texture != null:
		_send(&"lobelight_emission_factor", Vector3(light.r, light.g, light.b))
	else:
		_send(&"lobelight_emitted", Vector3(light.r, light.g, light.b))


func _update_coat_amount(is_other_shader: bool) -> void:
	if is_other_shader:
		_queue_update()
	else:
		_send(&"lobelight_coat_amount", Vector2(clearcoat, clearcoat_roughness))


func _update_sheen_tint(is_other_shader: bool) -> void:
	if is_other_shader:
		_queue_update()
	else:
		_send(&"lobelight_sheen_tint", Numbers.linear(sheen_color))


func _update_rotation(is_other_shader: bool) -> void:
	# The axes of a negative anisotropy are exchanged where it is turned.
	if is_other_shader or get_shown_anisotropy() < 0.0:
		_queue_look()
	else:
		_send(&"lobelight_anisotropy_turn", Vector2.from_angle(anisotropy_rotation))


func _update_uv1(may_be_other_shader: bool) -> void:
	if may_be_other_shader:
		_queue_update()
		return
	_send(&"lobelight_uv_transform", Numbers.transform(uv1_scale, uv1_offset))
	if uv1_triplanar:
		_send(&"lobelight_uv1_scale", uv1_scale)
		_send(&"lobelight_uv1_offset", uv1_offset)


func _update_uv2(may_be_other_shader: bool) -> void:
	if may_be_other_shader:
		_queue_update()
		return
	_send(&"lobelight_uv2_transform", Numbers.transform(uv2_scale, uv2_offset))
	if uv2_triplanar:
		_send(&"lobelight_uv2_scale", uv2_scale)
		_send(&"lobelight_uv2_offset", uv2_offset)


func _update_transmittance() -> void:
	var depth := subsurf_scatter_transmittance_depth
	_send(&"lobelight_transmittance", Vector2(depth, subsurf_scatter_transmittance_boost))


func _update_fade_limits() -> void:
	_send(&"lobelight_fade_limits", Vector2(distance_fade_min_distance, distance_fade_max_distance))


static func _is_dark(colour: Color) -> bool:
	return colour.r == 0.0 and colour.g == 0.0 and colour.b == 0.0


# Something that the shader or its parameters depend on has changed.
@abstract func _queue_update() -> void

# The lobes are to be looked for anew, and are perhaps a case for another shader.
@abstract func _queue_look() -> void

# Roughness or anisotropy has changed: they are often animated.
@abstract func _update_widths() -> void
