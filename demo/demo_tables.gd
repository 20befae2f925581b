## The sets of tables that the demo draws: a ready one, and what `./dev demo` fits besides.

const READY := "res://addons/lobelight/tables/ggx_8.res"
const FOLDER := "res://demo/build/tables"
const LOBE_COUNTS: PackedInt32Array = [4, 8, 16]
const THESIS := FOLDER + "/thesis_8.res"


## The file of the set with a number of lobes for each view.
static func path_of(lobe_count: int) -> String:
	return READY if lobe_count == 8 else "%s/ggx_%d.res" % [FOLDER, lobe_count]


## The set with a number of lobes; [code]null[/code] if it has not been made.
static func set_of(lobe_count: int) -> LobeTableSet:
	return _load(path_of(lobe_count))


## The set of the thesis' method; [code]null[/code] if it has not been made.
static func thesis_set() -> LobeTableSet:
	return _load(THESIS)


static func _load(path: String) -> LobeTableSet:
	return load(path) as LobeTableSet if ResourceLoader.exists(path) else null
