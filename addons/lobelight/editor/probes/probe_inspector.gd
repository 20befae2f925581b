@tool
extends EditorInspectorPlugin
## At the top of a [LobeProbe3D]'s inspector: where its light comes from, and the bake.

const LightBakes := preload("light_bakes.gd")
const LightPanel := preload("light_panel.gd")

var _bakes: LightBakes


func _init(bakes: LightBakes = null) -> void:
	_bakes = bakes


func _can_handle(object: Object) -> bool:
	return object is LobeProbe3D


func _parse_begin(object: Object) -> void:
	add_custom_control(LightPanel.make(_bakes, object as LobeProbe3D))
