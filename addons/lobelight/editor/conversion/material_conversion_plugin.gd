@tool
extends EditorResourceConversionPlugin
## "Convert to LobeMaterial3D" in the inspector's menu of a [StandardMaterial3D] or
## [ORMMaterial3D] and in the file system's, and the way back. Next passes go along.

const Converter := preload("material_converter.gd")

## Whether it converts from Godot's materials or to them.
var to_lobes := true


func _init(converts_to_lobes := true) -> void:
	to_lobes = converts_to_lobes


func _converts_to() -> String:
	return "LobeMaterial3D" if to_lobes else "StandardMaterial3D"


func _handles(resource: Resource) -> bool:
	return resource is BaseMaterial3D if to_lobes else resource is LobeMaterial3D


func _convert(resource: Resource) -> Resource:
	if not to_lobes:
		var source := resource as LobeMaterial3D
		var made := source.to_standard()
		made.next_pass = Converter.new(false).convert_material(source.next_pass)
		return made
	return convert_to_lobes(resource as BaseMaterial3D)


## The material, with a warning about what it cannot take over.
static func convert_to_lobes(source: BaseMaterial3D) -> LobeMaterial3D:
	var losses := LobeMaterial3D.get_losses_from(source)
	if not losses.is_empty():
		var name := source.resource_name if source.resource_name else source.resource_path
		push_warning(
			(
				'LobeMaterial3D has no counterpart for these properties of material "%s": %s.'
				% [name, ", ".join(losses)]
			)
		)
	var made := LobeMaterial3D.from_standard(source)
	made.next_pass = Converter.new().convert_material(source.next_pass)
	return made
