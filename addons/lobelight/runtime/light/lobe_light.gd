@tool
class_name LobeLight
extends Resource
## Light as [LobeMaterial3D]s take it: a cube map whose levels are blurred, where it belongs, and
## how strong it is. [LobeEnvironment3D] and [LobeProbe3D] make it.
##
## The light of a probe has a box, within which it is seen from where the pixel is. A light that is
## saved keeps its faces and what they were filtered with; where it belongs says the node that shows
## it, so that a scene with its light can be placed anywhere.

## What faces can be saved in. Devices that cannot sample a format of blocks get half floats of it.
const FORMATS: Array[Image.Format] = [
	Image.FORMAT_RGBAH,
	Image.FORMAT_RGBE9995,
	Image.FORMAT_BPTC_RGBFU,
	Image.FORMAT_ASTC_4x4_HDR,
]
## Narrowest widths of lobes that never need what is finer than [member coarse].
const COARSE_WIDTH := 0.044
## Texels of [member sources].
const SOURCES_SIZE := Vector2i(4, 3)
const OnDemand := preload("../on_demand.gd")
const _BINDING := "res://addons/lobelight/runtime/own_shaders/shader_binding.gd"
# A unit vector's largest component is at least this.
const _LEAST_COMPONENT := 0.57735027
const _FACES := 6
# Of the saved format. The first had no checksum and half floats only, the second no sources; lights
# without any still have that one.
const _VERSION := 3
const _VERSION_WITHOUT_SOURCES := 2
# Of what is saved as single floats.
const _ROUNDING := 1e-3

## The format of what is saved.
@export_storage var version := _VERSION_WITHOUT_SOURCES
## The faces +X −X +Y −Y +Z −Z with all their levels, linear radiance in one of [constant FORMATS]:
## what is saved. Empty while the light is on the GPU only.
@export_storage var faces: Array[Image] = []:
	set(value):
		faces = value
		cubemap = null
		_is_checked = false
		emit_changed()
## Texels along the side of a face.
@export_storage var size := 1
## How much the levels blur: c in shaders/environment.gdshaderinc; at first that of 2 × 2 means.
@export_storage var level_variance := 1.0 / 12.0
## How much level 0 is blurred: b in shaders/environment.gdshaderinc.
@export_storage var base_variance := 0.0
## Whether they blur alike in all directions, rather than as the texels of the cube are stretched;
## if not, materials need LOBELIGHT_STRETCHED_LEVELS.
@export_storage var is_even := false
## From the faces to the axes of the node that shows the light; see [member is_of_world].
@export_storage var axes := Basis.IDENTITY:
	set(value):
		axes = value
		rotation = value
## Whether [member axes] leads to the world's axes instead, as of a sky, which no node turns.
@export_storage var is_of_world := false
## A factor for the radiance of the faces: how bright the engine showed a sky when it was baked.
@export_storage var base_energy := 1.0:
	set(value):
		base_energy = value
		energy = value
## Of faces in blocks: their coarser levels once more, with shared exponents, for materials whose
## lobes are all wide. Blocks show the contrasts in these levels badly, and the levels take little.
@export_storage var coarse: LobeLight
## The texels of [member sources], red, green, blue and alpha, row by row: what is saved. Empty if
## there are no sources, or while they are on the GPU only.
@export_storage var source_texels: PackedFloat32Array = []:
	set(value):
		source_texels = value
		sources = null
		_is_checked = false
		emit_changed()
## What [method find_checksum] found when the light was saved; empty if nothing is to be checked.
@export_storage var checksum := ""

## The cube map with all its levels. Of faces it is made when it is first asked for;
## [code]null[/code] while the light has no texture of its own.
var cubemap: TextureLayered:
	get:
		if cubemap == null and not faces.is_empty():
			var made := Cubemap.new()
			if made.create_from_images(faces) == OK:
				cubemap = made
		return cubemap
## Compact bright lights that were taken out of the faces, up to four; [code]null[/code] if there
## are none. A column is one of them, the rows are
## [codeblock lang=text]
## 0    direction in the light's axes, of unit length; deviation in radians, the root of the
##      variance per axis
## 1    energy: the integral of the radiance over the solid angle, linear; 0 for no light
## 2    what the direction of row 0 lacks for being exact, times 1024
## [/codeblock]
var sources: Texture2D:
	get:
		if sources == null and source_texels.size() == 4 * SOURCES_SIZE.x * SOURCES_SIZE.y:
			sources = ImageTexture.create_from_image(
				Image.create_from_data(
					SOURCES_SIZE.x,
					SOURCES_SIZE.y,
					false,
					Image.FORMAT_RGBAF,
					source_texels.to_byte_array()
				)
			)
		return sources
## From the light to the world; orthonormal.
var rotation := Basis.IDENTITY
## A factor for the radiance.
var energy := 1.0

