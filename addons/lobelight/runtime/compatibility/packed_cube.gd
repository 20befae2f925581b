@tool
extends "../pyramid/pyramid_cube.gd"
## A cube map that takes a pyramid's levels through the processor's memory: Compatibility, where
## nothing can draw or copy into a cube map.
##
## A face with all its levels is drawn as bytes, and these are read back; reading half floats would
## not do, because OpenGL ES reads every texture back as eight-bit colours (Godot 4.6,
## drivers/gles3/storage/texture_storage.cpp, texture_2d_get). The faces are replaced together.

const CanvasPass := preload("../pyramid/canvas_pass.gd")
const PackShader := preload("pyramid_pack.gdshader")

var _size: int
var _bytes := 0
var _passes: Array[CanvasPass] = []
var _faces: Array[Image] = []


func _init(size: int, levels: Array[CanvasPass], old: TextureLayered = null) -> void:
	slices = 6
	_size = size
	texture = old as Cubemap if old != null else Cubemap.new()
	for level in levels.size():
		_bytes += 8 * (size >> level) * (size >> level)
	@warning_ignore("integer_division")
	var rows := (_bytes + 8 * size - 1) / (8 * size)
	for face in 6:
		var drawn := CanvasPass.new(Vector2i(2 * size, rows), false)
		# Two pixels a texel. Levels of less than a row share the last one.
		var begin := 0
		for level in levels.size():
			var side := size >> level
			var pixels := 2 * side * side
			@warning_ignore("integer_division")
			var corner := Vector2i(begin % (2 * size), begin / (2 * size))
			@warning_ignore("integer_division")
			var extent := Vector2i(mini(pixels, 2 * size), maxi(pixels / (2 * size), 1))
			begin += pixels
			var parameters: Dictionary[StringName, Variant] = {
				&"level": levels[level].get_texture(),
				&"level_size": side,
				&"level_face": face,
				&"extent": extent,
			}
			drawn.add_rect(Rect2i(corner, extent), PackShader, parameters)
		_passes.append(drawn)
	_faces.resize(6)


func get_viewports() -> Array[RID]:
	var viewports: Array[RID] = []
	for drawn in _passes:
		viewports.append(drawn.viewport)
	return viewports


func draw(slice: int) -> void:
	_passes[slice].draw()


func receive(slice: int) -> bool:
	var image := RenderingServer.texture_2d_get(_passes[slice].get_texture())
	if image == null or image.get_format() != Image.FORMAT_RGBA8:
		return false
	var data := image.get_data()
	if data.size() < _bytes:
		return false
	data.resize(_bytes)
	_faces[slice] = Image.create_from_data(_size, _size, true, Image.FORMAT_RGBAH, data)
	if slice < slices - 1:
		return true
	var cube: Cubemap = texture
	if cube.get_width() == 0:
		return cube.create_from_images(_faces) == OK
	for face in 6:
		cube.update_layer(_faces[face], face)
	return true


func get_faces() -> Array[Image]:
	return _faces
