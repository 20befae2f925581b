@tool
extends ShaderMaterial
## A [LobeMaterial3D] that nothing changes, as exports have it: its shader is written out, its
## parameters are numbers and textures. What makes both of a material's properties stays behind.

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
	LightRegistry.add_material(_rid, _keep_variant)


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE:
		LightRegistry.remove_material(_rid)


# All lights of the export take the same shader.
func _keep_variant() -> void:
	pass