## The extents of the box in metres, along the light's axes; zero for a light from everywhere.
var box_size := Vector3.ZERO
## The middle of the box in the world, in metres.
var box_middle := Vector3.ZERO
## Where the light is seen from, from the middle of the box, along the light's axes, in metres.
var box_origin := Vector3.ZERO
## How far from the box its light ends, in metres.
var blend_distance := 0.0
## Where boxes overlap, those of a higher priority come first.
var priority := 0

# Whether the faces are known to have the checksum.
var _is_checked := false


## No light, at levels that blur alike in all directions or not.
static func make_dark(even: bool) -> LobeLight:
	var light := make_constant(Color.BLACK, even)
	light.energy = 0.0
	return light


## The same light from all sides, linear, of one texel a face.
static func make_constant(colour: Color, even: bool) -> LobeLight:
	var light := LobeLight.new()
	var made: Array[Image] = []
	for face in _FACES:
		var image := Image.create_empty(1, 1, false, Image.FORMAT_RGBAH)
		image.set_pixel(0, 0, colour)
		made.append(image)
	light.faces = made
	light.is_even = even
	return light


## Gives a material of your own the light of where it is, and the lobes that its shader draws: from
## now on it shows what a [LobeMaterial3D] does, whatever [LobeEnvironment3D] and [LobeProbe3D]s
## there are, until [method unbind] or until it is freed. Its shader is to include
## [code]res://addons/lobelight/lobelight.gdshaderinc[/code], which describes the functions, or to
## be a [VisualShader] with a node [i]Lobelight[/i].
## [br][br]
## The lobes are those of GGX, or of [param tables], a [LobeTableSet]. With [param shown] the
## material shows that light wherever it is, as with [member LobeMaterial3D.light]. Who is bound
## already takes both anew. The material keeps its shader and its parameters; nothing of the light
## is saved with it, and copies of it are not bound. [LobeShaderMaterial] binds itself, in the
## editor too.
## [br][br]
## Exports have this where a file of the project includes that file, or names this method or that
## class; elsewhere nothing happens but an error.
static func bind(
	material: ShaderMaterial, tables: Resource = null, shown: LobeLight = null
) -> void:
	var binding := OnDemand.fetch(_BINDING, OnDemand.OWN_SHADERS) as GDScript
	if binding != null:
		binding.call(&"bind", material, tables, shown)


## The material keeps its shader, and sees black from now on. Nothing happens if it is not bound.
static func unbind(material: ShaderMaterial) -> void:
	var binding := OnDemand.fetch(_BINDING, OnDemand.OWN_SHADERS) as GDScript
	if binding != null:
		binding.call(&"unbind", material)


## Why the light cannot be shown, in a sentence; empty if it can.
func get_problem() -> String:
	if version > _VERSION:
		return (
			(
				"The light is in format %d, and this version of Lobelight reads up to %d: "
				+ "update the addon, or bake the light again."
			)
			% [version, _VERSION]
		)
	if version < 1:
		return "The light is in format %d, which there is none of: bake it again." % version
	if faces.is_empty() and cubemap != null:
		return ""
	if faces.size() != _FACES:
		return "The light has %d faces, not 6: bake it again." % faces.size()
	var problem := _find_odd_number()
	if problem.is_empty():
		problem = _find_damage()
	return coarse.get_problem() if problem.is_empty() and coarse != null else problem


## Makes the light ready to be saved: with the checksum of what it has now.
func seal() -> void:
	version = _VERSION_WITHOUT_SOURCES if source_texels.is_empty() else _VERSION
	if coarse != null:
		coarse.seal()
	checksum = find_checksum()
	_is_checked = true


## The checksum of all that is saved.
func find_checksum() -> String:
	var hashing := HashingContext.new()
	hashing.start(HashingContext.HASH_MD5)
	hashing.update(
		var_to_bytes([size, level_variance, base_variance, is_even, axes, is_of_world, base_energy])
	)
	# Lights without sources have the checksum that they had before there were any.
	if not source_texels.is_empty():
		hashing.update(source_texels.to_byte_array())
	for face in faces:
		hashing.update(face.get_data())
	return hashing.finish().hex_encode()


func _find_odd_number() -> String:
	if size < 1 or size != nearest_po2(size):
		return "The light's faces are %d texels wide, no power of two: bake it again." % size
	if not is_finite(level_variance) or level_variance <= 0.0 or not is_finite(base_variance):
		return "The light does not say what its levels were blurred with: bake it again."
	var is_rotation := axes.is_conformal() and absf(axes.determinant() - 1.0) < _ROUNDING
	if not is_rotation or not is_finite(base_energy) or base_energy < 0.0:
		return "The light does not say how it lies or how bright it is: bake it again."
	if not _has_sound_sources():
		return "The light's sources are not what sources are: bake it again."
	return ""


# Energies are not negative, and what has one has a direction.
func _has_sound_sources() -> bool:
	if source_texels.is_empty():
		return true
	var row := 4 * SOURCES_SIZE.x
	if source_texels.size() != row * SOURCES_SIZE.y:
		return false
	for number in source_texels:
		if not is_finite(number):
			return false
	for at in range(0, row, 4):
		var energy := Vector3(
			source_texels[row + at], source_texels[row + at + 1], source_texels[row + at + 2]
		)
		var direction := Vector3(source_texels[at], source_texels[at + 1], source_texels[at + 2])
		if energy[energy.min_axis_index()] < 0.0 or source_texels[at + 3] < 0.0:
			return false
		if energy != Vector3.ZERO and absf(direction.length_squared() - 1.0) > _ROUNDING:
			return false
	return true


