class_name ReferenceCache
extends RefCounted
## Keeps what LobeReference computed, below build/, so that pictures by several renderers are
## compared with one reference. Anything that could change the result is part of a file's name.

const FOLDER := "res://build/references"
const LIBRARY_FOLDER := "res://addons/lobelight/bin"


## The result of [param options], computed only if it is not kept yet; holds "error" if that failed.
static func render(options: Dictionary, tree: SceneTree) -> Dictionary:
	var file := FOLDER.path_join(_key(options) + ".bin")
	var kept := FileAccess.open_compressed(file, FileAccess.READ)
	if kept != null:
		var value: Variant = kept.get_var()
		if value is Dictionary:
			return value
	var result := await NativeLibrary.run(
		NativeLibrary.create(&"LobeReference"), options, "integrating", tree
	)
	if not result.has("error"):
		_keep(result, file)
	return result


static func _key(options: Dictionary) -> String:
	var parts: Array = [options, FileAccess.get_md5(options["env"])]
	if FileAccess.file_exists(options["brdf"]):
		parts.append(FileAccess.get_md5(options["brdf"]))
	for library in DirAccess.get_files_at(LIBRARY_FOLDER):
		parts.append(FileAccess.get_md5(LIBRARY_FOLDER.path_join(library)))
	return str(parts).md5_text()


# Failing to keep it costs time later, nothing else.
static func _keep(result: Dictionary, path: String) -> void:
	DirAccess.make_dir_recursive_absolute(FOLDER)
	var temporary := "%s.%d.tmp" % [path, OS.get_process_id()]
	var file := FileAccess.open_compressed(temporary, FileAccess.WRITE)
	if file == null:
		return
	file.store_var(result)
	file.close()
	DirAccess.rename_absolute(temporary, path)
