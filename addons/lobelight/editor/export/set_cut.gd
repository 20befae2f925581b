@tool
extends RefCounted
## Sets of tables without what nothing reaches: widths beyond all that is drawn are left out, and of
## the tables between, those that nothing asks for are black, which compresses to nothing.

const SetReach := preload("set_reach.gd")

# Materials round their widths by less (LobeTableSet.shared_table_at).
const ROUNDING := 1.01

## The smaller set; the whole one if nothing can be left out.
var part: LobeTableSet
## How many tables of the whole set are left.
var table_count := 0


## The part of a set that gives, for what is reached, the tables that the whole set gives.
static func of(tables: LobeTableSet, reach: SetReach) -> RefCounted:
	var cut := new()
	cut.part = tables
	var needed := cut._find_needed(tables, reach)
	cut.table_count = needed.size()
	if needed.size() < tables.get_table_count():
		cut.part = cut._make(tables, _find_widths(tables, reach), needed)
	return cut


# The first and the last of the widths that are kept.
static func _find_widths(tables: LobeTableSet, reach: SetReach) -> Vector2i:
	var last := tables.widths.size() - 1
	if reach.isotropic_because:
		return Vector2i(0, last)
	var ends := reach.get_range()
	# One width more on each side: rows of tables between two pairs of widths begin half a width
	# before them.
	var first := clampi(tables.widths.bsearch(ends.x / ROUNDING, false) - 2, 0, last - 1)
	return Vector2i(
		first, clampi(tables.widths.bsearch(ends.y * ROUNDING, true) + 1, first + 1, last)
	)


# The numbers of the tables that are mixed for what is reached.
static func _find_needed(tables: LobeTableSet, reach: SetReach) -> Dictionary[int, bool]:
	var needed: Dictionary[int, bool] = {}
	if reach.isotropic_because:
		for width in tables.widths.size():
			needed[_isotropic(tables, width)] = true
	if reach.is_filled:
		var ends := _find_widths(tables, reach)
		for width in range(ends.x, ends.y + 1):
			needed[_isotropic(tables, width)] = true
			if not reach.is_isotropic() and not tables.is_isotropic():
				for narrow in range(ends.x, width + 1):
					needed[_pair(width, narrow)] = true
	for surface in reach.surfaces:
		for wide: float in [1.0 / ROUNDING, 1.0, ROUNDING]:
			for narrow: float in [1.0 / ROUNDING, 1.0, ROUNDING]:
				# Rounding does not take equal widths apart.
				if wide == narrow or not is_equal_approx(surface.x, surface.y):
					var shares := tables.get_shares(surface * Vector2(wide, narrow))
					for table: int in shares:
						needed[table] = true
	return needed


static func _pair(wide: int, narrow: int) -> int:
	@warning_ignore("integer_division")
	return wide * (wide + 1) / 2 + narrow


static func _isotropic(tables: LobeTableSet, width: int) -> int:
	return tables.get_pair_count() + width


func _make(tables: LobeTableSet, ends: Vector2i, needed: Dictionary[int, bool]) -> LobeTableSet:
	var numbers: PackedInt32Array = []
	if not tables.is_isotropic():
		for wide in range(ends.x, ends.y + 1):
			for narrow in range(ends.x, wide + 1):
				numbers.append(_pair(wide, narrow))
	for width in range(ends.x, ends.y + 1):
		numbers.append(_isotropic(tables, width))
	var bytes := PackedByteArray()
	for number in numbers:
		var data := tables.get_table_data(number)
		if not needed.has(number):
			data.fill(0)
		bytes.append_array(data)
	var widths := Array(tables.widths.slice(ends.x, ends.y + 1))
	return make_set(tables.brdf, tables.seed, tables.lobe_count, tables.views, widths, bytes)


## A set of tables from their texels, one below the other.
static func make_set(
	brdf: String,
	seed_of_fit: int,
	lobes: int,
	views: Vector2i,
	widths: Array,
	texels: PackedByteArray
) -> LobeTableSet:
	@warning_ignore("integer_division")
	var height := texels.size() / (8 * views.x)
	return (
		LobeTableSet
		. from_baked(
			{
				"brdf": brdf,
				"seed": seed_of_fit,
				"lobes": lobes,
				"views": views,
				"widths": widths,
				"width": views.x,
				"height": height,
				"data": texels,
			}
		)
	)