func _find_damage() -> String:
	if not faces.all(_is_face):
		return (
			(
				"A face of the light is no image of %d texels with all levels in a format of lights: "
				+ "bake it again."
			)
			% size
		)
	if not _is_checked and checksum and checksum != find_checksum():
		return "The light is not as it was saved, its checksum differs: bake it again."
	_is_checked = true
	return ""


func _is_face(face: Image) -> bool:
	return (
		face != null
		and face.get_format() in FORMATS
		and face.get_format() == faces[0].get_format()
		and face.get_size() == size * Vector2i.ONE
		and (size == 1 or face.has_mipmaps())
	)


## The #defines that shaders need for the light, without LOBELIGHT_.
func get_defines() -> PackedStringArray:
	var defines: PackedStringArray = []
	if not is_even:
		defines.append("STRETCHED_LEVELS")
	if sources != null:
		defines.append("SOURCES")
	return defines


## How many of the [member source_texels] shine.
func count_sources() -> int:
	var count := 0
	var row := 4 * SOURCES_SIZE.x
	for at in range(row, mini(2 * row, source_texels.size()), 4):
		count += 1 if source_texels[at] + source_texels[at + 1] + source_texels[at + 2] > 0.0 else 0
	return count


## Whether the light is that of a box.
func has_box() -> bool:
	return box_size != Vector3.ZERO


## The same light, to be placed somewhere else than this one; the two share what they show.
func at_another_place() -> LobeLight:
	var other := LobeLight.new()
	other.faces = faces
	other.size = size
	other.level_variance = level_variance
	other.base_variance = base_variance
	other.is_even = is_even
	other.axes = axes
	other.is_of_world = is_of_world
	other.base_energy = base_energy
	other.coarse = coarse
	other.cubemap = cubemap
	other.source_texels = source_texels
	other.sources = sources
	return other


## Turns the light with a node of these axes, and multiplies it.
func place(node_axes: Basis, factor: float) -> void:
	rotation = axes if is_of_world else node_axes.orthonormalized() * axes
	energy = base_energy * factor


## Whether materials get other faces where their lobes are wide.
func goes_by_width() -> bool:
	return coarse != null


## Hands the light to a material of the rendering server whose lobes are that of a BRDF of [param
## width], the narrower one, or more; 0 if that is not known.
func apply(material: RID, width := 0.0) -> void:
	var server := RenderingServer
	var shown := coarse if coarse != null and width >= COARSE_WIDTH else self
	server.material_set_param(material, &"lobelight_environment", shown.cubemap.get_rid())
	server.material_set_param(material, &"lobelight_environment_sharpest", shown.get_sharpest())
	server.material_set_param(material, &"lobelight_environment_level", shown.get_level())
	apply_sources(material, &"lobelight_sources")
	apply_placement(material)


## The same for the sources, as one of the shader's parameters.
func apply_sources(material: RID, name: StringName) -> void:
	if sources != null:
		RenderingServer.material_set_param(material, name, sources.get_rid())


## The same for what may change from one frame to the next.
func apply_placement(material: RID) -> void:
	var server := RenderingServer
	var to_environment := rotation.transposed()
	server.material_set_param(material, &"lobelight_environment_rotation", to_environment)
	server.material_set_param(material, &"lobelight_environment_energy", energy)


## Of the formula in shaders/environment.gdshaderinc, s; of stretched levels a line through its
## ends.
func get_sharpest() -> Vector2:
	var texel := 4.0 / (size * size)
	var slope := 0.0
	if not is_even:
		slope = level_variance * (1.0 - pow(_LEAST_COMPONENT, 3.0)) / (1.0 - _LEAST_COMPONENT)
	return texel * Vector2(level_variance - base_variance - slope, slope)


## Of the same, k; of stretched levels a parabola through its ends and its middle.
func get_level() -> Vector3:
	if is_even:
		return Vector3(_get_level_at(1.0), 0.0, 0.0)
	var middle := 0.5 * (_LEAST_COMPONENT + 1.0)
	var first := _get_level_at(_LEAST_COMPONENT)
	var last := _get_level_at(1.0)
	var slope := (last - first) / (1.0 - _LEAST_COMPONENT)
	# Newton's divided differences.
	var bend := slope - (_get_level_at(middle) - first) / (middle - _LEAST_COMPONENT)
	bend /= 1.0 - middle
	var linear := slope - bend * (_LEAST_COMPONENT + 1.0)
	return Vector3(last - linear - bend, linear, bend)


func _get_level_at(component: float) -> float:
	var texel := 4.0 / (size * size) * pow(component, 3.0)
	return -0.5 * log(texel * (level_variance + 1.0 / 6.0)) / log(2.0)
