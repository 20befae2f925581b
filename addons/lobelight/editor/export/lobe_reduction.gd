@tool
extends RefCounted
## The fewest lobes that hold a target error, for each material of an export.
##
## A material whose widths nothing changes draws one table of its set. [LobeBaker] fits tables of
## fewer lobes to the same BRDF until one reaches the target on a synthetic environment and on the
## project's panoramas, and the material goes along with a set that has this table only. Where the
## set's own count is needed, or the target is out of reach for it, the set stays.

const FileBytes := preload("file_bytes.gd")
const ImportProgress := preload("../import/import_progress.gd")
const Job := preload("../bake/bake_job.gd")
const MeasuredImporter := preload("../import/measured_importer.gd")
const Recipe := preload("../bake/bake_recipe.gd")
const ProjectFiles := preload("project_files.gd")
const ReducedTable := preload("reduced_table.gd")
const TableChoice := preload("../../runtime/material/table_choice.gd")
const Widths := preload("../../runtime/table/widths.gd")

## Metadata of a material: true says that no script or animation changes its widths.
const FIXED := &"lobelight_fixed"
const EDITABLE_SCENES: PackedStringArray = ["tscn", "scn"]
## Endings of the panoramas that [LobeBaker] reads.
const PANORAMAS: PackedStringArray = ["hdr", "exr"]
## Results of earlier exports, by what was asked for.
const CACHE := "res://.godot/lobelight/lobes/"
# Of the cache: to be raised with the fit.
const _VERSION := 1


## A bake for a given count at most, on any number of panoramas.
class FewestLobes:
	extends Recipe
	var views := Vector2i.ZERO
	var most := 1
	var panoramas: PackedStringArray = []

	func _init() -> void:
		lobes = AUTOMATIC

	func to_request() -> Dictionary:
		var request := super()
		request["views"] = views
		request["max_lobes"] = most
		request["environments"] = Array(panoramas)
		return request


## In dB, as [LobeBaker] takes it; 0 leaves all materials as they are.
var target := 0.0
## The panoramas to be right in, besides the synthetic environment.
var panoramas: PackedStringArray = []
## Why no material of the project can have fewer lobes, or empty.
var why_none := ""
## By what a material draws: the table it gets.
var tables: Dictionary[String, ReducedTable] = {}
## By what materials draw, or the materials' file: why the lobes stay.
var kept: Dictionary[String, String] = {}
## Files with materials that get reduced tables.
var files: Dictionary[String, bool] = {}

var _is_cancelled := false


func add_panorama(texture: Texture2D) -> void:
	if texture != null and texture.resource_path.get_extension() in PANORAMAS:
		if texture.resource_path not in panoramas:
			panoramas.append(texture.resource_path)


## Whether a material gets fewer lobes, which it may take a while to find out. [param file] is where
## it was found first.
func reduce(file: String, material: LobeMaterial3D) -> bool:
	if target <= 0.0:
		return false
	var home := material.resource_path.get_slice("::", 0)
	if home.is_empty():
		home = file
	var tables_of := _get_set(material)
	var problem := "" if _is_fixed(material) else why_none
	if problem.is_empty() and tables_of == null:
		problem = "a table or a texture of its own or a script says what is drawn"
	if problem.is_empty() and not can_edit(home):
		problem = "imported files are exported as they are"
	if problem:
		kept[home] = problem
		return false
	var table := get_table(tables_of, material)
	var key := _key(tables_of, table)
	if not tables.has(key) and not kept.has(key):
		_find(key, tables_of, table)
	if not tables.has(key):
		return false
	tables[key].add_user(home)
	files[home] = true
	return true


## Gives the materials in a resource, a scene for instance, their reduced tables. Returns whether
## any got one. Resources with files of their own are left to these.
func edit(resource: Resource) -> bool:
	return not tables.is_empty() and _edit(resource, {})


## For each reduced table and for what keeps its lobes, a line.
func describe() -> PackedStringArray:
	var lines: PackedStringArray = []
	for table: ReducedTable in tables.values():
		lines.append("%s: %s" % [table.get_path().get_file(), table.get_reason()])
	for key in kept:
		lines.append("%s: lobes stay: %s" % [key, kept[key]])
	return lines


## The reduced tables as numbers.
func to_dictionaries() -> Array[Dictionary]:
	var list: Array[Dictionary] = []
	for table: ReducedTable in tables.values():
		list.append(table.to_dictionary())
	return list


