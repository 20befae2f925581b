@tool
extends ShaderMaterial
## A [LobeMaterial3D] that nothing changes, as exports store it: the text of its shader, and its
## parameters as numbers and textures. The scripts that make these from a material's properties are
## then not exported.

const LightRegistry := preload("../light/light_registry.gd")

## What the shader takes, by name. Not as [ShaderMaterial]'s own parameters, which the engine looks
## for in the shader first.
@export_storage var parameters: Dictionary[StringName, Variant] = {}:
	set(value):
		parameters = value
		for name in parameters:
			var given: Variant = parameters[name]
			if given is Texture:
				given = (given as Texture).get_rid()
			RenderingServer.material_set_param(_rid, name, given)
## What it is drawn with in lights that have [member LobeLight.sources]; [code]null[/code] where
## none of the export may have any.
@export_storage var shader_for_sources: Shader
## The narrowest width of its lobes, see [method LobeLight.apply].
@export_storage var width := 0.0:
	set(value):
		width = value
		LightRegistry.set_width(_rid, width)
## As [member LobeMaterial3D.light].
@export_storage var light: LobeLight:
	set(value):
		light = value
		LightRegistry.set_own_light(_rid, light)

# Kept, because the object is no longer whole when it is told of its end.
var _rid := get_rid()


func _init() -> void:
	LightRegistry.add_material(_rid, _choose_shader)
	# When both have been set.
	_choose_shader.call_deferred()


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE:
		LightRegistry.remove_material(_rid)


# All lights of the export take the same shader, but for their sources.
func _choose_shader() -> void:
	if shader_for_sources == null:
		return
	var has_sources := "SOURCES" in LightRegistry.get_defines(_rid)
	var chosen := shader_for_sources if has_sources else shader
	RenderingServer.material_set_shader(_rid, chosen.get_rid())
