@tool
@icon("../../icons/lobe_material_3d.svg")
class_name LobeShaderMaterial
extends ShaderMaterial
## A [ShaderMaterial] that is lit as [LobeMaterial3D]s are, with a shader of your own.
##
## Its shader includes [code]res://addons/lobelight/lobelight.gdshaderinc[/code], which describes
## the functions, or is a [VisualShader] with a node [i]Lobelight[/i]. The light is that of the
## [LobeEnvironment3D] of the world and of the [LobeProbe3D]s around each pixel, in the editor too.
## For materials of another class there is [method LobeLight.bind].

## The lobes that the shader draws; without a set, those of GGX.
@export var table_set: LobeTableSet:
	set(value):
		table_set = value
		_bind()
		emit_changed()

## A light that the material shows wherever it is, as [member LobeMaterial3D.light].
@export var light: LobeLight:
	set(value):
		light = value
		_bind()
		emit_changed()


func _init() -> void:
	_bind()


func _bind() -> void:
	LobeLight.bind(self, table_set, light)
