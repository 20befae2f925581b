@tool
class_name VisualShaderNodeLobelightDiffuse
extends "light_node.gd"
## The light that arrives about a normal, irradiance over pi: the node [i]Lobelight Diffuse[/i] of
## visual shaders.
##
## The function [code]lobelight_diffuse()[/code] of
## [code]res://addons/lobelight/lobelight.gdshaderinc[/code]. The light is that of a
## [LobeShaderMaterial], or of a material that was handed to [method LobeLight.bind].


func _get_name() -> String:
	return "Lobelight Diffuse"


func _get_description() -> String:
	return (
		"The light that arrives at the pixel from around its normal, in a LobeShaderMaterial.\nlight:"
		+ " irradiance over pi, linear: times the diffuse colour it is what a matt surface sends out."
		+ "\nemission: the same for white, what goes to the output of that name."
	)


func _list_inputs() -> Array[Port]:
	return [Port.vector("normal", PIXELS_NORMAL)]


func _list_outputs() -> PackedStringArray:
	return ["light", "emission"]


func _get_code(
	inputs: Array[String], outputs: Array[String], _mode: Shader.Mode, _type: VisualShader.Type
) -> String:
	var light := "lobelight_diffuse(LOBELIGHT_PIXEL, %s)" % _complete(inputs)[NORMAL]
	return _write(light, "", outputs)
