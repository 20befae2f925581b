@tool
extends RefCounted
## The files of scenes that a conversion changes, all or none of them.

const SceneFile := preload("scene_file.gd")

var files: Array[SceneFile] = []


## Looks into the files, and into those of the instances in them.
static func open(
	paths: PackedStringArray, to_lobes: bool, locked: Dictionary[String, String] = {}
) -> RefCounted:
	var opened := new()
	var waiting := Array(paths)
	var seen: Dictionary[String, bool] = {}
	while not waiting.is_empty():
		var path: String = waiting.pop_front()
		if seen.has(path):
			continue
		seen[path] = true
		var file := SceneFile.new(path, to_lobes, locked)
		if file.plan == null:
			continue
		waiting.append_array(file.plan.files)
		if not file.plan.changes.is_empty():
			opened.files.append(file)
	return opened


## Writes the files; a sentence if that fails, and all of them are as they were.
func save() -> String:
	# Scenes are packed as differences to those in them: before any of these changes.
	var problem := ""
	for file in files:
		if problem.is_empty():
			problem = file.prepare()
	var count := 0
	while problem.is_empty() and count < files.size():
		problem = files[count].save()
		count += 1
	if problem:
		for index in count:
			files[index].switch(false)
	for file in files:
		file.release()
	return problem


## Has the files, and what is open of them, as they are after the conversion or before it.
func switch(is_converted: bool) -> void:
	for file in files:
		file.switch(is_converted)
	for file in files:
		for root in EditorInterface.get_open_scene_roots():
			file.refresh(root, is_converted)
		EditorInterface.get_resource_filesystem().update_file(file.path)
