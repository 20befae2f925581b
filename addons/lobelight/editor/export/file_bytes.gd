@tool
extends RefCounted
## A resource as the bytes of the file that the engine would save it in.


## Empty, and an error, if it cannot be saved. The ending says in which format.
static func of(resource: Resource, ending: String) -> PackedByteArray:
	var name := "lobelight_%d.%s" % [OS.get_process_id(), ending]
	var file := OS.get_temp_dir().path_join(name)
	var error := ResourceSaver.save(resource, file, ResourceSaver.FLAG_COMPRESS)
	if error != OK:
		push_error("%s: cannot be written (%s)." % [file, error_string(error)])
		return PackedByteArray()
	var bytes := FileAccess.get_file_as_bytes(file)
	DirAccess.remove_absolute(file)
	return bytes
