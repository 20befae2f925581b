@tool
extends RefCounted
## Which files of a project an export is made of, as far as they say what they need of the addon.

const SCENES: PackedStringArray = ["tscn", "scn", "glb", "gltf", "fbx", "blend", "dae"]
const RESOURCES: PackedStringArray = [
	"tres", "res", "material", "mesh", "meshlib", "multimesh", "anim"
]
const SCRIPTS: PackedStringArray = ["gd", "cs"]
const SHADERS: PackedStringArray = ["gdshader", "gdshaderinc"]


## All files of the project that it would load or run, without folders that the engine ignores and
## without those that match [param exclude], a preset's filter.
static func of_project(exclude: String = "") -> PackedStringArray:
	var files: PackedStringArray = []
	_collect("res://", _split(exclude), files)
	return files


## A scene with all that it depends on.
static func of_scene(scene: String) -> PackedStringArray:
	var files: PackedStringArray = [scene]
	var next := 0
	while next < files.size():
		for path in get_dependencies(files[next]):
			if path and path not in files:
				files.append(path)
		next += 1
	return files


## The paths that a file says it depends on.
static func get_dependencies(file: String) -> PackedStringArray:
	var paths: PackedStringArray = []
	for dependency in ResourceLoader.get_dependencies(file):
		# uid::type::path, or a path alone.
		paths.append(dependency.get_slice("::", 2) if "::" in dependency else dependency)
	return paths


## What a preset exports: the project, or where scenes or resources are chosen, these with all that
## they depend on, and so for the main scene, autoloads and what the preset's filter includes. All
## scripts count, because they may be reached by the names of their classes.
static func of_preset(preset: EditorExportPreset) -> PackedStringArray:
	var all := of_project(preset.get_exclude_filter())
	var chosen: PackedStringArray = []
	match preset.get_export_filter():
		EditorExportPreset.EXPORT_SELECTED_SCENES, EditorExportPreset.EXPORT_SELECTED_RESOURCES:
			chosen = preset.get_files_to_export()
		_:
			return all
	var main: String = ProjectSettings.get_setting("application/run/main_scene", "")
	chosen.append(ResourceUID.ensure_path(main))
	for setting in ProjectSettings.get_property_list():
		var name: String = setting["name"]
		if name.begins_with("autoload/"):
			var path: String = ProjectSettings.get_setting(name)
			chosen.append(ResourceUID.ensure_path(path.trim_prefix("*")))
	var included := _split(preset.get_include_filter())
	var found: Dictionary[String, bool] = {}
	for file in all:
		if file.get_extension() in SCRIPTS or _matches(file.trim_prefix("res://"), included):
			chosen.append(file)
	for file in chosen:
		if not found.has(file) and ResourceLoader.exists(file):
			for needed in of_scene(file):
				found[needed] = true
	return PackedStringArray(found.keys())


static func _collect(folder: String, filters: PackedStringArray, files: PackedStringArray) -> void:
	if FileAccess.file_exists(folder.path_join(".gdignore")):
		return
	for name in DirAccess.get_files_at(folder):
		var path := folder.path_join(name)
		if _is_read(path) and not _matches(path.trim_prefix("res://"), filters):
			files.append(path)
	for name in DirAccess.get_directories_at(folder):
		if not name.begins_with("."):
			_collect(folder.path_join(name), filters, files)


static func _is_read(path: String) -> bool:
	var ending := path.get_extension()
	for endings: PackedStringArray in [SCENES, RESOURCES, SCRIPTS, SHADERS]:
		if ending in endings:
			return true
	return false


static func _split(filters: String) -> PackedStringArray:
	var parts: PackedStringArray = []
	for filter in filters.split(",", false):
		parts.append(filter.strip_edges())
	return parts


static func _matches(path: String, filters: PackedStringArray) -> bool:
	for filter in filters:
		if path.matchn(filter):
			return true
	return false
