class_name AtomicFile
extends RefCounted
## Saves files under a temporary name and renames them, so that a failed run never leaves half a
## file and never harms the one that was there. Each function returns "" or one sentence.


static func save_json(value: Variant, path: String) -> String:
	var temporary := path + ".tmp"
	var file := FileAccess.open(temporary, FileAccess.WRITE)
	if file == null:
		return "%s: cannot be written (%s)." % [path, error_string(FileAccess.get_open_error())]
	file.store_string(JSON.stringify(value, "  ", false, true) + "\n")
	var failure := file.get_error()
	file.close()
	return _rename(temporary, path, failure)


static func save_resource(resource: Resource, path: String) -> String:
	# The saver chooses the format by the ending.
	var temporary := path.get_basename() + ".tmp." + path.get_extension()
	return _rename(
		temporary, path, ResourceSaver.save(resource, temporary, ResourceSaver.FLAG_COMPRESS)
	)


static func _rename(temporary: String, path: String, failure: Error) -> String:
	if failure == OK:
		failure = DirAccess.rename_absolute(temporary, path)
	if failure == OK:
		return ""
	DirAccess.remove_absolute(temporary)
	return "%s: cannot be written (%s)." % [path, error_string(failure)]
