@tool
extends RefCounted
## All tables of a [LobeTableSet] as one texture, for widths that vary from pixel to pixel.
##
## Isotropic tables are a 2D texture: a lobe has rows for each width, so that the sampler mixes
## two widths as it mixes two views. Anisotropic ones are the layers of a 3D texture, sorted by how
## many levels the widths are apart and then by the narrower one: the sampler mixes two tables whose
## widths are equally far apart, and the shader mixes two of these mixtures.

## How much the logarithms of widths may differ from equal steps, which the shader assumes.
const TOLERANCE := 1e-3
## The layers that 3D textures have on every device (OpenGL ES 3.0, table 6.28; Vulkan 1.0, 31.1).
const MAX_LAYERS := 256

# Rows from one width of isotropic tables to the next. They are several because the sampler mixes
# converted texels (plane_lobes.gd), which is not quite the same as mixing tables.
const _ROWS_PER_WIDTH := 3

const PlaneLobes := preload("plane_lobes.gd")

var texture: Texture
## As [method LobeTable.get_lookup]; for isotropic tables, from a width's number to v.
var lookup: Vector4
## (x, y, z): a width's number is log2(alpha) x + y, the last is z.
var levels: Vector3


## [param tables] are images: the isotropic tables', by their widths, or the anisotropic ones', in
## the order of the layers.
static func make(
	widths: PackedFloat64Array, lobes: int, tables: Array[Image], isotropic: bool
) -> RefCounted:
	var result := new()
	var last := widths.size() - 1
	var scale := last * log(2.0) / log(widths[last] / widths[0])
	result.levels = Vector3(scale, -scale * log(widths[0]) / log(2.0), last)
	if isotropic:
		result._make_isotropic(widths, lobes, tables)
	else:
		@warning_ignore("integer_division")
		result._make_anisotropic(tables[0].get_height() / lobes, tables)
	return result


## Why the isotropic or anisotropic tables of a set of these widths cannot be looked up pixel by
## pixel, in a sentence; empty if they can.
static func find_problem(widths: PackedFloat64Array, isotropic: bool) -> String:
	var last := widths.size() - 1
	var step := log(widths[last] / widths[0]) / last
	for i in widths.size():
		if absf(log(widths[i] / widths[0]) - step * i) > TOLERANCE:
			return "The set's widths do not grow by equal factors."
	@warning_ignore("integer_division")
	var pairs := widths.size() * (widths.size() + 1) / 2
	if not isotropic and pairs > MAX_LAYERS:
		return (
			"The set's %d widths make %d anisotropic tables, but a 3D texture has %d layers at most."
			% [widths.size(), pairs, MAX_LAYERS]
		)
	return ""


func _make_isotropic(widths: PackedFloat64Array, lobes: int, tables: Array[Image]) -> void:
	var last := tables.size() - 1
	var count := last * _ROWS_PER_WIDTH + 1
	var columns := PlaneLobes.get_columns(tables[0].get_width())
	var image := Image.create_empty(columns, lobes * count, false, Image.FORMAT_RGBAH)
	for place in count:
		@warning_ignore("integer_division")
		var low := mini(place / _ROWS_PER_WIDTH, last - 1)
		var way := float(place - low * _ROWS_PER_WIDTH) / _ROWS_PER_WIDTH
		var table := PlaneLobes.convert(
			_mix(tables[low], tables[low + 1], way),
			lobes,
			widths[low] * pow(widths[low + 1] / widths[low], way),
			LobeTable.MAX_VIEW_ANGLE
		)
		for lobe in lobes:
			var row := Rect2i(0, lobe, columns, 1)
			image.blit_rect(table, row, Vector2i(0, lobe * count + place))
	texture = ImageTexture.create_from_image(image)
	var rows := 1.0 / (lobes * count)
	lookup = _get_columns(columns) + Vector4(0.0, 0.0, _ROWS_PER_WIDTH * rows, 0.5 * rows)


static func _mix(first: Image, second: Image, way: float) -> Image:
	if way <= 0.0 or way >= 1.0:
		return first if way <= 0.0 else second
	var parts: Array[PackedVector4Array] = []
	for image: Image in [first, second]:
		var floats := image.duplicate() as Image
		floats.convert(Image.FORMAT_RGBAF)
		parts.append(floats.get_data().to_vector4_array())
	for i in parts[0].size():
		parts[0][i] = parts[0][i].lerp(parts[1][i], way)
	return Image.create_from_data(
		first.get_width(), first.get_height(), false, Image.FORMAT_RGBAF, parts[0].to_byte_array()
	)


func _make_anisotropic(azimuths: int, tables: Array[Image]) -> void:
	var volume := ImageTexture3D.new()
	var size := tables[0].get_size()
	volume.create(Image.FORMAT_RGBAH, size.x, size.y, tables.size(), false, tables)
	texture = volume
	var v_scale := (azimuths - 1) / (0.5 * PI * size.y)
	lookup = _get_columns(size.x) + Vector4(0.0, 0.0, v_scale, 0.5 / size.y)


static func _get_columns(elevations: int) -> Vector4:
	var views := float(elevations)
	return Vector4((views - 1.0) / views, 0.5 / views, 0.0, 0.0)
