@tool
extends RefCounted
## What is to be changed in a scene so that its nodes are drawn with converted materials. Nothing is
## changed by looking.
##
## Scenes are saved without what has been changed in instances of others, unless these have Editable
## Children. So each material is converted in one of two places: in the scene, whose instances
## become editable for it, or, where that is wished, in the file of the instance that has it. Files
## that are imported cannot be changed: what they bring is converted in the scene around.

const Converter := preload("material_converter.gd")
const Slot := preload("material_slot.gd")
const Slots := preload("material_slots.gd")

## Files of scenes that can be changed.
const SCENE_FILES: PackedStringArray = ["tscn", "scn"]

## The root of the scene.
var root: Node
var converter: Converter
## What is changed, with the values before and after.
var changes: Array[Slot] = []
## The instances that become editable, outer ones first.
var instances: Array[Node] = []
## The files of scenes in which the rest is to be converted.
var files: PackedStringArray = []
## What stays as it is or is to be looked at: paths of the nodes by the reason.
var left: Dictionary[String, Array] = {}
## How many nodes have changes in files of their own.
var nodes_in_files := 0

# The same as instances, to be looked up.
var _chosen: Dictionary[Node, bool] = {}
# Files that are not to be changed, and why, in words.
var _locked: Dictionary[String, String] = {}
var _in_files := false
# A scene file's nodes as they are without the scene around them.
var _references: Dictionary[String, Node] = {}


## Looks at [param nodes] of the scene of [param scene] and all below them. Files with a reason in
## [param locked] stay as they are.
static func make(
	nodes: Array[Node],
	scene: Node,
	to_lobes := true,
	in_files := false,
	locked: Dictionary[String, String] = {}
) -> RefCounted:
	var plan := new()
	plan.root = scene
	plan.converter = Converter.new(to_lobes)
	plan._in_files = in_files
	plan._locked = locked
	var seen: Dictionary[Node, bool] = {}
	for node in nodes:
		plan._look_below(node, seen)
	for reference: Node in plan._references.values():
		if reference != null:
			reference.free()
	plan._references.clear()
	return plan


## Whether there is nothing to be done.
func is_empty() -> bool:
	return changes.is_empty() and files.is_empty()


## The nodes whose changes are made in the scene itself.
func get_nodes() -> Array[Node]:
	var nodes: Array[Node] = []
	for change in changes:
		if nodes.is_empty() or nodes.back() != change.node:
			nodes.append(change.node)
	return nodes


## The instances that a node is in below [param scene], outer ones first.
static func find_owners(node: Node, scene: Node) -> Array[Node]:
	var owners: Array[Node] = []
	var next := node.owner if node != scene else null
	while next != null and next != scene:
		owners.push_front(next)
		next = next.owner
	return owners


## Whether what is changed of a node can be saved with the scene of [param scene]: not if a script
## has added it.
static func is_saved(node: Node, scene: Node) -> bool:
	var owners := find_owners(node, scene)
	var outermost := node if owners.is_empty() else owners[0]
	return node == scene or outermost.owner == scene


func _look_below(node: Node, seen: Dictionary[Node, bool]) -> void:
	if seen.has(node):
		return
	seen[node] = true
	_look_at(node)
	for child in node.get_children():
		_look_below(child, seen)


func _look_at(node: Node) -> void:
	if converter.to_lobes:
		for reason in Slots.find_others(node):
			_leave(node, reason)
	var is_in_file := false
	for slot in Slots.of(node):
		for material in slot.materials:
			var reason := "" if converter.can_convert(material) else converter.find_reason(material)
			if reason:
				_leave(node, "%s: %s" % [name_of(material), reason])
		if not slot.materials.any(converter.can_convert):
			continue
		if slot.problem:
			_leave(node, slot.problem)
		elif not is_saved(node, root):
			_leave(node, "a script has added it: it is in no file")
		else:
			var file := _choose_file(slot) if _in_files else ""
			if file.is_empty():
				_change(slot)
			else:
				is_in_file = true
				if file not in files:
					files.append(file)
	nodes_in_files += int(is_in_file)


func _change(slot: Slot) -> void:
	slot.look_up(converter)
	changes.append(slot)
	for instance in find_owners(slot.node, root):
		if not _chosen.has(instance) and not root.is_editable_instance(instance):
			_chosen[instance] = true
			instances.append(instance)


# The file in which a material is to be converted: the innermost one that has it; empty if that is
# the scene itself.
func _choose_file(slot: Slot) -> String:
	var instance := slot.node
	if instance.scene_file_path.is_empty():
		instance = instance.owner
	while instance != null and instance != root and slot.node != root:
		if _has_alike(slot, instance):
			var file := instance.scene_file_path
			var reason := find_lock(file)
			if reason.is_empty():
				return file
			_leave(instance, "%s: %s" % [file, reason])
		instance = instance.owner
	return ""


## Why a scene's file cannot be changed, in words; empty if it can.
func find_lock(file: String) -> String:
	if _locked.has(file):
		return _locked[file]
	if (
		file.get_extension().to_lower() not in SCENE_FILES
		or FileAccess.file_exists(file + ".import")
	):
		return "it is imported, so its instances were made editable"
	return ""


# Whether a node has in the file what it has in the scene: what the scene has changed is converted
# there.
func _has_alike(slot: Slot, instance: Node) -> bool:
	var file := instance.scene_file_path
	if not _references.has(file):
		var scene := load(file) as PackedScene
		_references[file] = scene.instantiate() if scene != null else null
	var reference := _references[file]
	var node := reference.get_node_or_null(instance.get_path_to(slot.node)) if reference else null
	if node == null:
		return false
	return Array(slot.sources).all(
		func(property: String) -> bool: return is_same(node.get(property), slot.node.get(property))
	)


func _leave(node: Node, reason: String) -> void:
	var paths: Array = left.get_or_add(reason, [])
	var path := str(root.get_path_to(node))
	# A node is looked at once.
	if paths.is_empty() or paths.back() != path:
		paths.append(path)


## What users know a material by: its name, or its file.
static func name_of(material: Material) -> String:
	if not material.resource_name.is_empty():
		return '"%s"' % material.resource_name
	if not material.resource_path.is_empty():
		return material.resource_path.get_file()
	return "a material without a name"
