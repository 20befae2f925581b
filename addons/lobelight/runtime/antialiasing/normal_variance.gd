@tool
extends Object
## Makes the [member LobeBaseMaterial3D.normal_variance_texture] of a normal map.


## A texture of half the map's size: the square root of the variance of x and y, together, of all
## normals within each texel, for every level. [code]null[/code], and an error, without an image.
static func bake(normals: Image) -> ImageTexture:
	if normals == null or normals.is_empty():
		push_error("Lobelight: the normal map has no image to bake its variance from.")
		return null
	var image := normals.duplicate() as Image
	if image.is_compressed() and image.decompress() != OK:
		push_error("Lobelight: the normal map's image cannot be decompressed.")
		return null
	image.clear_mipmaps()
	image.convert(Image.FORMAT_RGB8)
	var size := image.get_size()
	var half := Vector2i(maxi(size.x >> 1, 1), maxi(size.y >> 1, 1))
	var means := _first_means(image.get_data(), size, half)
	var levels := PackedByteArray()
	size = half
	while true:
		levels.append_array(_deviations(means))
		if size == Vector2i.ONE:
			break
		half = Vector2i(maxi(size.x >> 1, 1), maxi(size.y >> 1, 1))
		means = _means(means, size, half)
		size = half
	size = Vector2i(maxi(image.get_width() >> 1, 1), maxi(image.get_height() >> 1, 1))
	var result := Image.create_from_data(size.x, size.y, true, Image.FORMAT_R8, levels)
	return ImageTexture.create_from_image(result)


# Of 2 x 2 texels each: x, y, x^2 + y^2, one after the other.
static func _first_means(
	data: PackedByteArray, size: Vector2i, half: Vector2i
) -> PackedFloat32Array:
	var means := PackedFloat32Array()
	means.resize(3 * half.x * half.y)
	var right := 3 if size.x > 1 else 0
	var below := 3 * size.x if size.y > 1 else 0
	var to := 0
	for row in half.y:
		var from := 6 * row * size.x
		for column in half.x:
			var x := 0.0
			var y := 0.0
			var squares := 0.0
			for at: int in [from, from + right, from + below, from + right + below]:
				var u := data[at] / 127.5 - 1.0
				var v := data[at + 1] / 127.5 - 1.0
				x += u
				y += v
				squares += u * u + v * v
			means[to] = 0.25 * x
			means[to + 1] = 0.25 * y
			means[to + 2] = 0.25 * squares
			to += 3
			from += 6
	return means


static func _means(finer: PackedFloat32Array, size: Vector2i, half: Vector2i) -> PackedFloat32Array:
	var means := PackedFloat32Array()
	means.resize(3 * half.x * half.y)
	var right := 3 if size.x > 1 else 0
	var below := 3 * size.x if size.y > 1 else 0
	for row in half.y:
		for column in half.x:
			var from := 6 * (row * size.x + column)
			var to := 3 * (row * half.x + column)
			for k in 3:
				means[to + k] = (
					0.25
					* (
						finer[from + k]
						+ finer[from + right + k]
						+ finer[from + below + k]
						+ finer[from + right + below + k]
					)
				)
	return means


static func _deviations(means: PackedFloat32Array) -> PackedByteArray:
	var result := PackedByteArray()
	@warning_ignore("integer_division")
	var count := means.size() / 3
	result.resize(count)
	for i in count:
		var x := means[3 * i]
		var y := means[3 * i + 1]
		var variance := maxf(means[3 * i + 2] - x * x - y * y, 0.0)
		result[i] = mini(roundi(255.0 * sqrt(variance)), 255)
	return result