func _edit(value: Variant, seen: Dictionary[int, bool]) -> bool:
	var is_changed := false
	if value is Array or value is Dictionary:
		for part: Variant in value if value is Array else (value as Dictionary).values():
			is_changed = _edit(part, seen) or is_changed
		return is_changed
	var resource := value as Resource if value is Object else null
	if resource == null or seen.has(resource.get_instance_id()) or resource is Script:
		return false
	var has_own_file := resource.resource_path and not resource.resource_path.contains("::")
	if has_own_file and not seen.is_empty():
		return false
	seen[resource.get_instance_id()] = true
	if resource is LobeMaterial3D:
		is_changed = _give(resource)
	if resource is PackedScene:
		var state := (resource as PackedScene).get_state()
		for node in state.get_node_count():
			for property in state.get_node_property_count(node):
				is_changed = (
					_edit(state.get_node_property_value(node, property), seen) or is_changed
				)
		return is_changed
	for property in resource.get_property_list():
		if property["usage"] & PROPERTY_USAGE_STORAGE:
			is_changed = _edit(resource.get(property["name"]), seen) or is_changed
	return is_changed


# Whether nothing changes the widths while the game runs.
func _is_fixed(material: LobeMaterial3D) -> bool:
	return why_none.is_empty() or material.get_meta(FIXED, false)


func _give(material: LobeMaterial3D) -> bool:
	var tables_of := _get_set(material)
	if tables_of == null or not _is_fixed(material):
		return false
	var key := _key(tables_of, get_table(tables_of, material))
	if not tables.has(key):
		return false
	material.table_set = tables[key].set_of_one
	# Long widths would be drawn by more lobes, without a table.
	material.quality = LobeBaseMaterial3D.Quality.LOBES_8
	return true


## Whether a file's materials can be exchanged.
static func can_edit(file: String) -> bool:
	var endings := ProjectFiles.RESOURCES + EDITABLE_SCENES
	return file.get_extension() in endings and not FileAccess.file_exists(file + ".import")


# The set that a material draws one table of; null if it draws something else.
static func _get_set(material: LobeMaterial3D) -> LobeTableSet:
	if material.get_script() != LobeMaterial3D or material.table != null:
		return null
	if material.varies():
		return null
	var found := material.table_set
	if found == null and ResourceLoader.exists(TableChoice.DEFAULT_SET):
		found = load(TableChoice.DEFAULT_SET)
	if found == null or not found.get_problem().is_empty() or found.brdf not in Recipe.MODELS:
		return null
	return found


## The table that a material draws, wide widths first.
static func get_table(tables_of: LobeTableSet, material: LobeMaterial3D) -> LobeTable:
	var widths := Widths.from_roughness(material.roughness, material.get_shown_anisotropy())
	# Tables of exchanged widths are the same seen from the other axis.
	return tables_of.shared_table_at(Vector2(maxf(widths.x, widths.y), minf(widths.x, widths.y)))


static func _key(tables_of: LobeTableSet, table: LobeTable) -> String:
	return (
		"%s, alpha %s × %s, %d lobes"
		% [
			tables_of.brdf,
			# Finer than sets round widths.
			String.num(table.alpha.x, 8),
			String.num(table.alpha.y, 8),
			tables_of.lobe_count,
		]
	)


func _find(key: String, tables_of: LobeTableSet, table: LobeTable) -> void:
	if _is_cancelled:
		kept[key] = "cancelled"
		return
	if tables_of.lobe_count == 1:
		kept[key] = "it is one"
		return
	var recipe := FewestLobes.new()
	recipe.brdf = tables_of.brdf
	recipe.alpha = table.alpha
	recipe.views = table.views
	recipe.target = target
	recipe.most = tables_of.lobe_count - 1
	recipe.panoramas = panoramas
	var result := _bake(recipe, key)
	if result.has("error"):
		kept[key] = result["error"]
		return
	tables[key] = ReducedTable.of(LobeTable.from_baked(result), tables_of)
	tables[key].psnr = result["predicted_psnr"]


# A result of LobeBaker, from the cache if it is there.
func _bake(recipe: FewestLobes, title: String) -> Dictionary:
	var file := CACHE + _identify(recipe) + ".bin"
	if FileAccess.file_exists(file):
		var cached: Variant = bytes_to_var(FileAccess.get_file_as_bytes(file))
		if cached is Dictionary:
			return cached
	var job := Job.new(null, recipe)
	var progress := ImportProgress.new("Fewer lobes for %s" % title, "Export")
	var result := MeasuredImporter.bake(job, progress)
	if progress.is_cancelled:
		_is_cancelled = true
		return {"error": "cancelled"}
	if result.is_empty():
		return {"error": job.error}
	DirAccess.make_dir_recursive_absolute(CACHE)
	FileBytes.write(file, var_to_bytes(result))
	return result


static func _identify(recipe: FewestLobes) -> String:
	var request := recipe.to_request()
	request["version"] = _VERSION
	request["contents"] = []
	for panorama in recipe.panoramas:
		request["contents"].append(FileAccess.get_md5(panorama))
	return var_to_str(request).md5_text()
