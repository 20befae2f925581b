@tool
extends RefCounted
## Sets of tables without the widths that nothing reaches.

# Materials round their widths by less (LobeTableSet.shared_table_at).
const ROUNDING := 1.01


## The part of a set that gives, for all widths from [param low] to [param high], the tables that
## the whole set gives; the set itself if that is all of it.
static func cut(tables: LobeTableSet, low: float, high: float) -> LobeTableSet:
	var last := tables.widths.size() - 1
	# One width more on each side: rows of tables between two pairs of widths begin half a width
	# before them.
	var first := clampi(tables.widths.bsearch(low / ROUNDING, false) - 2, 0, last - 1)
	var end := clampi(tables.widths.bsearch(high * ROUNDING, true) + 1, first + 1, last)
	if first == 0 and end == last:
		return tables
	var images: Array[Image] = []
	for wide in range(first, end + 1):
		for narrow in range(first, wide + 1):
			images.append(tables.get_pair_image(wide, narrow))
	for width in range(first, end + 1):
		images.append(tables.get_isotropic_image(width))
	var part := LobeTableSet.new()
	part.brdf = tables.brdf
	part.lobe_count = tables.lobe_count
	part.views = tables.views
	part.seed = tables.seed
	part.widths = tables.widths.slice(first, end + 1)
	part.image = _stack(images)
	# Otherwise random: equal exports are to have equal bytes.
	part.resource_scene_unique_id = "set"
	part.image.resource_scene_unique_id = "lobes"
	return part


static func _stack(images: Array[Image]) -> Image:
	var bytes := PackedByteArray()
	var height := 0
	for image in images:
		bytes.append_array(image.get_data())
		height += image.get_height()
	return Image.create_from_data(images[0].get_width(), height, false, Image.FORMAT_RGBAH, bytes)
