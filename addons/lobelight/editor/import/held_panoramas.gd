@tool
extends RefCounted
## Textures of panoramas that scenes hold while their files are imported anew: they get the new
## pixels, and whoever listens to [signal Resource.changed] hears of it.
##
## The engine reloads an [ImageTexture] by reading the source file with its own loader, without what
## the importer makes of it; so it must not find the texture in its cache meanwhile.

# By the files' paths: the texture, and the image that it gets, null where the import failed.
var _textures: Dictionary[String, ImageTexture] = {}
var _images: Dictionary[String, Image] = {}


## To be called when the import of a file begins.
func begin(path: String) -> void:
	if path in _textures or not ResourceLoader.has_cached(path):
		return
	var texture := ResourceLoader.get_cached_ref(path) as ImageTexture
	if texture != null:
		_textures[path] = texture
		texture.resource_path = ""


## To be called when a file has been imported as this.
func set_image(path: String, image: Image) -> void:
	if path in _textures:
		_images[path] = image


## To be called when the engine has reloaded what these files were imported as.
func end(paths: PackedStringArray) -> void:
	for path in paths:
		if path not in _textures:
			continue
		var texture := _textures[path]
		_textures.erase(path)
		if path in _images and not renew(texture, _images[path]):
			texture = ImageTexture.create_from_image(_images[path])
		_images.erase(path)
		texture.take_over_path(path)


## Gives a texture other pixels. Returns whether it has them: without a renderer it keeps those that
## it was made with.
static func renew(texture: ImageTexture, image: Image) -> bool:
	texture.set_image(image)
	return texture.get_image().get_data() == image.get_data()
