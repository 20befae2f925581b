@tool
extends EditorInspectorPlugin
## At the top of the inspectors of [LobeProbe3D] and [LobeEnvironment3D]: where the light comes
## from, and the bake.

const LightBakes := preload("light_bakes.gd")
const LightFile := preload("light_file.gd")
const LightPanel := preload("light_panel.gd")

var _bakes: LightBakes


func _init(bakes: LightBakes = null) -> void:
	_bakes = bakes


func _can_handle(object: Object) -> bool:
	return LightFile.is_lit(object)


func _parse_begin(object: Object) -> void:
	add_custom_control(LightPanel.make(_bakes, object as Node3D))
