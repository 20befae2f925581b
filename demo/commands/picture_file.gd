extends Object
## Saves what a viewport shows.


## Saves a viewport's picture as PNG, whole or not at all. Returns one sentence on failure,
## otherwise empty.
static func save(viewport: Viewport, path: String) -> String:
	var image := viewport.get_texture().get_image()
	image.convert(Image.FORMAT_RGBF)
	# Compatibility's viewports hold sRGB, those of the others linear colours.
	if RenderingServer.get_current_rendering_method() != "gl_compatibility":
		image = _encode_srgb(image)
	image.convert(Image.FORMAT_RGB8)
	var temporary := path + ".tmp"
	var error := image.save_png(temporary)
	if error == OK:
		error = DirAccess.rename_absolute(temporary, path)
	return "" if error == OK else "%s: cannot be written (%s)." % [path, error_string(error)]


# Image.linear_to_srgb does this for eight bits only.
static func _encode_srgb(image: Image) -> Image:
	var values := image.get_data().to_float32_array()
	for i in values.size():
		var value := values[i]
		values[i] = 12.92 * value if value <= 0.0031308 else 1.055 * pow(value, 1.0 / 2.4) - 0.055
	return Image.create_from_data(
		image.get_width(), image.get_height(), false, Image.FORMAT_RGBF, values.to_byte_array()
	)
