@tool
extends RefCounted
## How the update of a chain is spread over frames: what is drawn in which of them.


## What is drawn and taken in one frame.
class Slice:
	## Views, by their faces.
	var views: PackedInt32Array = []
	## Of the search for sources: the first row of its first pass, how many rows.
	var search := Vector2i.ZERO
	## Whether its other passes are drawn.
	var ends_search := false
	## Of levels: the level, its first row, how many rows.
	var rows: Array[Vector3i] = []
	## Parts of what the cube map takes.
	var parts: PackedInt32Array = []


const LightSearch := preload("light_search.gd")
const Pyramid := preload("pyramid.gd")

# The finest levels, which are never drawn in one slice with the rest: that would be too much at
# once.
const _LARGE_LEVELS := 2


## All in one frame, but that of what the cube map takes only [param parts_at_once] parts are taken
## in a frame.
static func at_once(
	views: int, search: LightSearch, pyramid: Pyramid, parts: int, parts_at_once: int
) -> Array[Slice]:
	var slices: Array[Slice] = []
	for part in parts:
		if part % parts_at_once == 0:
			slices.append(Slice.new())
		slices.back().parts.append(part)
	slices[0].views = PackedInt32Array(range(views))
	if search != null:
		slices[0].search = Vector2i(0, search.count_rows())
		slices[0].ends_search = true
	for level in pyramid.levels.size():
		slices[0].rows.append(Vector3i(level, 0, pyramid.count_rows(level)))
	return slices


## Spread over frames: each view, the search for sources, the large levels, the others, each part.
## The search and levels are spread further where a frame would have more than [param most] fetches.
static func spread(
	views: int, search: LightSearch, pyramid: Pyramid, parts: int, most: float
) -> Array[Slice]:
	var slices: Array[Slice] = []
	for view in views:
		slices.append(Slice.new())
		slices.back().views.append(view)
	var left := 0.0
	if search != null:
		left = _spread_search(slices, search, most)
	for level in pyramid.levels.size():
		if level == 0 and search == null or level == _LARGE_LEVELS:
			slices.append(Slice.new())
			left = most
		var rows := pyramid.count_rows(level)
		var row_cost := pyramid.count_fetches(level) / rows
		var row := 0
		while row < rows:
			var count := mini(floori(minf(left / row_cost, rows)), rows - row)
			# The rest may be negative after a row or a pass of more fetches than allowed.
			if count <= 0 and not _is_empty(slices.back()):
				slices.append(Slice.new())
				left = most
				continue
			count = maxi(count, 1)
			slices.back().rows.append(Vector3i(level, row, count))
			left -= count * row_cost
			row += count
	# What is not read back is taken with the last levels.
	for part in parts:
		if parts > 1:
			slices.append(Slice.new())
		slices.back().parts.append(part)
	return slices


# Adds the slices of a search; how many fetches are left in the last one.
static func _spread_search(slices: Array[Slice], search: LightSearch, most: float) -> float:
	var rows := search.count_rows()
	var row_cost := search.count_fetches() / rows
	var left := 0.0
	var row := 0
	while row < rows:
		slices.append(Slice.new())
		var count := maxi(mini(floori(minf(most / row_cost, rows)), rows - row), 1)
		slices.back().search = Vector2i(row, count)
		left = most - count * row_cost
		row += count
	if left < search.count_last_fetches():
		slices.append(Slice.new())
		left = most
	slices.back().ends_search = true
	return left - search.count_last_fetches()


static func _is_empty(slice: Slice) -> bool:
	return slice.rows.is_empty() and slice.search.y == 0 and not slice.ends_search
