@tool
extends RefCounted
## A table of fewer lobes for one pair of widths, in a set of its own.

const FileBytes := preload("file_bytes.gd")

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
	var widths := String.num(table.alpha.x, 6)
	if not table.is_isotropic():
		widths += "_" + String.num(table.alpha.y, 6)
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
	var made := LobeTableSet.new()
	made.brdf = fitted.brdf
	made.lobe_count = fitted.lobe_count
	made.seed = fitted.seed
	# Sets have anisotropic tables; here they are black, and as small as can be.
	made.views = Vector2i(fitted.views.x, 2) if isotropic else fitted.views
	var alpha := fitted.alpha
	made.widths = PackedFloat64Array([alpha.x, 2.0 * alpha.x] if isotropic else [alpha.y, alpha.x])
	var row := 8 * made.views.x * made.lobe_count
	var black_pair := PackedByteArray()
	black_pair.resize(row * made.views.y)
	var black := PackedByteArray()
	black.resize(row)
	var own := fitted.image.get_data()
	var bytes := PackedByteArray()
	# The pairs (0, 0), (1, 0) and (1, 1), then the isotropic tables.
	for part in [black_pair, black_pair if isotropic else own, black_pair]:
		bytes.append_array(part)
	bytes.append_array(own if isotropic else black)
	bytes.append_array(black)
	@warning_ignore("integer_division")
	var height := bytes.size() / (8 * made.views.x)
	made.image = Image.create_from_data(made.views.x, height, false, Image.FORMAT_RGBAH, bytes)
	# Otherwise random: equal exports are to have equal bytes.
	made.resource_scene_unique_id = "set"
	made.image.resource_scene_unique_id = "lobes"
	return made
