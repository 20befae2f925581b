@tool
extends RefCounted
## Roughness, anisotropy and maps of both that have the widths of glTF's KHR_materials_anisotropy:
## [codeblock lang=text]
## alpha_t = mix(alpha, 1, strength²)   alpha_b = alpha   alpha = roughness²
## [/codeblock]
## along a direction in the tangent plane and across it. Ours are r² / aspect and r² · aspect with
## aspect² = 1 − 0.9 a, so that r⁴ = alpha_t alpha_b and a = (1 − alpha_b / alpha_t) / 0.9.

const Widths := preload("../table/widths.gd")

## The most that the widths may be apart in a [LobeMaterial3D] and in Godot's own materials.
const RATIO := 100.0
const GODOTS_RATIO := 10.0
# The most texels on a side of a map.
const _MAX_SIDE := 1024
# An angle's map: a side of it, and a byte's half, which no byte is.
const _PLAIN_SIDE := 4
const _HALF := 127.5

## The file's numbers, and its textures as four bytes a texel or null.
var strength := 0.0
var rotation := 0.0
var roughness := 1.0
var direction: Image
var rough: Image

## Whether the narrower width had to be made wider somewhere.
var is_clamped := false

var _shown := Vector2.ZERO
var _flow: ImageTexture
var _roughness_map: ImageTexture
var _ratio := RATIO


## Works out all for widths that are at most [param ratio] apart.
func make(ratio: float) -> void:
	_ratio = ratio
	is_clamped = false
	_flow = null
	_roughness_map = null
	if direction == null and rough == null:
		_shown = _solve(roughness, strength)
	else:
		_make_maps()


## Gives the material of Godot's what was worked out.
func apply(material: BaseMaterial3D) -> void:
	material.anisotropy_enabled = true
	material.roughness = _shown.x
	material.anisotropy = minf(_shown.y, 1.0)
	if _flow != null:
		material.anisotropy_flowmap = _flow
	elif rotation != 0.0:
		material.anisotropy_flowmap = _make_plain_flow()
	if rough != null or _roughness_map != null:
		material.roughness_texture = _roughness_map
		material.roughness_texture_channel = BaseMaterial3D.TEXTURE_CHANNEL_RED


## The same for a [LobeMaterial3D].
func get_properties() -> Dictionary[StringName, Variant]:
	var properties: Dictionary[StringName, Variant] = {
		&"roughness": _shown.x,
		&"anisotropy": _shown.y,
		&"anisotropy_flowmap": _flow,
	}
	if _flow == null:
		properties[&"anisotropy_rotation"] = wrapf(rotation, -PI, PI)
	if rough != null or _roughness_map != null:
		properties[&"roughness_texture"] = _roughness_map
		properties[&"roughness_texture_channel"] = BaseMaterial3D.TEXTURE_CHANNEL_RED
	return properties


# Roughness and anisotropy.
func _solve(of_roughness: float, of_strength: float) -> Vector2:
	var narrow := of_roughness * of_roughness
	var wide := lerpf(narrow, 1.0, of_strength * of_strength)
	if narrow * _ratio < 0.999 * wide:
		is_clamped = true
	narrow = maxf(narrow, wide / _ratio)
	return Widths.to_roughness(Vector2(maxf(wide, 1e-8), maxf(narrow, 1e-8)))


func _make_maps() -> void:
	var size := _get_size()
	var directions := _resized(direction, size)
	var roughs := _resized(rough, size)
	var count := size.x * size.y
	# Of the pairs of bytes that occur.
	var solved: Dictionary[int, Vector2] = {}
	var keys := PackedInt32Array()
	keys.resize(count)
	for texel in count:
		var blue := directions[4 * texel + 2] if direction != null else 255
		var green := roughs[4 * texel + 1] if rough != null else 255
		var key := 256 * green + blue
		keys[texel] = key
		if not solved.has(key):
			solved[key] = _solve(roughness * green / 255.0, strength * blue / 255.0)
	var least := Vector2(INF, INF)
	_shown = Vector2.ZERO
	for pair: Vector2 in solved.values():
		_shown = _shown.max(pair)
		least = least.min(pair)
	_make_flow(size, directions, keys, solved, least.y)
	if least.x < _shown.x:
		_make_roughness_map(size, keys, solved)


# The flow map: the direction, turned, in red and green, and the share of the anisotropy in alpha.
func _make_flow(
	size: Vector2i,
	directions: PackedByteArray,
	keys: PackedInt32Array,
	solved: Dictionary[int, Vector2],
	least: float
) -> void:
	var turn := Vector2.from_angle(rotation)
	var bytes := PackedByteArray()
	bytes.resize(4 * keys.size())
	bytes.fill(255)
	for texel in keys.size():
		var flow := turn
		if direction != null:
			var x := directions[4 * texel] - _HALF
			var y := directions[4 * texel + 1] - _HALF
			var along := 1.0 / sqrt(x * x + y * y)
			flow = Vector2(x * turn.x - y * turn.y, x * turn.y + y * turn.x) * along
		bytes[4 * texel] = roundi(_HALF + _HALF * flow.x)
		bytes[4 * texel + 1] = roundi(_HALF + _HALF * flow.y)
		bytes[4 * texel + 2] = 0
		if _shown.y > 0.0:
			bytes[4 * texel + 3] = roundi(255.0 * solved[keys[texel]].y / _shown.y)
	var image := Image.create_from_data(size.x, size.y, false, Image.FORMAT_RGBA8, bytes)
	if least >= _shown.y:
		# Without alpha, materials cost less.
		image.convert(Image.FORMAT_RGB8)
	image.generate_mipmaps()
	_flow = ImageTexture.create_from_image(image)


func _make_roughness_map(
	size: Vector2i, keys: PackedInt32Array, solved: Dictionary[int, Vector2]
) -> void:
	var bytes := PackedByteArray()
	bytes.resize(keys.size())
	for texel in keys.size():
		bytes[texel] = roundi(255.0 * solved[keys[texel]].x / _shown.x)
	var image := Image.create_from_data(size.x, size.y, false, Image.FORMAT_L8, bytes)
	image.generate_mipmaps()
	_roughness_map = ImageTexture.create_from_image(image)


func _get_size() -> Vector2i:
	var size := Vector2i.ONE
	for image: Image in [direction, rough]:
		if image != null:
			size = size.max(image.get_size())
	return size.min(Vector2i.ONE * _MAX_SIDE)


static func _resized(image: Image, size: Vector2i) -> PackedByteArray:
	if image == null:
		return PackedByteArray()
	if image.get_size() != size:
		image.resize(size.x, size.y)
	return image.get_data()


# Godot has no angle: a map of a single direction stands for it.
func _make_plain_flow() -> ImageTexture:
	var flow := 0.5 * Vector2.from_angle(rotation) + Vector2(0.5, 0.5)
	var image := Image.create_empty(_PLAIN_SIDE, _PLAIN_SIDE, false, Image.FORMAT_RGBAH)
	image.fill(Color(flow.x, flow.y, 0.0, 1.0))
	return ImageTexture.create_from_image(image)
