@tool
extends RefCounted
## Makes the light of a panorama in a file, as [LobeEnvironment3D] does, but for previews only: the
## edited scene goes on being lit by its own.

const NativeLibrary := preload("../bake/native_library.gd")
const Pyramid := preload("../../runtime/pyramid/pyramid.gd")

## Why there is no light, in a sentence.
var error := ""


## The light, once it has been drawn; [code]null[/code], and [member error], if it cannot be made.
func make(path: String) -> LobeLight:
	error = NativeLibrary.get_problem()
	if error.is_empty() and not Pyramid.has_renderer():
		error = "The editor runs without a renderer."
	if error:
		return null
	var file := NativeLibrary.create(&"LobeImageFile")
	var read: Dictionary = file.call("load_half_panorama", path)
	if read.has("error"):
		error = read["error"]
		return null
	var width: int = read["width"]
	var height: int = read["height"]
	var data: PackedByteArray = read["data"]
	var image := Image.create_from_data(width, height, false, Image.FORMAT_RGBAH, data)
	# In no tree, it offers its light to nobody.
	var environment := LobeEnvironment3D.new()
	environment.update_mode = LobeEnvironment3D.UpdateMode.ONCE
	environment.panorama = ImageTexture.create_from_image(image)
	var is_made := await environment.rebuild()
	var light: LobeLight = environment.get_light() if is_made else null
	error = environment.get_rebuild_error()
	environment.free()
	return light
