@tool
extends Object
## Panoramas filtered into lights in the editor, by the native library: what a [LobeEnvironment3D]
## would otherwise draw on the player's GPU.
## [br][br]
## What is asked of the library is a [code]LobeLightFilter[/code]'s request; start that, or have it
## wait, and make a light of its result.

const Pyramid := preload("../../runtime/pyramid/pyramid.gd")

const _NAMES: Dictionary[Pyramid.Filter, String] = {
	Pyramid.Filter.DISC: "disc", Pyramid.Filter.GAUSSIAN: "gaussian"
}


## The request for a panorama; the size is chosen as [LobeEnvironment3D] does where it is 0. Only
## round filters can be asked for, see [method Pyramid.is_round].
static func make_request(
	panorama: Image, size := 0, filter := Pyramid.Filter.DISC, as_sky := false
) -> Dictionary:
	var floats := panorama.duplicate() as Image
	floats.clear_mipmaps()
	if floats.is_compressed():
		floats.decompress()
	floats.convert(Image.FORMAT_RGBF)
	var request := make_linear_request(
		floats.get_data().to_float32_array(), panorama.get_size(), size, filter
	)
	request["srgb"] = panorama.get_format() not in Pyramid.LINEAR_FORMATS
	request["as_sky"] = as_sky
	return request


## The same for red, green and blue of linear light, of any brightness.
static func make_linear_request(
	pixels: PackedFloat32Array, extent: Vector2i, size: int, filter: Pyramid.Filter
) -> Dictionary:
	var width := extent.x
	var face_size := size if size > 0 else Pyramid.automatic_size_of(width)
	return {
		"pixels": pixels,
		"width": width,
		"height": extent.y,
		"size": face_size,
		"filter": _NAMES[filter],
		"samples": Pyramid.count_samples(width, face_size),
		"base_variance": Pyramid.base_variance_of(width, face_size, filter),
		"level_variance": Pyramid.LEVEL_VARIANCES[filter],
	}


## The light of a filter's result, in half floats.
static func make_light(request: Dictionary, result: Dictionary) -> LobeLight:
	var faces: Array[Image] = []
	var size: int = result["size"]
	for data: PackedByteArray in result["faces"]:
		faces.append(Image.create_from_data(size, size, size > 1, Image.FORMAT_RGBAH, data))
	var light := LobeLight.new()
	light.faces = faces
	light.size = size
	light.level_variance = request["level_variance"]
	light.base_variance = request["base_variance"]
	light.is_even = true
	if result["source_count"] > 0:
		light.source_texels = result["sources"]
	return light
