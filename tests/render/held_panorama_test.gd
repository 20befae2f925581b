extends GdUnitTestSuite
## Textures that are held while their panorama is imported anew show the new one.

const HeldPanoramas := preload("res://addons/lobelight/editor/import/held_panoramas.gd")


func _make(colour: Color, width: int) -> Image:
	var image := Image.create_empty(width, width >> 1, false, Image.FORMAT_RGBAH)
	image.fill(colour)
	return image


func test_held_textures_get_the_new_pixels() -> void:
	var path := "user://held_panorama.res"
	ResourceSaver.save(ImageTexture.create_from_image(_make(Color.RED, 8)), path)
	var texture := load(path) as ImageTexture
	var changes: Array[bool] = []
	texture.changed.connect(func() -> void: changes.append(true))
	var held := HeldPanoramas.new()
	held.begin(path)
	assert_bool(ResourceLoader.has_cached(path)).is_false()
	held.set_image(path, _make(Color(0.0, 4.0, 0.0), 16))
	held.end([path])
	assert_object(load(path)).is_same(texture)
	assert_int(changes.size()).is_equal(1)
	assert_vector(texture.get_size()).is_equal(Vector2(16.0, 8.0))
	assert_that(texture.get_image().get_pixel(3, 3)).is_equal(Color(0.0, 4.0, 0.0))
	DirAccess.remove_absolute(path)


func test_a_failed_import_leaves_everything() -> void:
	var path := "user://held_panorama_failed.res"
	ResourceSaver.save(ImageTexture.create_from_image(_make(Color.RED, 8)), path)
	var texture := load(path) as ImageTexture
	var held := HeldPanoramas.new()
	held.begin(path)
	held.end([path])
	assert_object(load(path)).is_same(texture)
	assert_that(texture.get_image().get_pixel(3, 3)).is_equal(Color.RED)
	DirAccess.remove_absolute(path)
