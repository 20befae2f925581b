extends RefCounted
## A panorama as a dual-paraboloid map, made on the GPU in any renderer: two square halves with mip
## levels of 2 × 2 means, as graphics hardware makes them.

const MapShader := preload("dual_paraboloid.gdshader")
## b of Töral 2015, eq. 2.12: a half reaches beyond its hemisphere's rim by this factor, so that the
## coarser levels do not mix in what lies outside. The value is that of GPU Gems 3, chapter 20.
const SCALE_FACTOR := 1.2
const _MAX_SAMPLES := 8

## The halves z >= 0 and z < 0.
var texture: Texture2DArray
## Texels along the side of a half.
var side := 0


## The map of a panorama in linear floats, [param half_size] texels along the side of a half; null
## if nothing was drawn. To be awaited.
static func make(panorama: Texture2D, half_size: int, tree: SceneTree) -> RefCounted:
	var material := ShaderMaterial.new()
	material.shader = MapShader
	material.set_shader_parameter(&"panorama", panorama)
	material.set_shader_parameter(&"panorama_is_srgb", false)
	material.set_shader_parameter(&"side", half_size)
	material.set_shader_parameter(&"scale_factor", SCALE_FACTOR)
	# Enough for a map whose texels are wider than the panorama's.
	var samples := clampi(ceili(panorama.get_width() / float(half_size)), 1, _MAX_SAMPLES)
	material.set_shader_parameter(&"samples", samples)

	var viewport := SubViewport.new()
	viewport.disable_3d = true
	viewport.use_hdr_2d = true
	viewport.transparent_bg = true
	viewport.size = Vector2i(2 * half_size, half_size)
	viewport.render_target_update_mode = SubViewport.UPDATE_ONCE
	var rectangle := ColorRect.new()
	rectangle.size = viewport.size
	rectangle.material = material
	viewport.add_child(rectangle)
	tree.root.add_child(viewport)
	await RenderingServer.frame_post_draw
	var both := viewport.get_texture().get_image()
	viewport.free()
	if both == null or both.is_empty():
		return null
	both.convert(Image.FORMAT_RGBAH)
	var halves: Array[Image] = []
	for half in 2:
		var image := both.get_region(Rect2i(half * half_size, 0, half_size, half_size))
		image.generate_mipmaps()
		halves.append(image)
	var map := new()
	map.texture = Texture2DArray.new()
	map.texture.create_from_images(halves)
	map.side = half_size
	return map
