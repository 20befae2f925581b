@tool
extends "light_store.gd"
## The lights of probes as an array of cube maps: Forward+ and Mobile. The array grows by doubling
## and is never read back while probes come and go.

const OwnedArray := preload("owned_array.gd")

## Environments of further worlds, and those that fade, which materials have beside their own.
const MAX_ENVIRONMENTS := 3
const _FACES := 6
# Of the layers of environments, in the list; -1 is the environment that all materials have.
const _FIRST_ENVIRONMENT := -2

var _array := OwnedArray.new()
var _capacity := 0
var _layers: Dictionary[LobeLight, int] = {}
# The faces that were handed over, so that those of another bake are noticed.
var _faces: Dictionary[LobeLight, Array] = {}
# What has been drawn or uploaded: other layers hold nothing.
var _filled: Dictionary[LobeLight, bool] = {}
var _environments: Array[LobeLight] = []


func hold(probes: Dictionary[int, LobeLight], environments: Array[LobeLight]) -> void:
	var lights := probes.values()
	_environments = environments.slice(0, MAX_ENVIRONMENTS)
	for light: LobeLight in _layers.keys():
		if light not in lights:
			_layers.erase(light)
			_faces.erase(light)
			_filled.erase(light)
	_grow(probes.size())
	for light: LobeLight in lights:
		if not _layers.has(light):
			_layers[light] = _find_free_layer()
		if not light.faces.is_empty() and _faces.get(light) != light.faces:
			_faces[light] = light.faces
			_upload(_layers[light], light.faces)
			_filled[light] = true


func has(probe: LobeLight) -> bool:
	return _filled.has(probe)


func get_layer(light: LobeLight) -> int:
	var environment := _environments.find(light)
	if environment >= 0:
		return _FIRST_ENVIRONMENT - environment
	return _layers[light] if _filled.has(light) else NO_PLACE


func get_level_shift(light: LobeLight) -> float:
	return log(float(size) / light.size) / log(2.0) if _layers.has(light) else 0.0


func get_defines() -> PackedStringArray:
	if _environments.is_empty():
		return []
	return ["ENVIRONMENTS %d" % _environments.size()]


func get_textures() -> Array[RID]:
	var textures: Array[RID] = []
	if _capacity > 0:
		textures.append(_array.get_rid())
	for light in _environments:
		textures.append(light.cubemap.get_rid())
	return textures


func apply(material: RID) -> void:
	var server := RenderingServer
	if _capacity > 0:
		server.material_set_param(material, &"lobelight_probes", _array.get_rid())
	for i in _environments.size():
		var name := StringName("lobelight_environment_%d" % i)
		server.material_set_param(material, name, _environments[i].cubemap.get_rid())


func take(light: LobeLight, cube: PyramidCube) -> bool:
	if not _layers.has(light) or cube.texture == null:
		return false
	var source: RID = (cube.texture as TextureCubemapRD).texture_rd_rid
	RenderingServer.call_on_render_thread(
		_copy_cube.bind(source, _array.texture_rd_rid, size, 0, _layers[light])
	)
	_filled[light] = true
	return true


func read(light: LobeLight) -> Array[Image]:
	var faces: Array[Image] = []
	if _filled.has(light):
		for face in _FACES:
			faces.append(_array.get_layer_data(_FACES * _layers[light] + face))
	return faces


func _find_free_layer() -> int:
	var used := _layers.values()
	for layer in _capacity:
		if layer not in used:
			return layer
	return 0


func _grow(count: int) -> void:
	if count <= _capacity:
		return
	var device := RenderingServer.get_rendering_device()
	var capacity := nearest_po2(count)
	var format := RDTextureFormat.new()
	format.texture_type = RenderingDevice.TEXTURE_TYPE_CUBE_ARRAY
	format.format = RenderingDevice.DATA_FORMAT_R16G16B16A16_SFLOAT
	format.width = size
	format.height = size
	format.array_layers = _FACES * capacity
	format.mipmaps = _count_levels(size)
	format.usage_bits = (
		RenderingDevice.TEXTURE_USAGE_SAMPLING_BIT
		| RenderingDevice.TEXTURE_USAGE_CAN_UPDATE_BIT
		| RenderingDevice.TEXTURE_USAGE_CAN_COPY_TO_BIT
		| RenderingDevice.TEXTURE_USAGE_CAN_COPY_FROM_BIT
	)
	var grown := device.texture_create(format, RDTextureView.new())
	for layer in _capacity:
		RenderingServer.call_on_render_thread(
			_copy_cube.bind(_array.texture_rd_rid, grown, size, layer, layer)
		)
	_array.set_owned(grown)
	_capacity = capacity


func _upload(layer: int, faces: Array[Image]) -> void:
	for face in _FACES:
		var data := _fit(faces[face]).get_data()
		RenderingServer.call_on_render_thread(
			_update_layer.bind(_array.texture_rd_rid, _FACES * layer + face, data)
		)


# A face in half floats at the size of the array: what is finer than that is left out, what is
# coarser stretched.
func _fit(saved: Image) -> Image:
	var face := saved
	if face.get_format() != Image.FORMAT_RGBAH:
		face = saved.duplicate()
		if face.is_compressed():
			face.decompress()
		face.convert(Image.FORMAT_RGBAH)
	if face.get_width() == size and (face.has_mipmaps() or size == 1):
		return face
	var data := face.get_data()
	var side := face.get_width()
	if side > size:
		var first := _find_level(side, size)
		return Image.create_from_data(size, size, size > 1, Image.FORMAT_RGBAH, data.slice(first))
	var fitted := PackedByteArray()
	var finest := Image.create_from_data(
		side, side, false, Image.FORMAT_RGBAH, data.slice(0, 8 * side * side)
	)
	var level := size
	while level > side:
		var stretched: Image = finest.duplicate()
		stretched.resize(level, level, Image.INTERPOLATE_BILINEAR)
		fitted.append_array(stretched.get_data())
		level >>= 1
	fitted.append_array(data)
	return Image.create_from_data(size, size, true, Image.FORMAT_RGBAH, fitted)


# Where the level of some side begins in the data of a face.
static func _find_level(side: int, wanted: int) -> int:
	var begin := 0
	while side > wanted:
		begin += 8 * side * side
		side >>= 1
	return begin


static func _count_levels(side: int) -> int:
	var levels := 1
	while side > 1:
		side >>= 1
		levels += 1
	return levels


static func _copy_cube(from: RID, to: RID, side: int, from_cube: int, to_cube: int) -> void:
	var device := RenderingServer.get_rendering_device()
	if not device.texture_is_valid(from) or not device.texture_is_valid(to):
		return
	for level in _count_levels(side):
		var extent := Vector3(maxi(side >> level, 1), maxi(side >> level, 1), 1.0)
		for face in _FACES:
			device.texture_copy(
				from,
				to,
				Vector3.ZERO,
				Vector3.ZERO,
				extent,
				level,
				level,
				_FACES * from_cube + face,
				_FACES * to_cube + face
			)


static func _update_layer(texture: RID, layer: int, data: PackedByteArray) -> void:
	var device := RenderingServer.get_rendering_device()
	if device.texture_is_valid(texture):
		device.texture_update(texture, layer, data)
