extends GdUnitTestSuite
## How an update is spread over frames, by fetches that are made up.

const ChainSlices := preload("res://addons/lobelight/runtime/pyramid/chain_slices.gd")
const LightSearch := preload("res://addons/lobelight/runtime/pyramid/light_search.gd")
const Pyramid := preload("res://addons/lobelight/runtime/pyramid/pyramid.gd")

# Fetches that a slice may have.
const MOST := 10.0
# Of the search's last passes: within what a slice may have, and beyond.
const LAST := [[5.0], [25.0]]


class MadeUpSearch:
	extends LightSearch
	const ROWS := 4
	const ROW_FETCHES := 3.0
	var last := 0.0

	func count_rows() -> int:
		return ROWS

	func count_fetches() -> float:
		return ROWS * ROW_FETCHES

	func count_last_fetches() -> float:
		return last

	func draw_rows(_first: int, _count: int) -> void:
		pass

	func draw_last() -> void:
		pass

	func receive() -> void:
		pass

	func get_viewports() -> Array[RID]:
		return []


class MadeUpPyramid:
	extends Pyramid
	# A row of the second level has more than a slice may have.
	const LEVEL_ROWS: PackedInt32Array = [8, 4, 2]
	const ROW_FETCHES: PackedFloat64Array = [3.0, 12.0, 1.0]

	func _init() -> void:
		levels.resize(LEVEL_ROWS.size())

	func count_rows(level: int) -> int:
		return LEVEL_ROWS[level]

	func count_fetches(level: int) -> float:
		return LEVEL_ROWS[level] * ROW_FETCHES[level]


func test_slices_have_what_they_may_and_all_is_drawn(last: float, _test_parameters := LAST) -> void:
	var search := MadeUpSearch.new()
	search.last = last
	var pyramid := MadeUpPyramid.new()
	var drawn: PackedInt32Array = [0, 0, 0]
	var searched := 0
	var ends := 0
	for slice in ChainSlices.spread(0, search, pyramid, 1, MOST):
		var fetches := slice.search.y * search.ROW_FETCHES
		var pieces := slice.search.y
		searched += slice.search.y
		if slice.ends_search:
			fetches += last
			pieces += 1
			ends += 1
		for rows in slice.rows:
			assert_int(rows.y).is_equal(drawn[rows.x])
			drawn[rows.x] += rows.z
			fetches += rows.z * pyramid.ROW_FETCHES[rows.x]
			pieces += rows.z
		# What cannot be divided is alone in its slice.
		if pieces > 1:
			assert_float(fetches).is_less_equal(MOST)
	assert_int(searched).is_equal(search.ROWS)
	assert_int(ends).is_equal(1)
	assert_array(Array(drawn)).is_equal(Array(pyramid.LEVEL_ROWS))
