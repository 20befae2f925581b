@tool
@icon("../../icons/lobe_table.svg")
class_name LobeTableSet
extends Resource
## Lobe tables of one BRDF for all widths.
##
## [method table_at] interpolates a [LobeTable] for any pair of widths, without the editor's library
## and without a fit: [code]material.table = set.table_at(Vector2(0.1, 0.3))[/code]. What comes out
## costs at run time what any table of its lobes does.
## [br][br]
## A set holds one anisotropic table for every pair of [member widths] whose first is not the
## smaller, and one isotropic table for every width. Sets with one azimuth in [member views] hold
## the latter only: the sheen of cloth has one width. [code]res://addons/lobelight/tables[/code] has
## ready sets; [code]./dev bake-tables[/code] makes them, and sets of other BRDFs and lobe counts.

## The most [member widths].
const MAX_WIDTHS := 64

const SavedForm := preload("saved_form.gd")
const WidthsTexture := preload("widths_texture.gd")

# Shared tables' widths are rounded to this part of an octave, 0.27 %.
const _SHARED_STEPS := 256.0

## The name of the BRDF that was fitted.
@export var brdf := "":
	set(value):
		brdf = value
		_invalidate()
## The widths on each axis, rising.
@export var widths := PackedFloat64Array():
	set(value):
		widths = value
		_invalidate()
## Lobes per view.
@export var lobe_count := 0:
	set(value):
		lobe_count = value
		_invalidate()
## Views of an anisotropic table's grid: elevations, azimuths. Isotropic tables have one azimuth,
## and a set with one has these only.
@export var views := Vector2i.ZERO:
	set(value):
		views = value
		_invalidate()
## The seed of the fit.
@warning_ignore("shadowed_global_identifier") @export var seed := 0:
	set(value):
		seed = value
		_invalidate()
## The tables' images (see [member LobeTable.image]) one below the other: the anisotropic tables,
## that of widths x and y, x ≥ y, counted from 0, being number [code]x * (x + 1) / 2 + y[/code],
## then the isotropic tables of all widths.
@export var image: Image:
	set(value):
		image = value
		_invalidate()
## The format of the file; it is written in the newest one. A newer file than this version of
## Lobelight knows is not used, see [method get_problem].
@export_storage var format := 1:
	get:
		return _saved.format
	set(value):
		_saved.format = value
		_invalidate()
## The checksum of all the above, which files have from format 2 on; 0 for none. It is that of the
## set as it is now, but for damaged sets, which keep that of their file.
@export_storage var checksum := 0:
	get:
		return _saved.expected if _saved.expected != 0 else _find_checksum()
	set(value):
		_saved.expected = value
		_invalidate()

var _saved := SavedForm.new()
# Tables in use, by their rounded widths, and textures, by whether they are isotropic.
var _shared: Dictionary[Vector2i, WeakRef] = {}
var _textures: Dictionary[bool, WeakRef] = {}
var _mutex := Mutex.new()
# The result of the last check of the properties, and whether it is still valid.
var _problem := ""
var _is_checked := false


## A set from a result of [LobeBaker]; [code]null[/code], and an error, if it is none.
static func from_baked(result: Dictionary) -> LobeTableSet:
	var baked := LobeTable.image_of_baked(result, "LobeTableSet.from_baked", "widths")
	if baked == null:
		return null
	var tables := LobeTableSet.new()
	tables.brdf = result["brdf"]
	tables.widths = PackedFloat64Array(result["widths"] as Array)
	tables.lobe_count = result["lobes"]
	tables.views = Vector2i(result["views"])
	tables.seed = result.get("seed", 0)
	tables.image = baked
	# Otherwise random: equal sets are to be saved as equal bytes.
	tables.resource_scene_unique_id = "set"
	var problem := tables.get_problem()
	if problem:
		push_error("LobeTableSet.from_baked: " + problem)
		return null
	return tables


# What is loaded in place of this may be a file that says nothing of itself, and it leaves out what
# is as by default.
func _reset_state() -> void:
	_saved = SavedForm.new()
	brdf = ""
	widths = PackedFloat64Array()
	lobe_count = 0
	views = Vector2i.ZERO
	seed = 0
	image = null


## What keeps the set from being used, in a sentence; empty if nothing does.
func get_problem() -> String:
	_mutex.lock()
	if not _is_checked:
		_problem = _find_problem()
		_is_checked = true
	var problem := _problem
	_mutex.unlock()
	return problem


