@tool
@icon("../icons/lobe_table.svg")
class_name LobeTableSet
extends Resource
## Lobe tables of one BRDF for all widths.
##
## [method table_at] interpolates a [LobeTable] for any pair of widths, without the editor's library
## and without a fit: [code]material.table = set.table_at(Vector2(0.1, 0.3))[/code]. What comes out
## costs at run time what any table of its lobes does.
## [br][br]
## A set holds one anisotropic table for every pair of [member widths] whose first is not the
## smaller, and one isotropic table for every width. [code]res://addons/lobelight/tables[/code] has
## ready sets; [code]./dev bake-tables[/code] makes them, and sets of other BRDFs and lobe counts.

## The most [member widths].
const MAX_WIDTHS := 64

## The name of the BRDF that was fitted.
@export var brdf := "":
	set(value):
		brdf = value
		emit_changed()
## The widths on each axis, rising.
@export var widths := PackedFloat64Array():
	set(value):
		widths = value
		emit_changed()
## Lobes per view.
@export var lobe_count := 0:
	set(value):
		lobe_count = value
		emit_changed()
## Views of an anisotropic table's grid: elevations, azimuths. Isotropic tables have one azimuth.
@export var views := Vector2i.ZERO:
	set(value):
		views = value
		emit_changed()
## The seed of the fit.
@warning_ignore("shadowed_global_identifier") @export var seed := 0:
	set(value):
		seed = value
		emit_changed()
## The tables' images (see [member LobeTable.image]) one below the other: the anisotropic tables,
## that of widths x and y, x ≥ y, counted from 0, being number [code]x * (x + 1) / 2 + y[/code],
## then the isotropic tables of all widths.
@export var image: Image:
	set(value):
		image = value
		emit_changed()


## A set from a result of [LobeBaker]; [code]null[/code], and an error, if it is none.
static func from_baked(result: Dictionary) -> LobeTableSet:
	if result.has("error"):
		push_error("LobeTableSet.from_baked: the bake failed: %s" % result["error"])
		return null
	for key: String in ["brdf", "widths", "lobes", "views", "width", "height", "data"]:
		if not result.has(key):
			push_error('LobeTableSet.from_baked: the result has no "%s".' % key)
			return null
	var tables := LobeTableSet.new()
	tables.brdf = result["brdf"]
	tables.widths = PackedFloat64Array(result["widths"] as Array)
	tables.lobe_count = result["lobes"]
	tables.views = Vector2i(result["views"])
	tables.seed = result.get("seed", 0)
	var width: int = result["width"]
	var height: int = result["height"]
	var data: PackedByteArray = result["data"]
	if width < 1 or height < 1 or data.size() != width * height * 8:
		push_error(
			(
				"LobeTableSet.from_baked: %d x %d texels of 8 bytes are not %d bytes."
				% [width, height, data.size()]
			)
		)
		return null
	tables.image = Image.create_from_data(width, height, false, Image.FORMAT_RGBAH, data)
	# Otherwise random: equal sets are to be saved as equal bytes.
	tables.resource_scene_unique_id = "set"
	tables.image.resource_scene_unique_id = "lobes"
	var problem := tables.get_problem()
	if problem:
		push_error("LobeTableSet.from_baked: " + problem)
		return null
	return tables


## What keeps the set from being used, in a sentence; empty if nothing does.
func get_problem() -> String:
	if lobe_count < 1 or lobe_count > LobeTable.MAX_LOBES:
		return "A set has 1 to %d lobes, this one has %d." % [LobeTable.MAX_LOBES, lobe_count]
	if views.x < 2 or views.y < 2:
		return (
			"A set has at least 2 elevations and 2 azimuths, this one has %d and %d."
			% [views.x, views.y]
		)
	var problem := _get_widths_problem()
	if problem.is_empty():
		problem = _get_image_problem()
	return problem


## How many tables the set holds.
func get_table_count() -> int:
	return _pair_count() + widths.size()


## The bytes of one table's texels, tables being counted as [member image] has them.
func get_table_data(table: int) -> PackedByteArray:
	var bytes := 8 * views.x
	return image.get_data().slice(bytes * _row(table), bytes * _row(table + 1))


## The table of any widths, for use in a [LobeMaterial3D]; [code]null[/code], and an error, if the
## set is incomplete or [param alpha] is not positive.
## [br][br]
## Tables are interpolated in the logarithms of the widths. Equal widths give an isotropic table.
## Widths below the first or above the last of [member widths] are taken for these, each by itself,
## and are so in the result's [member LobeTable.alpha]. A first width smaller than the second gives
## the table of the exchanged widths, seen from the other axis.
func table_at(alpha: Vector2) -> LobeTable:
	var problem := get_problem()
	if problem.is_empty() and not (alpha.x > 0.0 and alpha.y > 0.0 and alpha.is_finite()):
		problem = "alpha must be positive, not %s." % alpha
	if problem:
		push_error("LobeTableSet.table_at: " + problem)
		return null
	var used := alpha.clampf(widths[0], widths[-1])
	var table := LobeTable.new()
	table.brdf = brdf
	table.alpha = used
	table.lobe_count = lobe_count
	table.method = "interpolated"
	table.seed = seed
	if is_equal_approx(used.x, used.y):
		table.views = Vector2i(views.x, 1)
		table.image = _blend(_isotropic_shares(used.x), table.views, false)
	else:
		table.views = views
		var shares := _pair_shares(maxf(used.x, used.y), minf(used.x, used.y))
		table.image = _blend(shares, views, used.x < used.y)
	# Otherwise random, as in from_baked().
	table.resource_scene_unique_id = "table"
	table.image.resource_scene_unique_id = "lobes"
	return table


