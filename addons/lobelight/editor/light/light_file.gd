@tool
extends Object
## Where the baked lights of a scene's probes and environments are kept: files beside the scene,
## named by the scene and the node.

const _EXTENSION := "res"


## Why a node's light cannot be kept with the scene of [param root], in a sentence; empty if it
## can.
static func find_problem(node: Node3D, root: Node) -> String:
	if root == null or node != root and not root.is_ancestor_of(node):
		return "%s is not in the open scene, which its light is to be saved with." % node.name
	var problem := find_problem_of_scene(root)
	if problem:
		return problem
	if not is_saved(node, root):
		return (
			(
				"%s is in an instanced scene: bake it where that scene is open, or turn on Editable "
				+ "Children."
			)
			% node.name
		)
	return ""


## Why no light can be kept with a scene, in a sentence; empty if it can.
static func find_problem_of_scene(root: Node) -> String:
	if root.scene_file_path.is_empty():
		return "Save the scene first: its light is saved in a file beside it."
	return ""


## Whether what is changed of a node is saved with the scene of [param root].
static func is_saved(node: Node, root: Node) -> bool:
	if node == root or node.owner == root:
		return true
	var instance := node.owner
	return instance != null and root.is_editable_instance(instance) and is_saved(instance, root)


## The file for a node's light. It stays the one that the node has, unless that is another scene's
## or another node's: what was copied has a light of its own from then on.
static func choose_path(node: Node3D, root: Node) -> String:
	# Some file systems take capitals and small letters for the same.
	var taken: Dictionary[String, bool] = {}
	for other in find_lit(root):
		if other != node and get_light(other) != null:
			taken[get_light(other).resource_path.to_lower()] = true
	var stem := root.scene_file_path.get_basename()
	var own := "" if get_light(node) == null else get_light(node).resource_path
	var is_beside := own.begins_with(stem + ".") and own.get_extension() == _EXTENSION
	if is_beside and not taken.has(own.to_lower()):
		return own
	var names := PackedStringArray([root.name])
	if node != root:
		names = _get_names(root.get_path_to(node))
	var name := "_".join(names).validate_filename()
	var path := "%s.%s.%s" % [stem, name, _EXTENSION]
	var number := 2
	while taken.has(path.to_lower()):
		path = "%s.%s_%d.%s" % [stem, name, number, _EXTENSION]
		number += 1
	return path


## Whether a node can have a baked light: a probe or an environment.
static func is_lit(object: Object) -> bool:
	return object is LobeProbe3D or object is LobeEnvironment3D


## The baked light of such a node, or [code]null[/code].
static func get_light(node: Node3D) -> LobeLight:
	return node.get(&"light")


## Bytes of what a light shows, with all levels.
static func count_bytes(light: LobeLight) -> int:
	var bytes := 0
	for face in light.faces:
		bytes += face.get_data_size()
	return bytes + (count_bytes(light.coarse) if light.coarse != null else 0)


## The probes and environments among a node and all below it.
static func find_lit(root: Node) -> Array[Node3D]:
	var found: Array[Node3D] = []
	if root == null:
		return found
	var nodes := root.find_children("*", "Node3D", true, false)
	nodes.push_front(root)
	found.assign(nodes.filter(is_lit))
	return found


## The probes among these.
static func find_probes(root: Node) -> Array[LobeProbe3D]:
	var found: Array[LobeProbe3D] = []
	found.assign(find_lit(root).filter(func(node: Node3D) -> bool: return node is LobeProbe3D))
	return found


## Saves a light; why it could not be done, in a sentence, and empty if it was. A file that was
## there is replaced whole or not at all, and keeps its UID.
static func write(light: LobeLight, path: String) -> String:
	var files := EditorInterface.get_resource_filesystem()
	var temporary := path.get_base_dir().path_join("." + path.get_file())
	var uid := ResourceUID.INVALID_ID
	if FileAccess.file_exists(path):
		uid = ResourceLoader.get_resource_uid(path)
	light.seal()
	var error := ResourceSaver.save(light, temporary, ResourceSaver.FLAG_COMPRESS)
	if error == OK and uid != ResourceUID.INVALID_ID:
		error = ResourceSaver.set_uid(temporary, uid)
	if error == OK:
		error = DirAccess.rename_absolute(temporary, path)
	if FileAccess.file_exists(temporary):
		DirAccess.remove_absolute(temporary)
	# The editor lists what is saved, and is to forget this one.
	files.update_file(temporary)
	if error != OK:
		return "%s cannot be written: %s." % [path, error_string(error).to_lower()]
	light.take_over_path(path)
	files.update_file(path)
	return ""


static func _get_names(path: NodePath) -> PackedStringArray:
	var names: PackedStringArray = []
	for index in path.get_name_count():
		names.append(path.get_name(index))
	return names
