@tool
class_name VisualShaderNodeLobelightLinear
extends "light_node.gd"
## The colour of a parameter or a texture as linear colour in all renderers: the node
## [i]Lobelight Linear[/i] of visual shaders. Compatibility hands such colours out as sRGB.
##
## The function [code]lobelight_linear()[/code] of
## [code]res://addons/lobelight/lobelight.gdshaderinc[/code].


func _get_name() -> String:
	return "Lobelight Linear"


func _get_description() -> String:
	return (
		"The colour of a parameter, or of a texture that is one of colours, as linear colour:"
		+ " Compatibility hands it out as sRGB. What is typed is linear."
	)


func _list_inputs() -> Array[Port]:
	return [Port.colour("colour", 1.0)]


func _list_outputs() -> PackedStringArray:
	return ["linear"]


func _get_code(
	inputs: Array[String], outputs: Array[String], _mode: Shader.Mode, _type: VisualShader.Type
) -> String:
	if not _is_connected(inputs[0]):
		return "%s = %s;" % [outputs[0], inputs[0] if inputs[0] else "vec3(1.0)"]
	return "%s = lobelight_linear(%s);" % [outputs[0], inputs[0]]
