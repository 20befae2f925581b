@tool
class_name VisualShaderNodeLobelightEmission
extends "light_node.gd"
## What goes to the output [i]Emission[/i] for linear radiance, in all renderers: the node
## [i]Lobelight Emission[/i] of visual shaders, for radiance that was computed with.
##
## The function [code]lobelight_emission()[/code] of
## [code]res://addons/lobelight/lobelight.gdshaderinc[/code].


func _get_name() -> String:
	return "Lobelight Emission"


func _get_description() -> String:
	return (
		"What goes to the output emission for a linear radiance, as those of the other nodes are"
		+ " once they were added or multiplied."
	)


func _list_inputs() -> Array[Port]:
	return [Port.colour("radiance", 0.0)]


func _list_outputs() -> PackedStringArray:
	return ["emission"]


func _get_code(
	inputs: Array[String], outputs: Array[String], _mode: Shader.Mode, _type: VisualShader.Type
) -> String:
	return "%s = lobelight_emission(%s);" % [outputs[0], inputs[0] if inputs[0] else "vec3(0.0)"]
