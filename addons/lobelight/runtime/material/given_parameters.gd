@tool
extends Object
## Hands parameters of materials to the rendering server, and tells who asks which they are.

static var _heard: Dictionary[StringName, Variant] = {}
static var _listened := RID()


static func give(material: RID, name: StringName, value: Variant) -> void:
	RenderingServer.material_set_param(material, name, value)
	if material == _listened:
		_heard[name] = value


## What a material is given while [param act] is called, by the parameters' names.
static func hear(material: RID, act: Callable) -> Dictionary[StringName, Variant]:
	_heard = {}
	_listened = material
	act.call()
	_listened = RID()
	return _heard
