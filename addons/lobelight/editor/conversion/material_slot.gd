@tool
extends RefCounted
## A property of a node that says what the node is drawn with, and what becomes of it.

const Converter := preload("material_converter.gd")

## The node.
var node: Node
## The property that is to change: a material, or a mesh or library with materials in it.
var property := ""
## The materials, in the order of the surfaces; where there is none, null.
var materials: Array[Material] = []
## The properties that the materials come from.
var sources: PackedStringArray = []
## Why this cannot be changed; empty if it can.
var problem := ""
## Whether the property holds a resource with the materials in it, not a material itself.
var is_holder := false
## The values before and after; filled in by the plan.
var before: Variant
var after: Variant


func _init(of_node: Node = null, of_property := "", given: Array = []) -> void:
	node = of_node
	property = of_property
	sources = [of_property]
	materials.assign(given)


## Looks up both values: the one that the node has, and the one that a converter gives.
func look_up(converter: Converter) -> void:
	before = node.get(property)
	after = (
		converter.convert_holder(before) if is_holder else converter.convert_material(materials[0])
	)


## The file of a mesh or library that the change copies into the scene; empty for all else.
func get_copied_file() -> String:
	var resource := before as Resource if is_holder else null
	if resource is MultiMesh and resource.is_built_in():
		resource = (resource as MultiMesh).mesh
	if resource == null or resource.resource_path.is_empty():
		return ""
	return resource.resource_path.get_slice("::", 0)
