@tool
extends RefCounted
## What the extensions of one material of a glTF file say, for a material of Godot's and for the
## [LobeMaterial3D] that may be made of it.

const AnisotropyMaps := preload("anisotropy_maps.gd")

const _PREFIX := "KHR_materials_"
# Of the whole BRDF: 16 % of the square of metallic_specular.
const _MOST_F0 := 0.16
# The width of a coat in Godot at a roughness of 0 and of 1.
const _COAT_WIDTHS := Vector2(0.001, 0.1)

## Properties that a [LobeMaterial3D] made of the material has besides.
var more: Dictionary[StringName, Variant] = {}
## What cannot be had, in sentences.
var problems: PackedStringArray = []

var _state: GLTFState
var _material: Dictionary
var _extensions: Dictionary


func _init(state: GLTFState, material: Dictionary) -> void:
	_state = state
	_material = material
	_extensions = _get_dictionary(material, "extensions", "")


## Gives the material what it can hold.
func apply(material: BaseMaterial3D) -> void:
	_apply_transform(material)
	_apply_specular(material)
	_apply_coat(material)
	_apply_anisotropy(material)
	_apply_sheen()


# Godot has one transform for all textures and takes that of the base colour alone.
func _apply_transform(material: BaseMaterial3D) -> void:
	var transforms: Array[Dictionary] = []
	_collect_transforms(_material, transforms)
	if transforms.all(func(found: Dictionary) -> bool: return found.is_empty()):
		return
	var first := transforms[0]
	if transforms.any(func(found: Dictionary) -> bool: return found != first):
		(
			problems
			. append(
				(
					"its textures have different transforms (KHR_texture_transform); that of the base colour"
					+ " is taken for all."
				)
			)
		)
		return
	if first.get("rotation", 0.0) != 0.0:
		problems.append("the rotation of its textures (KHR_texture_transform) is left out.")
	var scale := _get_numbers(first, "scale", 2, [1.0, 1.0])
	var offset := _get_numbers(first, "offset", 2, [0.0, 0.0])
	material.uv1_scale = Vector3(scale[0], scale[1], 1.0)
	material.uv1_offset = Vector3(offset[0], offset[1], 0.0)


# One for each texture in what is described, an empty one where there is none.
static func _collect_transforms(described: Variant, found: Array[Dictionary]) -> void:
	if described is not Dictionary:
		return
	var entries: Dictionary = described
	for key: Variant in entries:
		if entries[key] is Dictionary and String(key).ends_with("Texture"):
			var texture: Dictionary = entries[key]
			var extensions: Variant = texture.get("extensions", {})
			var transform: Variant = {}
			if extensions is Dictionary:
				transform = (extensions as Dictionary).get("KHR_texture_transform", {})
			found.append(transform if transform is Dictionary else {})
		else:
			_collect_transforms(entries[key], found)


# f0 = ((ior - 1) / (ior + 1))², times the specular strength; Godot's is 0.16 metallic_specular².
func _apply_specular(material: BaseMaterial3D) -> void:
	if not (_has("ior") or _has("specular")):
		return
	var ior := _get_number(_get_extension("ior"), "ior", 1.5, 0.0, INF)
	var specular := _get_extension("specular")
	var strength := _get_number(specular, "specularFactor", 1.0, 0.0, 1.0)
	var tint := _get_numbers(specular, "specularColorFactor", 3, [1.0, 1.0, 1.0])
	strength *= Color(tint[0], tint[1], tint[2]).get_luminance()
	for key: String in ["specularTexture", "specularColorTexture"]:
		if specular.has(key):
			problems.append("its %s is left out." % key)
	var f0 := strength * pow((ior - 1.0) / (ior + 1.0), 2.0)
	if f0 > _MOST_F0:
		problems.append(
			"it reflects %.0f %% at normal incidence, but 16 %% is the most." % (100.0 * f0)
		)
	material.metallic_specular = sqrt(minf(f0 / _MOST_F0, 1.0))


func _apply_coat(material: BaseMaterial3D) -> void:
	var coat := _get_extension("clearcoat")
	var strength := _get_number(coat, "clearcoatFactor", 0.0, 0.0, 1.0)
	if strength == 0.0:
		return
	material.clearcoat_enabled = true
	material.clearcoat = strength
	var roughness := _get_number(coat, "clearcoatRoughnessFactor", 0.0, 0.0, 1.0)
	var rough_texture := _get_image(coat, "clearcoatRoughnessTexture")
	var strength_texture := _get_image(coat, "clearcoatTexture")
	material.clearcoat_roughness = _to_coat_roughness(roughness)
	if strength_texture != null or rough_texture != null:
		material.clearcoat_texture = _pack_coat(strength_texture, rough_texture, roughness)
	if coat.has("clearcoatNormalTexture"):
		problems.append("the normal texture of its clear coat is left out: the coat is smooth.")


# The width of a coat is roughness² in glTF; Godot mixes it between two widths.
static func _to_coat_roughness(roughness: float) -> float:
	var width := roughness * roughness
	return clampf(inverse_lerp(_COAT_WIDTHS.x, _COAT_WIDTHS.y, width), 0.0, 1.0)


