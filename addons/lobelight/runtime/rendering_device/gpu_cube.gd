@tool
extends "../pyramid/pyramid_cube.gd"
## A cube map that takes a pyramid's levels without leaving the GPU: Forward+ and Mobile.

const CanvasPass := preload("../pyramid/canvas_pass.gd")
const OwnedCubemap := preload("owned_cubemap.gd")

# Bound to what it copies and to the outcome; made once.
var _copy: Callable
# The errors of the last copy, which with a render thread of its own is that of the update before.
var _outcome: Array[Error] = [OK]


func _init(size: int, levels: Array[CanvasPass], old: TextureLayered = null) -> void:
	texture = old as OwnedCubemap if old != null else _make_texture(size, levels.size())
	var cube: RID = texture.texture_rd_rid
	var atlases: Array[RID] = []
	for level in levels:
		atlases.append(RenderingServer.texture_get_rd_texture(level.get_texture()))
	# Of a static function, so that it may run after the object has gone.
	_copy = _copy_levels.bind(cube, size, atlases, _outcome)


func receive(_slice: int) -> bool:
	RenderingServer.call_on_render_thread(_copy)
	return _outcome[0] == OK


func get_faces() -> Array[Image]:
	var faces: Array[Image] = []
	for face in 6:
		faces.append(texture.get_layer_data(face))
	return faces


static func _make_texture(size: int, levels: int) -> OwnedCubemap:
	var format := RDTextureFormat.new()
	format.texture_type = RenderingDevice.TEXTURE_TYPE_CUBE
	format.format = RenderingDevice.DATA_FORMAT_R16G16B16A16_SFLOAT
	format.width = size
	format.height = size
	format.array_layers = 6
	format.mipmaps = levels
	format.usage_bits = (
		RenderingDevice.TEXTURE_USAGE_SAMPLING_BIT
		| RenderingDevice.TEXTURE_USAGE_CAN_COPY_TO_BIT
		| RenderingDevice.TEXTURE_USAGE_CAN_COPY_FROM_BIT
	)
	var device := RenderingServer.get_rendering_device()
	return OwnedCubemap.new(device.texture_create(format, RDTextureView.new()))


static func _copy_levels(cube: RID, size: int, atlases: Array[RID], outcome: Array[Error]) -> void:
	var device := RenderingServer.get_rendering_device()
	outcome[0] = ERR_UNAVAILABLE
	if not cube.is_valid() or not atlases.all(device.texture_is_valid):
		return
	for level in atlases.size():
		var side := size >> level
		for face in 6:
			@warning_ignore("integer_division")
			var corner := Vector3(face % 3, face / 3, 0.0) * side
			var extent := Vector3(side, side, 1.0)
			var error := device.texture_copy(
				atlases[level], cube, corner, Vector3.ZERO, extent, 0, level, 0, face
			)
			if error != OK:
				outcome[0] = error
				return
	outcome[0] = OK
