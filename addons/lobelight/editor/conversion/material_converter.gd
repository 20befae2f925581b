@tool
extends RefCounted
## Makes [LobeMaterial3D]s of Godot's materials, or the other way, each once, with their next
## passes; and copies of meshes, MultiMeshes and libraries that hold them. Nothing that is given is
## changed.

## Whether it converts from Godot's materials or to them.
var to_lobes := true

## What was made of what.
var _made: Dictionary[Material, Material] = {}
var _holders: Dictionary[Resource, Resource] = {}


func _init(converts_to_lobes := true) -> void:
	to_lobes = converts_to_lobes


## Whether the material or one of its next passes would be another then.
func can_convert(material: Material) -> bool:
	while material != null:
		if _is_source(material):
			return true
		material = material.next_pass
	return false


## Whether a mesh has a material that would be another then.
func can_convert_any(mesh: Mesh) -> bool:
	for surface in mesh.get_surface_count():
		if can_convert(mesh.surface_get_material(surface)):
			return true
	return false


## The material to be shown instead: the given one where there is nothing to convert.
func convert_material(material: Material) -> Material:
	if not can_convert(material):
		return material
	if _made.has(material):
		return _made[material]
	var made: Material
	if not _is_source(material):
		made = material.duplicate()
	elif to_lobes:
		made = LobeMaterial3D.from_standard(material as BaseMaterial3D)
	else:
		made = (material as LobeMaterial3D).to_standard()
	_made[material] = made
	made.next_pass = convert_material(material.next_pass)
	made.resource_local_to_scene = material.resource_local_to_scene
	if made.resource_name.is_empty() and not material.is_built_in():
		made.resource_name = material.resource_path.get_file().get_basename()
	for name in material.get_meta_list():
		made.set_meta(name, material.get_meta(name))
	return made


## A copy of a mesh, a [MultiMesh] or a [MeshLibrary] with converted materials.
func convert_holder(holder: Resource) -> Resource:
	if not _holders.has(holder):
		var copy := _copy_instances(holder) if holder is MultiMesh else holder.duplicate()
		_holders[holder] = copy
		if holder is Mesh:
			_fill_mesh(holder as Mesh, copy as Mesh)
		elif holder is MultiMesh:
			(copy as MultiMesh).mesh = convert_holder((holder as MultiMesh).mesh) as Mesh
		elif holder is MeshLibrary:
			_fill_library(holder as MeshLibrary, copy as MeshLibrary)
	return _holders[holder]


## The materials that were made, by what from.
func get_made() -> Dictionary[Material, Material]:
	var made: Dictionary[Material, Material] = {}
	for material in _made:
		if _is_source(material):
			made[material] = _made[material]
	return made


## What a material has that the one made of it lacks, as names of properties.
func get_losses(material: Material) -> PackedStringArray:
	if to_lobes:
		return LobeMaterial3D.get_losses_from(material as BaseMaterial3D)
	return _get_losses_of_lobes(material as LobeMaterial3D)


## Why a material stays as it is, in words; empty where that needs none.
func find_reason(material: Material) -> String:
	if not to_lobes or material == null or material is LobeBaseMaterial3D:
		return ""
	if material is BaseMaterial3D:
		return "it is unshaded: no light changes it"
	return "it is a %s, whose shader is its own" % material.get_class()


# What is unshaded has nothing to be lit.
func _is_source(material: Material) -> bool:
	if not to_lobes:
		return material is LobeMaterial3D
	var source := material as BaseMaterial3D
	return source != null and source.shading_mode != BaseMaterial3D.SHADING_MODE_UNSHADED


# Without a renderer, a MultiMesh has an empty buffer, which it refuses when it is given back.
static func _copy_instances(source: MultiMesh) -> MultiMesh:
	var copy := MultiMesh.new()
	for property in source.get_property_list():
		var value: Variant = source.get(property["name"])
		var is_empty: bool = property["name"] == "buffer" and value.is_empty()
		if property["usage"] & PROPERTY_USAGE_STORAGE and not is_empty:
			copy.set(property["name"], value)
	return copy


func _fill_mesh(mesh: Mesh, copy: Mesh) -> void:
	for surface in mesh.get_surface_count():
		var material := mesh.surface_get_material(surface)
		copy.surface_set_material(surface, convert_material(material))


func _fill_library(library: MeshLibrary, copy: MeshLibrary) -> void:
	for item in library.get_item_list():
		var mesh := library.get_item_mesh(item)
		if mesh != null and can_convert_any(mesh):
			copy.set_item_mesh(item, convert_holder(mesh) as Mesh)


static func _get_losses_of_lobes(material: LobeMaterial3D) -> PackedStringArray:
	var losses: PackedStringArray = []
	var usual := LobeMaterial3D.new()
	for property in material.get_property_list():
		var name: String = property["name"]
		if property["usage"] & PROPERTY_USAGE_SCRIPT_VARIABLE == 0:
			continue
		if property["usage"] & PROPERTY_USAGE_STORAGE == 0 or _has_counterpart(material, name):
			continue
		if material.get(name) != usual.get(name):
			losses.append(name)
	return losses


# An angle becomes a flow map.
static func _has_counterpart(material: LobeMaterial3D, name: String) -> bool:
	if name == "anisotropy_rotation":
		return material.anisotropy_flowmap == null or material.get_shown_anisotropy() == 0.0
	if name == "anisotropy":
		return absf(material.anisotropy) <= 1.0
	return (
		name == "orm_texture"
		or not ClassDB.class_get_property_setter("BaseMaterial3D", name).is_empty()
	)
