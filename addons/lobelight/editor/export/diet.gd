@tool
extends RefCounted
## What an export takes along of the addon's ready tables and of its run time, and why.

const CodeFiles := preload("code_files.gd")
const EnvironmentFit := preload("environment_fit.gd")
const FileBytes := preload("file_bytes.gd")
const FrozenMaterials := preload("frozen_materials.gd")
const LobeReduction := preload("lobe_reduction.gd")
const PanoramaFit := preload("panorama_fit.gd")
const Reach := preload("reach.gd")
const SetCut := preload("set_cut.gd")
const SetReach := preload("set_reach.gd")
const Wording := preload("../wording.gd")

## Where exports have the files that stand in for others.
const EDITED := LobeReduction.ReducedTable.FOLDER
const NAMED_USERS := 3


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
var code: CodeFiles
var fit: EnvironmentFit
var panoramas := PanoramaFit.new()
var lobes: LobeReduction
var frozen: FrozenMaterials
var material_count := 0

# Whether what was loaded last is not as its file.
var _is_edited := false


## What the files that are exported need. With a [param target], in dB, materials get the fewest
## lobes that reach it, which takes a while. Environments and their panoramas are resized unless
## [param fits] is false, and materials that nothing changes are frozen unless [param freezes] is.
static func of_files(
	files: PackedStringArray, target := 0.0, fits := true, freezes := true
) -> RefCounted:
	var diet := new()
	var reach := Reach.of_files(files, target)
	diet.material_count = reach.material_count
	diet.lobes = reach.lobes
	diet.fit = EnvironmentFit.of(reach.features.environments, reach.sets, reach.own_tables)
	if fits:
		diet.panoramas = PanoramaFit.of(files, reach.features, diet.fit)
	else:
		diet.fit.size = 0
		diet.fit.why = "the preset says so"
	diet.frozen = reach.frozen
	if not freezes:
		diet.frozen.why_not = "the preset says so"
	reach.features.look_at_settings()
	diet.frozen.freeze(reach.features, diet._load_edited)
	var sets: Dictionary[String, SetReach] = reach.sets
	if diet.frozen.is_frozen():
		sets = reach.sets_of_others
	diet.code = CodeFiles.of_files(files, reach.features, diet.frozen.dependencies)
	for name in DirAccess.get_files_at(Reach.TABLES):
		if name.get_extension() == "res":
			var path := Reach.TABLES + name
			diet.shares[path] = _share_of(path, sets.get(path))
	return diet


static func _share_of(path: String, reach: SetReach) -> Share:
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
	# A file that materials refuse goes along as it is, and is refused there too.
	if not whole.get_problem().is_empty():
		share.why = whole.get_problem()
		return share
	var cut := SetCut.of(whole, reach)
	var ends := reach.get_range()
	share.why = (
		"%d of %d tables, for alpha %.4f to %.4f in %s"
		% [cut.table_count, whole.get_table_count(), ends.x, ends.y, users]
	)
	if reach.isotropic_because:
		share.why += "; all isotropic ones, because %s" % reach.isotropic_because
	if cut.part != whole:
		share.bytes = FileBytes.of(cut.part, "res")
		# Where it could not be written, the whole set goes along.
		share.after = share.before if share.bytes.is_empty() else share.bytes.size()
	return share


## The files of what several others use, by their paths in the export.
func get_shared_files() -> Dictionary[String, PackedByteArray]:
	if frozen.is_frozen():
		return frozen.shaders
	var shared: Dictionary[String, PackedByteArray] = {}
	for reduced: LobeReduction.ReducedTable in lobes.tables.values():
		shared[reduced.get_path()] = reduced.get_bytes()
	return shared


## What is exported in place of a scene or a resource; empty if it goes along as it is.
func edit(path: String) -> PackedByteArray:
	if frozen.files.has(path):
		return frozen.files[path]
	var has_environment := fit.has_environment(path) or panoramas.scenes.has(path)
	if not lobes.files.has(path) and not has_environment:
		return PackedByteArray()
	var resource := _load_edited(path)
	if not _is_edited:
		return PackedByteArray()
	return FileBytes.of(resource, "scn" if resource is PackedScene else "res")


func _load_edited(path: String) -> Resource:
	var resource := ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE)
	_is_edited = lobes.edit(resource)
	var packed := resource as PackedScene
	if packed != null and fit.has_environment(path):
		_is_edited = fit.edit(packed) or _is_edited
	if packed != null and panoramas.scenes.has(path):
		_is_edited = panoramas.edit(packed) or _is_edited
	return resource


## One line for each set and for each file that is left out or empty, and the sum.
func describe() -> PackedStringArray:
	var lines: PackedStringArray = []
	for share: Share in shares.values():
		lines.append(share.describe())
	lines.append_array(lobes.describe())
	for path in code.files:
		var file := code.files[path]
		if file.after < file.before and not file.why.begins_with("without"):
			lines.append(
				"%s: %d bytes, %d: %s" % [path.get_file(), file.before, file.after, file.why]
			)
	lines.append(frozen.describe())
	lines.append(fit.describe())
	lines.append_array(panoramas.describe())
	var report := to_dictionary()
	var materials := Wording.count(material_count, "material")
	lines.append(
		(
			"Lobelight, %s: %d bytes before, %d after, %d of them the run time"
			% [materials, report["before"], report["after"], report["run_time"]]
		)
	)
	return lines


## The same as numbers, and all files. The run time counts as sources, which exports may compile.
func to_dictionary() -> Dictionary:
	var tables: Array[Dictionary] = []
	var before := code.get_size_before()
	var after := code.get_size_after()
	for path in shares:
		var share := shares[path]
		before += share.before
		after += share.after
		tables.append(_entry(path, share.before, share.after, share.why))
	var run_time := code.get_size_after() + frozen.get_shader_size()
	after += frozen.get_shader_size()
	for reduced: LobeReduction.ReducedTable in lobes.tables.values():
		# Frozen materials have their tables with them.
		var size := 0 if frozen.is_frozen() else reduced.get_bytes().size()
		after += size
		tables.append(_entry(reduced.get_path(), 0, size, reduced.get_reason()))
	var files: Array[Dictionary] = []
	for path in code.files:
		var file := code.files[path]
		files.append(_entry(path, file.before, file.after, file.why))
	var pictures: Array[Dictionary] = []
	for share: PanoramaFit.Share in panoramas.shares.values():
		pictures.append(_entry(share.path, share.before, share.after, share.why))
	return {
		"materials": material_count,
		"before": before,
		"after": after,
		"run_time": run_time,
		"frozen": frozen.is_frozen(),
		"frozen_why_not": frozen.why_not,
		"environment_size": fit.size,
		"environment_size_why": fit.why,
		"panoramas": pictures,
		"lobes": lobes.to_dictionaries(),
		"lobes_kept": lobes.kept,
		"tables": tables,
		"files": files,
	}


static func _entry(path: String, before: int, after: int, why: String) -> Dictionary:
	return {"path": path, "before": before, "after": after, "why": why}