func _get_widths_problem() -> String:
	if widths.size() < 2 or widths.size() > MAX_WIDTHS:
		return "A set has 2 to %d widths, this one has %d." % [MAX_WIDTHS, widths.size()]
	for i in widths.size():
		if not (is_finite(widths[i]) and widths[i] > (widths[i - 1] if i > 0 else 0.0)):
			return "A set's widths are positive and rise, but number %d is %s." % [i, widths[i]]
	return ""


func _get_image_problem() -> String:
	if image == null or image.is_empty():
		return "The set has no image."
	var expected := Vector2i(views.x, _row(get_table_count()))
	if image.get_format() != Image.FORMAT_RGBAH or image.get_size() != expected:
		return (
			"A set of %d widths, %d lobes and %d x %d views has an image of %d x %d texels in RGBAH."
			% [widths.size(), lobe_count, views.x, views.y, expected.x, expected.y]
		)
	return ""


func _pair_count() -> int:
	@warning_ignore("integer_division")
	return widths.size() * (widths.size() + 1) / 2


# The number of the anisotropic table of two of the widths, x ≥ y.
func _pair(x: int, y: int) -> int:
	@warning_ignore("integer_division")
	return x * (x + 1) / 2 + y


# The first row of a table in the image.
func _row(table: int) -> int:
	var pairs := mini(table, _pair_count())
	return lobe_count * (pairs * views.y + (table - pairs))


# Where a width lies among the set's: the lower one's number plus the way to the next.
func _level(width: float) -> float:
	var low := clampi(widths.bsearch(width, false) - 1, 0, widths.size() - 2)
	var way := log(width / widths[low]) / log(widths[low + 1] / widths[low])
	# A Vector2 holds single precision: what cannot be told from a width of the set is that width.
	return low + clampf(snappedf(way, 1e-5) if absf(way - roundf(way)) < 1e-5 else way, 0.0, 1.0)


# Shares of tables by their numbers.
func _isotropic_shares(width: float) -> Dictionary[int, float]:
	var level := _level(width)
	var low := mini(floori(level), widths.size() - 2)
	var first := _pair_count() + low
	return {first: 1.0 - (level - low), first + 1: level - low}


func _pair_shares(wide: float, narrow: float) -> Dictionary[int, float]:
	var last := widths.size() - 2
	var x := mini(floori(_level(wide)), last)
	var y := mini(floori(_level(narrow)), last)
	var u := _level(wide) - x
	var v := _level(narrow) - y
	if x == y:
		# The corner beyond the diagonal is the other axis' table, whose lobes are not these.
		return {_pair(x, x): 1.0 - u, _pair(x + 1, x): u - v, _pair(x + 1, x + 1): v}
	return {
		_pair(x, y): (1.0 - u) * (1.0 - v),
		_pair(x + 1, y): u * (1.0 - v),
		_pair(x, y + 1): (1.0 - u) * v,
		_pair(x + 1, y + 1): u * v,
	}


# The image of a table: the sum of the tables with these shares. Exchanged axes swap the slopes and
# count azimuths from the other end.
func _blend(shares: Dictionary[int, float], grid: Vector2i, exchange: bool) -> Image:
	var rows := lobe_count * grid.y
	var sum := PackedFloat32Array()
	sum.resize(4 * grid.x * rows)
	for table: int in shares:
		var share := shares[table]
		if share <= 0.0:
			continue
		var part := image.get_region(Rect2i(0, _row(table), grid.x, rows))
		part.convert(Image.FORMAT_RGBAF)
		var values := part.get_data().to_float32_array()
		for i in values.size():
			sum[i] += share * values[i]
	if exchange:
		sum = _exchange_axes(sum, grid)
	var result := Image.create_from_data(
		grid.x, rows, false, Image.FORMAT_RGBAF, sum.to_byte_array()
	)
	result.convert(Image.FORMAT_RGBAH)
	return result


func _exchange_axes(texels: PackedFloat32Array, grid: Vector2i) -> PackedFloat32Array:
	var exchanged := PackedFloat32Array()
	for lobe in lobe_count:
		for p in grid.y:
			var first := 4 * grid.x * (lobe * grid.y + grid.y - 1 - p)
			exchanged.append_array(texels.slice(first, first + 4 * grid.x))
	for i in range(0, exchanged.size(), 4):
		var slope_x := exchanged[i]
		exchanged[i] = exchanged[i + 1]
		exchanged[i + 1] = slope_x
	return exchanged