## Why the file that the set was loaded from cannot be used, in a sentence: its format is too new,
## or it is damaged. Empty if it can.
func get_file_problem() -> String:
	return _saved.get_problem("set")


func _find_problem() -> String:
	var problem := get_file_problem()
	if problem:
		return problem
	if lobe_count < 1 or lobe_count > LobeTable.MAX_LOBES:
		return "A set has 1 to %d lobes, this one has %d." % [LobeTable.MAX_LOBES, lobe_count]
	if views.x < 2 or views.y < 1:
		return (
			"A set has at least 2 elevations and 1 azimuth, this one has %d and %d."
			% [views.x, views.y]
		)
	problem = _get_widths_problem()
	if problem.is_empty():
		problem = _get_image_problem()
	return problem


## How many anisotropic tables the set holds.
func get_pair_count() -> int:
	if is_isotropic():
		return 0
	@warning_ignore("integer_division")
	return widths.size() * (widths.size() + 1) / 2


## Whether the set holds isotropic tables only.
func is_isotropic() -> bool:
	return views.y == 1


## How many tables the set holds.
func get_table_count() -> int:
	return get_pair_count() + widths.size()


## The bytes of one table's texels, tables being counted as [member image] has them.
func get_table_data(table: int) -> PackedByteArray:
	var bytes := 8 * views.x
	return image.get_data().slice(bytes * _row(table), bytes * _row(table + 1))


## The table of any widths, for use in a [LobeMaterial3D]; [code]null[/code], and an error, if the
## set is incomplete or [param alpha] is not positive.
## [br][br]
## Tables are interpolated in the logarithms of the widths. Equal widths give an isotropic table,
## and sets of isotropic tables give that of the geometric mean of the widths.
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
	var used := _find_used(alpha)
	var table := LobeTable.new()
	table.brdf = brdf
	table.alpha = used
	table.lobe_count = lobe_count
	table.method = "interpolated"
	table.seed = seed
	table.views = Vector2i(views.x, 1) if is_equal_approx(used.x, used.y) else views
	var is_exchanged := table.views == views and used.x < used.y
	table.image = _blend(get_shares(alpha), table.views, is_exchanged)
	# Otherwise random, as in from_baked().
	table.resource_scene_unique_id = "table"
	table.image.resource_scene_unique_id = "lobes"
	return table


## What [method table_at] mixes for widths: tables, counted as [member image] has them, and the
## share of each. The widths must be positive and the set complete.
func get_shares(alpha: Vector2) -> Dictionary[int, float]:
	var used := _find_used(alpha)
	if is_equal_approx(used.x, used.y):
		return _isotropic_shares(used.x)
	return _pair_shares(maxf(used.x, used.y), minf(used.x, used.y))


## As [method table_at], but one table for all who ask for the same widths while somebody holds it.
## Widths are rounded to 0.27 %.
func shared_table_at(alpha: Vector2) -> LobeTable:
	var used := _find_used(alpha)
	var steps := Vector2(log(used.x), log(used.y)) * (_SHARED_STEPS / log(2.0))
	var key := Vector2i(steps.round())
	_mutex.lock()
	var table: LobeTable = _shared[key].get_ref() if _shared.has(key) else null
	if table == null:
		for other: Vector2i in _shared.keys():
			if _shared[other].get_ref() == null:
				_shared.erase(other)
		var rounded := Vector2(key) * (log(2.0) / _SHARED_STEPS)
		table = table_at(Vector2(exp(rounded.x), exp(rounded.y)))
		_shared[key] = weakref(table)
	_mutex.unlock()
	return table


## All tables as one texture; see [LobeMaterial3D]'s textures of roughness and anisotropy.
func get_widths_texture(isotropic: bool) -> WidthsTexture:
	_mutex.lock()
	var texture: WidthsTexture
	if _textures.has(isotropic):
		texture = _textures[isotropic].get_ref()
	if texture == null:
		texture = WidthsTexture.make(widths, lobe_count, _get_images(isotropic), isotropic)
		_textures[isotropic] = weakref(texture)
	_mutex.unlock()
	return texture


# Widths within the set's.
func _find_used(alpha: Vector2) -> Vector2:
	if is_isotropic():
		alpha = Vector2.ONE * sqrt(alpha.x * alpha.y)
	return alpha.clampf(widths[0], widths[-1])


# As WidthsTexture takes them.
func _get_images(isotropic: bool) -> Array[Image]:
	var images: Array[Image] = []
	for number in widths.size():
		if isotropic:
			images.append(get_isotropic_image(number))
			continue
		for narrow in widths.size() - number:
			images.append(get_pair_image(narrow + number, narrow))
	return images