# Red is the factor of the strength, green that of Godot's roughness.
static func _pack_coat(strength: Image, rough: Image, roughness: float) -> Texture2D:
	var size := Vector2i.ZERO
	for image: Image in [strength, rough]:
		if image != null:
			size = size.max(image.get_size())
	var packed := Image.create_empty(size.x, size.y, false, Image.FORMAT_RGB8)
	var strengths := _channel(strength, size, 0)
	var roughnesses := _channel(rough, size, 1)
	var greens := PackedByteArray()
	greens.resize(256)
	var most := maxf(_to_coat_roughness(roughness), 1e-4)
	for value in 256:
		greens[value] = roundi(255.0 * _to_coat_roughness(roughness * value / 255.0) / most)
	var bytes := packed.get_data()
	@warning_ignore("integer_division")
	for texel in bytes.size() / 3:
		bytes[3 * texel] = strengths[texel]
		bytes[3 * texel + 1] = greens[roughnesses[texel]]
	packed.set_data(size.x, size.y, false, Image.FORMAT_RGB8, bytes)
	packed.generate_mipmaps()
	return ImageTexture.create_from_image(packed)


# White where there is no image.
static func _channel(image: Image, size: Vector2i, channel: int) -> PackedByteArray:
	var values := PackedByteArray()
	values.resize(size.x * size.y)
	if image == null:
		values.fill(255)
		return values
	if image.get_size() != size:
		image.resize(size.x, size.y)
	var bytes := image.get_data()
	for texel in values.size():
		values[texel] = bytes[4 * texel + channel]
	return values


func _apply_anisotropy(material: BaseMaterial3D) -> void:
	var anisotropy := _get_extension("anisotropy")
	var strength := _get_number(anisotropy, "anisotropyStrength", 0.0, 0.0, 1.0)
	if strength == 0.0:
		return
	var maps := AnisotropyMaps.new()
	maps.strength = strength
	maps.rotation = _get_number(anisotropy, "anisotropyRotation", 0.0, -INF, INF)
	maps.roughness = material.roughness
	maps.direction = _get_image(anisotropy, "anisotropyTexture")
	if material.roughness_texture != null:
		maps.rough = _readable(material.roughness_texture.get_image())
	maps.make(AnisotropyMaps.GODOTS_RATIO)
	maps.apply(material)
	maps.make(AnisotropyMaps.RATIO)
	more.merge(maps.get_properties())
	if maps.is_clamped:
		problems.append("its widths are more than 100:1 apart; the narrower one is made wider.")


func _apply_sheen() -> void:
	var sheen := _get_extension("sheen")
	var colour := _get_numbers(sheen, "sheenColorFactor", 3, [0.0, 0.0, 0.0])
	if colour.max() <= 0.0:
		return
	more[&"sheen_enabled"] = true
	more[&"sheen_color"] = Color(colour[0], colour[1], colour[2]).clamp().linear_to_srgb()
	more[&"sheen_roughness"] = _get_number(sheen, "sheenRoughnessFactor", 0.0, 0.0, 1.0)
	more[&"sheen_texture"] = _get_texture(sheen, "sheenColorTexture")
	if sheen.has("sheenRoughnessTexture"):
		problems.append("the roughness texture of its sheen is left out.")


func _has(name: String) -> bool:
	return _extensions.has(_PREFIX + name)


func _get_extension(name: String) -> Dictionary:
	return _get_dictionary(_extensions, _PREFIX + name, "")


func _get_dictionary(from: Dictionary, key: String, of: String) -> Dictionary:
	var value: Variant = from.get(key, {})
	if value is Dictionary:
		return value
	problems.append("%s%s is %s, not an object; it is left out." % [of, key, _show(value)])
	return {}


func _get_number(from: Dictionary, key: String, usual: float, low: float, high: float) -> float:
	var value: Variant = from.get(key, usual)
	# As drafts of the extensions had it, and files still have.
	if value is Array and (value as Array).size() == 1:
		value = (value as Array)[0]
	if (value is float or value is int) and is_finite(value as float):
		var number: float = value
		if number < low or number > high:
			problems.append("%s is %s, not from %s to %s." % [key, number, low, high])
		return clampf(number, low, high)
	problems.append("%s is %s, not a number; %s is taken." % [key, _show(value), usual])
	return usual


func _get_numbers(from: Dictionary, key: String, count: int, usual: Array) -> Array:
	var value: Variant = from.get(key, usual)
	if value is Array and (value as Array).size() == count:
		var numbers: Array = value
		if numbers.all(func(number: Variant) -> bool: return number is float or number is int):
			return numbers
	problems.append("%s is %s, not %d numbers." % [key, _show(value), count])
	return usual


# Null, and a sentence where the file asks for one that is not there.
func _get_texture(from: Dictionary, key: String) -> Texture2D:
	if not from.has(key):
		return null
	var info := _get_dictionary(from, key, "")
	if info.is_empty():
		return null
	if info.get("texCoord", 0) != 0:
		problems.append("its %s lies on other texture coordinates than the first." % key)
	var index := int(_get_number(info, "index", -1.0, -INF, INF))
	var textures := _state.textures
	var image := textures[index].src_image if index >= 0 and index < textures.size() else -1
	var images := _state.images
	if image < 0 or image >= images.size() or images[image] == null:
		problems.append("its %s, number %d, is not in the file." % [key, index])
		return null
	return images[image]


func _get_image(from: Dictionary, key: String) -> Image:
	var texture := _get_texture(from, key)
	return _readable(texture.get_image()) if texture != null else null


# Four bytes a texel, without mip levels, a copy.
static func _readable(image: Image) -> Image:
	if image == null or image.is_empty():
		return null
	var copy: Image = image.duplicate()
	if copy.is_compressed() and copy.decompress() != OK:
		return null
	copy.clear_mipmaps()
	copy.convert(Image.FORMAT_RGBA8)
	return copy


static func _show(value: Variant) -> String:
	return JSON.stringify(value).left(40)
