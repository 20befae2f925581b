@tool
extends RefCounted
## All tables of a [LobeTableSet] as one texture, for widths that vary from pixel to pixel.
##
## Isotropic tables are a 2D texture: a lobe has one row for each width, so that the sampler mixes
## two widths as it mixes two views. Anisotropic ones are the layers of a 3D texture, sorted by how
## many levels the widths are apart and then by the narrower one: the sampler mixes two tables whose
## widths are equally far apart, and the shader mixes two of these mixtures.

## The widths must grow by equal factors for the shader to find them; by how much their logarithms
## may be off.
const TOLERANCE := 1e-3
## The layers that 3D textures have on every device (OpenGL ES 3.0, table 6.28; Vulkan 1.0, 31.1).
const MAX_LAYERS := 256

var texture: Texture
## As [method LobeTable.get_lookup]; for isotropic tables, from a width's number to v.
var lookup: Vector4
## (x, y, z): a width's number is log2(alpha) x + y, the last is z.
var levels: Vector3


static func make(tables: LobeTableSet, isotropic: bool) -> RefCounted:
	var result := new()
	var widths := tables.widths
	var last := widths.size() - 1
	var scale := last * log(2.0) / log(widths[last] / widths[0])
	result.levels = Vector3(scale, -scale * log(widths[0]) / log(2.0), last)
	if isotropic:
		result._make_isotropic(tables)
	else:
		result._make_anisotropic(tables)
	return result


## Why a set's isotropic or anisotropic tables cannot be looked up pixel by pixel, in a sentence;
## empty if they can.
static func find_problem(tables: LobeTableSet, isotropic: bool) -> String:
	var widths := tables.widths
	var last := widths.size() - 1
	var step := log(widths[last] / widths[0]) / last
	for i in widths.size():
		if absf(log(widths[i] / widths[0]) - step * i) > TOLERANCE:
			return "The set's widths do not grow by equal factors."
	if not isotropic and tables.get_pair_count() > MAX_LAYERS:
		return (
			"The set's %d widths make %d anisotropic tables, but a 3D texture has %d layers at most."
			% [widths.size(), tables.get_pair_count(), MAX_LAYERS]
		)
	return ""


func _make_isotropic(tables: LobeTableSet) -> void:
	var lobes := tables.lobe_count
	var count := tables.widths.size()
	var image := Image.create_empty(tables.views.x, lobes * count, false, Image.FORMAT_RGBAH)
	for level in count:
		var part := tables.get_isotropic_image(level)
		for lobe in lobes:
			var row := Rect2i(0, lobe, tables.views.x, 1)
			image.blit_rect(part, row, Vector2i(0, lobe * count + level))
	texture = ImageTexture.create_from_image(image)
	var rows := 1.0 / (lobes * count)
	lookup = _get_columns(tables) + Vector4(0.0, 0.0, rows, 0.5 * rows)


func _make_anisotropic(tables: LobeTableSet) -> void:
	var layers: Array[Image] = []
	var count := tables.widths.size()
	for apart in count:
		for narrow in count - apart:
			layers.append(tables.get_pair_image(narrow + apart, narrow))
	var volume := ImageTexture3D.new()
	var size := layers[0].get_size()
	volume.create(Image.FORMAT_RGBAH, size.x, size.y, layers.size(), false, layers)
	texture = volume
	var v_scale := (tables.views.y - 1) / (0.5 * PI * size.y)
	lookup = _get_columns(tables) + Vector4(0.0, 0.0, v_scale, 0.5 / size.y)


static func _get_columns(tables: LobeTableSet) -> Vector4:
	var views := float(tables.views.x)
	return Vector4((views - 1.0) / views, 0.5 / views, 0.0, 0.0)
