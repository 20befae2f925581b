class_name ResultCache
extends RefCounted
## Keeps what native workers computed, below build/: pictures by several renderers are compared with
## one reference, and tables are fitted once for all of them. Anything that could change a result is
## part of its file's name.

const FOLDER := "res://build/results"
const LIBRARY_FOLDER := "res://addons/lobelight/bin"


## The result of the worker [param native_class] for [param options], as [method NativeLibrary.run]
## gives it, computed only if it is not kept yet. To be awaited.
static func run(
	native_class: StringName, options: Dictionary, label: String, tree: SceneTree
) -> Dictionary:
	var file := FOLDER.path_join(_key(native_class, options) + ".bin")
	var kept := FileAccess.open_compressed(file, FileAccess.READ)
	if kept != null:
		var value: Variant = kept.get_var()
		if value is Dictionary:
			return value
	var worker := NativeLibrary.create(native_class)
	var result := await NativeLibrary.run(worker, options, label, tree)
	if not result.has("error"):
		_keep(result, file)
	return result


static func _key(native_class: StringName, options: Dictionary) -> String:
	var parts: Array = [native_class, options]
	# Maps, walls and measured BRDFs.
	for option: String in options:
		var value: Variant = options[option]
		for one: Variant in value if value is Array else [value]:
			if one is String and FileAccess.file_exists(one as String):
				parts.append(FileAccess.get_md5(one as String))
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
