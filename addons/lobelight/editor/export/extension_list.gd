@tool
extends RefCounted
## The project's list of extensions, without some of them for a while.
##
## The engine copies the list into the export and drops from it only what the preset's filters
## exclude: of a .gdextension that an export plugin skips, the line stays, and the game reports at
## every start that it cannot be loaded. So the list lacks the line while the engine exports. The
## editor writes it anew when it scans the project and misses an extension, so that a crash in
## between does no harm.

const NAME := "extension_list.cfg"

var _whole := PackedByteArray()
var _is_changed := false


## Writes the list without the extensions below a folder, until [method restore].
func leave_out(folder: String) -> void:
	restore()
	var path := _get_path()
	if not FileAccess.file_exists(path):
		return
	_whole = FileAccess.get_file_as_bytes(path)
	var kept: PackedStringArray = []
	for line in _whole.get_string_from_utf8().split("\n", false):
		if not line.strip_edges().begins_with(folder):
			kept.append(line + "\n")
	_is_changed = _write("".join(kept).to_utf8_buffer())


## Puts the list back as it was.
func restore() -> void:
	if _is_changed:
		_is_changed = not _write(_whole)


# Beside the list and then in its place, so that it is whole at any time.
func _write(bytes: PackedByteArray) -> bool:
	var path := _get_path()
	var part := path + ".lobelight"
	var file := FileAccess.open(part, FileAccess.WRITE)
	if file == null or not file.store_buffer(bytes):
		push_error("%s cannot be written: %s." % [part, error_string(FileAccess.get_open_error())])
		return false
	file.close()
	var error := DirAccess.rename_absolute(part, path)
	if error != OK:
		push_error("%s cannot be written: %s." % [path, error_string(error)])
	return error == OK


static func _get_path() -> String:
	var hidden := "application/config/use_hidden_project_data_directory"
	var folder := "res://.godot" if ProjectSettings.get_setting(hidden, true) else "res://godot"
	return folder.path_join(NAME)
