@tool
class_name VisualShaderNodeLobelightReflection
extends "light_node.gd"
## What a metal of the lobes of GGX, or of the material's set, reflects to the viewer: the node
## [i]Lobelight Reflection[/i] of visual shaders.
##
## The function [code]lobelight_reflection()[/code] of
## [code]res://addons/lobelight/lobelight.gdshaderinc[/code]. The light is that of a
## [LobeShaderMaterial], or of a material that was handed to [method LobeLight.bind].


func _get_name() -> String:
	return "Lobelight Reflection"


func _get_description() -> String:
	return (
		"The reflections of the LobeEnvironment3D and the LobeProbe3Ds around the pixel, in a"
		+ " LobeShaderMaterial.\nf0: reflectance at normal incidence, linear: a metal's colour,"
		+ " by way of Lobelight Linear if it is that of a parameter or a texture.\nradiance: linear,"
		+ " to compute with. emission: what goes to the output of that name."
	)


func _list_inputs() -> Array[Port]:
	var inputs := _list_surface_inputs()
	inputs.append(Port.colour("f0", 0.9))
	return inputs


func _get_code(
	inputs: Array[String], outputs: Array[String], _mode: Shader.Mode, _type: VisualShader.Type
) -> String:
	var light := "lobelight_reflection(LOBELIGHT_PIXEL, %s)" % ", ".join(_complete(inputs))
	return _write(light, _mark(inputs), outputs)
