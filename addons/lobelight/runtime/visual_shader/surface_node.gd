@tool
class_name VisualShaderNodeLobelightSurface
extends "light_node.gd"
## All that a [LobeMaterial3D] of these properties sends to the viewer: the node
## [i]Lobelight Surface[/i] of visual shaders.
##
## The function [code]lobelight_surface()[/code] of
## [code]res://addons/lobelight/lobelight.gdshaderinc[/code]. The light is that of a
## [LobeShaderMaterial], or of a material that was handed to [method LobeLight.bind].

const _ALBEDO := 4


func _get_name() -> String:
	return "Lobelight Surface"


func _get_description() -> String:
	return (
		"What a LobeMaterial3D of these properties shows, in a LobeShaderMaterial.\nalbedo: as the"
		+ " output of that name takes it where it is connected, linear where it is typed.\nradiance:"
		+ " linear, to compute with. emission: what goes to the output of that name; that for albedo"
		+ " gets black."
	)


func _list_inputs() -> Array[Port]:
	var inputs := _list_surface_inputs()
	inputs.append(Port.colour("albedo", 1.0))
	inputs.append(Port.number("metallic", 0.0))
	inputs.append(Port.number("specular", 0.5))
	return inputs


func _get_code(
	inputs: Array[String], outputs: Array[String], _mode: Shader.Mode, _type: VisualShader.Type
) -> String:
	var complete := _complete(inputs)
	if _is_connected(inputs[_ALBEDO]):
		complete[_ALBEDO] = "lobelight_linear(%s)" % complete[_ALBEDO]
	var light := "lobelight_surface(LOBELIGHT_PIXEL, %s)" % ", ".join(complete)
	return _write(light, _mark(inputs), outputs)