## The isotropic table of one of [member widths], counted from 0.
func get_isotropic_image(width: int) -> Image:
	return _get_table_image(get_pair_count() + width)


## The anisotropic table of two of [member widths], counted from 0, the first not the smaller.
func get_pair_image(wide: int, narrow: int) -> Image:
	return _get_table_image(_pair(wide, narrow))


func _get_table_image(table: int) -> Image:
	return image.get_region(Rect2i(0, _row(table), views.x, _row(table + 1) - _row(table)))


func _invalidate() -> void:
	_mutex.lock()
	_is_checked = false
	_shared.clear()
	_textures.clear()
	_mutex.unlock()
	_follow_change()


func _follow_change() -> void:
	_saved.settle(_find_checksum, image)
	emit_changed()


func _find_checksum() -> int:
	return SavedForm.find_checksum([brdf, widths, lobe_count, views, seed], image)


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


# The number of the anisotropic table of two of the widths, x ≥ y.
func _pair(x: int, y: int) -> int:
	@warning_ignore("integer_division")
	return x * (x + 1) / 2 + y


# The first row of a table in the image.
func _row(table: int) -> int:
	var pairs := mini(table, get_pair_count())
	return lobe_count * (pairs * views.y + (table - pairs))


# Where a width lies among the set's: the lower one's number plus the way to the next.
func _level(width: float) -> float:
	var low := clampi(widths.bsearch(width, false) - 1, 0, widths.size() - 2)
	var way := log(width / widths[low]) / log(widths[low + 1] / widths[low])
	# A Vector2 has single precision: a number that rounds to a width of the set is that width.
	return low + clampf(snappedf(way, 1e-5) if absf(way - roundf(way)) < 1e-5 else way, 0.0, 1.0)


# Shares of tables by their numbers.
func _isotropic_shares(width: float) -> Dictionary[int, float]:
	var level := _level(width)
	var low := mini(floori(level), widths.size() - 2)
	var first := get_pair_count() + low
	return {first: 1.0 - (level - low), first + 1: level - low}


# The tables whose two widths are equally many levels apart form a row: in a row the ratio of the
# widths is the same. Two rows are mixed and, in each, the two neighbours between which the mean of
# the two levels lies. The shader does the same, see shaders/widths.gdshaderinc.
func _pair_shares(wide: float, narrow: float) -> Dictionary[int, float]:
	var last := widths.size() - 1
	var x := _level(wide)
	var y := _level(narrow)
	var first := mini(floori(x - y), last - 1)
	var way := x - y - first
	var shares: Dictionary[int, float] = {}
	for apart: int in [first, first + 1]:
		var row_share := way if apart > first else 1.0 - way
		var place := clampf(0.5 * (x + y - apart), 0.0, last - apart)
		var low := maxi(mini(floori(place), last - apart - 1), 0)
		shares[_pair(low + apart, low)] = row_share * (1.0 - (place - low))
		if place > low:
			shares[_pair(low + 1 + apart, low + 1)] = row_share * (place - low)
	return shares


# The image of a table: the sum of the tables with these shares. Exchanged axes swap the slopes and
# count azimuths from the other end.
func _blend(shares: Dictionary[int, float], grid: Vector2i, exchange: bool) -> Image:
	var rows := lobe_count * grid.y
	var sum := PackedVector4Array()
	for table: int in shares:
		var share := shares[table]
		if share <= 0.0:
			continue
		var part := _get_table_image(table)
		part.convert(Image.FORMAT_RGBAF)
		var texels := part.get_data().to_vector4_array()
		if sum.is_empty():
			sum.resize(texels.size())
		for i in texels.size():
			sum[i] += share * texels[i]
	if exchange:
		sum = _exchange_axes(sum, grid)
	var result := Image.create_from_data(
		grid.x, lobe_count * grid.y, false, Image.FORMAT_RGBAF, sum.to_byte_array()
	)
	result.convert(Image.FORMAT_RGBAH)
	return result


func _exchange_axes(texels: PackedVector4Array, grid: Vector2i) -> PackedVector4Array:
	var exchanged := PackedVector4Array()
	for lobe in lobe_count:
		for p in grid.y:
			var first := grid.x * (lobe * grid.y + grid.y - 1 - p)
			exchanged.append_array(texels.slice(first, first + grid.x))
	for i in exchanged.size():
		var texel := exchanged[i]
		exchanged[i] = Vector4(texel.y, texel.x, texel.z, texel.w)
	return exchanged
