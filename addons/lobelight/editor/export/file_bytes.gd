@tool
extends RefCounted
## Files as bytes: resources as the engine would save them, and writing in one step.


## A resource as a file's bytes; empty, and an error, if it cannot be saved. The ending says in
## which format; [param named] is given the paths of the other files that it needs.
static func of(resource: Resource, ending: String, named: Array[String] = []) -> PackedByteArray:
	var name := "lobelight_%d.%s" % [OS.get_process_id(), ending]
	var file := OS.get_temp_dir().path_join(name)
	var error := ResourceSaver.save(resource, file, ResourceSaver.FLAG_COMPRESS)
	if error != OK:
		push_error("%s: cannot be written (%s)." % [file, error_string(error)])
		return PackedByteArray()
	var bytes := FileAccess.get_file_as_bytes(file)
	for dependency in ResourceLoader.get_dependencies(file):
		# uid::type::path, or a path alone.
		named.append(dependency.get_slice("::", 2) if "::" in dependency else dependency)
	DirAccess.remove_absolute(file)
	return bytes


## Writes a file, or leaves the one that is there as it is and returns false.
static func write(path: String, bytes: PackedByteArray) -> bool:
	var part := path + ".part"
	var file := FileAccess.open(part, FileAccess.WRITE)
	if file == null or not file.store_buffer(bytes):
		return false
	file.close()
	return DirAccess.rename_absolute(part, path) == OK
