@tool
extends RefCounted
## The lobes of isotropic tables as the shader takes them.
##
## These lobes lie in the plane of incidence and depend on the view's elevation only. So their
## directions, variances and Fresnel's factor are computed here, once. A texel is (d · r, d · q,
## weight, weight · (1 − o · h)⁵): r is the mirror direction of the view o, q is across r in the
## plane, on the view's side, and d is the lobe's mean times 256 times the square root of its
## variance ([code]lobelight_plane_lobe[/code] in [code]shaders/lobe_table.gdshaderinc[/code]).

# The least cosine between view and half-vector, as in the shader.
const _LEAST_COSINE := 1e-4
# The factor of standard deviations: GPUs may take half floats below 6e-5 for zero.
const _SCALE := 256.0
# The least number of steps over all views: converted lobes are mixed well only between close views.
const _LEAST_STEPS := 30.0


## The width of the image for a table of so many elevations.
static func get_columns(views: int) -> int:
	return (views - 1) * ceili(_LEAST_STEPS / (views - 1.0)) + 1


## The image of a table of one azimuth ([member LobeTable.image]), converted; second texels stay.
## [param last] is the last view's elevation.
static func convert(image: Image, lobes: int, alpha: float, last: float) -> Image:
	var views := image.get_width()
	var columns := get_columns(views)
	@warning_ignore("integer_division")
	var parts := (columns - 1) / (views - 1)
	var floats := image.duplicate() as Image
	floats.convert(Image.FORMAT_RGBAF)
	var given := floats.get_data().to_vector4_array()
	var texels := PackedVector4Array()
	texels.resize(columns * image.get_height())
	var at := 0
	for row in image.get_height():
		for column in columns:
			@warning_ignore("integer_division")
			var first := views * row + mini(column / parts, views - 2)
			var way := float(column - parts * mini(column / parts, views - 2)) / parts
			var texel := given[first].lerp(given[first + 1], way)
			if row < lobes:
				var rest := 1.0 - float(column) / (columns - 1)
				var elevation := last * (1.0 - rest * rest)
				texel = _convert_texel(texel, Vector2(sin(elevation), cos(elevation)), alpha)
			texels[at] = texel
			at += 1
	var result := Image.create_from_data(
		columns, image.get_height(), false, Image.FORMAT_RGBAF, texels.to_byte_array()
	)
	result.convert(Image.FORMAT_RGBAH)
	return result


# Lobes of tables of other origin may lie beside the plane. They are moved into it and made wider by
# their distance: the two lobes of a pair on both sides become alike.
static func _convert_texel(texel: Vector4, o: Vector2, alpha: float) -> Vector4:
	var x := texel.x * alpha
	var y := texel.y * alpha
	var inverse_length := 1.0 / sqrt(1.0 + x * x + y * y)
	var cosine := maxf((o.y + o.x * x) * inverse_length, _LEAST_COSINE)
	# The mean is 2 (o.h) h - o.
	var size := 2.0 * cosine * inverse_length
	var along := size * x - o.x
	var up := size - o.y
	var beside := size * y * size * y
	var variance := cosine * pow(2.0, -texel.z) + 0.5 * beside
	var scale := _SCALE * sqrt(variance / maxf(1.0 - beside, 1e-4))
	var grazing := texel.w * pow(maxf(1.0 - cosine, 0.0), 5.0)
	return Vector4(
		(o.y * up - o.x * along) * scale, (o.y * along + o.x * up) * scale, texel.w, grazing
	)
