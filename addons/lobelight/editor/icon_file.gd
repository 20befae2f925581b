@tool
extends Object
## The addon's icons, drawn from their files: a project that has never been imported has no textures
## of them.

const _PATH := "res://addons/lobelight/icons/%s.svg"


## An icon by its file's name, as many times larger than in the file as [param scale] says.
static func draw(name: String, scale: float) -> ImageTexture:
	var image := Image.new()
	image.load_svg_from_string(FileAccess.get_file_as_string(_PATH % name), scale)
	return ImageTexture.create_from_image(image)
