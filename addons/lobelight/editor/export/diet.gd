@tool
extends RefCounted
## What an export takes along of the addon's ready tables, and why.

const Reach := preload("reach.gd")
const SetCut := preload("set_cut.gd")

const NAMED_USERS := 3
const RUN_TIME := "res://addons/lobelight/runtime"


## What becomes of one set.
class Share:
	extends RefCounted
	var path := ""
	var before := 0
	var after := 0
	## The file to be exported in place of the set, where that is not the set itself.
	var bytes := PackedByteArray()
	var why := ""

	func is_left_out() -> bool:
		return after == 0

	func describe() -> String:
		var what := "left out" if is_left_out() else "%d bytes" % after
		return "%s: %d bytes, %s: %s" % [path.get_file(), before, what, why]


## By the sets' paths.
var shares: Dictionary[String, Share] = {}
var material_count := 0


## What the files that are exported need.
static func of_files(files: PackedStringArray) -> RefCounted:
	var diet := new()
	var reach := Reach.of_files(files)
	diet.material_count = reach.material_count
	for name in DirAccess.get_files_at(Reach.TABLES):
		if name.get_extension() == "res":
			var path := Reach.TABLES + name
			diet.shares[path] = _share_of(path, reach.sets.get(path))
	return diet


static func _share_of(path: String, reach: Reach.SetReach) -> Share:
	var share := Share.new()
	share.path = path
	share.before = FileAccess.get_file_as_bytes(path).size()
	if reach == null:
		share.why = "nothing uses it"
		return share
	share.after = share.before
	var users := ", ".join(reach.needed_by.slice(0, NAMED_USERS))
	if reach.needed_by.size() > NAMED_USERS:
		users += " and %d more" % (reach.needed_by.size() - NAMED_USERS)
	if reach.whole_because:
		share.why = "all widths, for %s; %s" % [users, reach.whole_because]
		return share
	var whole: LobeTableSet = load(path)
	var part := SetCut.cut(whole, reach.low, reach.high)
	share.why = (
		"%d of %d widths, for alpha %.4f to %.4f in %s"
		% [part.widths.size(), whole.widths.size(), reach.low, reach.high, users]
	)
	if part != whole:
		share.bytes = _file_bytes(part)
		# Where it could not be written, the whole set goes along.
		share.after = share.before if share.bytes.is_empty() else share.bytes.size()
	return share


# As the engine saves it.
static func _file_bytes(resource: Resource) -> PackedByteArray:
	var file := OS.get_temp_dir().path_join("lobelight_%d.res" % OS.get_process_id())
	var error := ResourceSaver.save(resource, file, ResourceSaver.FLAG_COMPRESS)
	if error != OK:
		push_error("%s: cannot be written (%s)." % [file, error_string(error)])
		return PackedByteArray()
	var bytes := FileAccess.get_file_as_bytes(file)
	DirAccess.remove_absolute(file)
	return bytes


## One line for each set, and the sum.
func describe() -> PackedStringArray:
	var lines: PackedStringArray = []
	for share: Share in shares.values():
		lines.append(share.describe())
	var report := to_dictionary()
	lines.append(
		(
			"Lobelight, %d materials: %d bytes before, %d after, %d of them the run time"
			% [material_count, report["before"], report["after"], report["run_time"]]
		)
	)
	return lines


## The same as numbers. The run time counts as its sources, which exports may compile.
func to_dictionary() -> Dictionary:
	var tables: Array[Dictionary] = []
	var run_time := _size_below(RUN_TIME)
	var before := run_time
	var after := run_time
	for share: Share in shares.values():
		before += share.before
		after += share.after
		(
			tables
			. append(
				{
					"path": share.path,
					"before": share.before,
					"after": share.after,
					"why": share.why,
				}
			)
		)
	return {
		"materials": material_count,
		"before": before,
		"after": after,
		"run_time": run_time,
		"tables": tables,
	}


static func _size_below(folder: String) -> int:
	var size := 0
	for name in DirAccess.get_files_at(folder):
		if name.get_extension() in ["gd", "gdshader", "gdshaderinc"]:
			size += FileAccess.get_file_as_bytes(folder.path_join(name)).size()
	for name in DirAccess.get_directories_at(folder):
		size += _size_below(folder.path_join(name))
	return size
