@tool
extends RefCounted
## The lights of all worlds as a texture of numbers, read by placed_light.gdshaderinc.
##
## Row 0 has, for each world, its first row and the one behind its last; worlds as the captures of
## probes see them are numbered from [constant CAPTURED] on. A light is eight texels on a
## diagonal, number k in column k of its row + k: reads that share a coordinate wait for one another
## on some phones.
## [codeblock lang=text]
## 0 … 2   rows of the rotation from the world to the light; w: what is added, so that the middle of
##         the box is at 0
## 3       half the box's size; w: 1 / blend distance
## 4       from where the light is seen to the middle of the box, along the light's axes; w: layer
## 5       bias of the weight, energy, s and k of lobelight_level
## 6       of stretched levels: the rest of s and of k; w: where its sources are, 0 if it has none
## 7       the middle of the box in the world; w: the square of how far the light reaches from it,
##         negative where lights of a lower priority begin
## [/codeblock]
## The last row of a world is its environment's.

const WorldCameras := preload("world_cameras.gd")

## The layer of what all materials have as their environment.
const ENVIRONMENT := -1
## Texels of a row, and how many worlds can be told.
const WIDTH := 16
## What is added to a world's number for what captures of probes see.
const CAPTURED := 8
const _TEXELS := 8
# Half the size of the box of lights without one, in metres.
const _EVERYWHERE := 1e9
# A margin for rounding in squares of distances.
const _MARGIN := 1.0001
# The steepest edge of a box: how much a weight may fall in a metre.
const _SHARPEST_EDGE := 1e6

var texture := ImageTexture.new()

var _numbers := PackedFloat32Array()
var _rows := 0
# Of the lights that are being added.
var _first := 0
var _worlds := 0
var _bytes := PackedByteArray()


func _init() -> void:
	begin()
	end()


func begin() -> void:
	_numbers.resize(4 * WIDTH)
	_numbers.fill(0.0)
	_rows = 1
	_worlds = 0


## The lights that follow are those of another world. What is in none of them shows the first one's.
func begin_world() -> void:
	_begin(range(WIDTH) if _worlds == 0 else [_worlds, _worlds + CAPTURED])
	_worlds += 1


## The lights that follow are what captures of probes see of the last world, if that is something
## else.
func begin_captured() -> void:
	_begin([_worlds - 1 + CAPTURED])


## The lights that follow are those of worlds that have none.
func begin_unlit() -> void:
	_begin([WorldCameras.UNLIT])
	# The editor draws thumbnails with cameras whose masks are not set.
	if Engine.is_editor_hint():
		_begin([WIDTH - 1])


func _begin(columns: Array) -> void:
	_first = _rows
	for column: int in columns:
		_numbers[4 * column] = _rows
		_numbers[4 * column + 1] = _rows


## [param shift] is added to the light's levels; [param bias] is its weight inside its box; [param
## sources] is 1 for those in [code]lobelight_sources[/code], 2 for the first of the others.
func add(
	light: LobeLight,
	layer: int,
	shift: float,
	bias: float,
	starts_priority: bool,
	energy := light.energy,
	sources := 0
) -> void:
	var half := _EVERYWHERE * Vector3.ONE
	var slope := 0.0
	var to_middle := Vector3.ZERO
	var middle := Vector3.ZERO
	var reach := _EVERYWHERE * _EVERYWHERE
	var moved := Vector3.ZERO
	var to_light := light.rotation.transposed()
	if light.has_box():
		half = 0.5 * light.box_size
		to_middle = -light.box_origin
		moved = -(to_light * light.box_middle)
		# A weight that is the same everywhere has no edge.
		if is_finite(bias):
			slope = minf(1.0 / maxf(light.blend_distance, 1e-9), _SHARPEST_EDGE)
			middle = light.box_middle
			reach = (half + light.blend_distance * Vector3.ONE).length_squared() * _MARGIN
	var sharpest := light.get_sharpest()
	var level := light.get_level()
	var texels: Array[Vector4] = [
		Vector4(to_light.x.x, to_light.y.x, to_light.z.x, moved.x),
		Vector4(to_light.x.y, to_light.y.y, to_light.z.y, moved.y),
		Vector4(to_light.x.z, to_light.y.z, to_light.z.z, moved.z),
		Vector4(half.x, half.y, half.z, slope),
		Vector4(to_middle.x, to_middle.y, to_middle.z, layer),
		Vector4(minf(bias, 1.0), energy, sharpest.x, level.x + shift),
		Vector4(sharpest.y, level.y, level.z, sources),
		Vector4(middle.x, middle.y, middle.z, -reach if starts_priority else reach),
	]
	_numbers.resize(4 * WIDTH * (_rows + _TEXELS))
	for i in _TEXELS:
		for j in 4:
			_numbers[4 * (WIDTH * (_rows + i) + i) + j] = texels[i][j]
	_rows += 1
	for column in WIDTH:
		if int(_numbers[4 * column]) == _first:
			_numbers[4 * column + 1] = _rows


## Hands the list to the GPU if it is another one.
func end() -> void:
	# Textures that grow by powers of two are few.
	var height := nearest_po2(_rows + _TEXELS)
	_numbers.resize(4 * WIDTH * height)
	var bytes := _numbers.to_byte_array()
	if bytes == _bytes:
		return
	var is_as_large := bytes.size() == _bytes.size()
	_bytes = bytes
	var image := Image.create_from_data(WIDTH, height, false, Image.FORMAT_RGBAF, bytes)
	if is_as_large:
		texture.update(image)
	else:
		texture.set_image(image)
