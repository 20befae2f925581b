@tool
extends EditorImportPlugin
## Base of the importers that read files by the native library: what they tell the engine alike.

const NativeLibrary := preload("../bake/native_library.gd")


func _get_save_extension() -> String:
	return "res"


func _get_import_order() -> int:
	return 0


func _get_preset_count() -> int:
	return 1


func _get_preset_name(_preset: int) -> String:
	return "Default"


func _can_import_threaded() -> bool:
	return false


## A message of the library with the file's path in the project instead of that on the machine.
static func name_by_project(message: String, source: String) -> String:
	return message.replace(ProjectSettings.globalize_path(source), source)
