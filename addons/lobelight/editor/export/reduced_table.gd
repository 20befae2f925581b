@tool
extends RefCounted
## A table of fewer lobes for one pair of widths, in a set of its own.

const FileBytes := preload("file_bytes.gd")
const SetCut := preload("set_cut.gd")

## Where exports have it, beside the scenes that use it.
const FOLDER := "res://.godot/exported/lobelight/"

var table: LobeTable
## Has [member table] for its widths and is black for others.
var set_of_one: LobeTableSet
## Lobes of the set that it is drawn in place of.
var lobes_before := 0
## What the lobes reach in the environments that were tried, in dB.
var psnr := 0.0
## Files.
var users: PackedStringArray = []


## [param instead_of] is the set whose table it replaces; [param fitted] has its widths, the first
## not the smaller.
static func of(fitted: LobeTable, instead_of: LobeTableSet) -> RefCounted:
	var reduced := new()
	reduced.table = fitted
	reduced.lobes_before = instead_of.lobe_count
	reduced.set_of_one = _make_set(fitted)
	# That of an earlier export may still be there.
	reduced.set_of_one.take_over_path(reduced.get_path())
	return reduced


func add_user(file: String) -> void:
	if file not in users:
		users.append(file)


func get_path() -> String:
	var widths := String.num(table.alpha.x, 8)
	if not table.is_isotropic():
		widths += "_" + String.num(table.alpha.y, 8)
	return FOLDER + "%s_%s_%d.res" % [table.brdf, widths, table.lobe_count]


func get_bytes() -> PackedByteArray:
	return FileBytes.of(set_of_one, "res")


func get_reason() -> String:
	return (
		"%d lobes instead of %d hold %.1f dB, for %s"
		% [table.lobe_count, lobes_before, psnr, ", ".join(users)]
	)


func to_dictionary() -> Dictionary:
	return {
		"brdf": table.brdf,
		"alpha": LobeTable.plain_numbers(table.alpha),
		"lobes_before": lobes_before,
		"lobes": table.lobe_count,
		"psnr": psnr,
		"files": users,
	}


# Of two widths: the table's own, or, as a set has at least two, that of an isotropic table and its
# double. What is drawn is next to the first by less than sets round.
static func _make_set(fitted: LobeTable) -> LobeTableSet:
	var isotropic := fitted.is_isotropic()
	# Sets have anisotropic tables; here they are black, and as small as can be.
	var views := Vector2i(fitted.views.x, 2) if isotropic else fitted.views
	var alpha := fitted.alpha
	var row := 8 * views.x * fitted.lobe_count
	var black_pair := PackedByteArray()
	black_pair.resize(row * views.y)
	var black := PackedByteArray()
	black.resize(row)
	var own := fitted.image.get_data()
	# The pairs (0, 0), (1, 0) and (1, 1), then the isotropic tables.
	var bytes := black_pair + (black_pair if isotropic else own) + black_pair
	bytes += (own if isotropic else black) + black
	return SetCut.make_set(
		fitted.brdf,
		fitted.seed,
		fitted.lobe_count,
		views,
		[alpha.x, 2.0 * alpha.x] if isotropic else [alpha.y, alpha.x],
		bytes
	)
