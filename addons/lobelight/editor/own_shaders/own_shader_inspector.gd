@tool
extends EditorInspectorPlugin
## The inspector of materials with shaders of one's own: what they lack, a first shader for a
## [LobeShaderMaterial] without one, and none of the parameters that the light is handed on in.

const OwnShaderWarnings := preload("own_shader_warnings.gd")
const WarningList := preload("../warnings/warning_list.gd")

const _HIDDEN := "shader_parameter/lobelight_"
const _FIRST := """shader_type spatial;
render_mode ambient_light_disabled;
#include "res://addons/lobelight/lobelight.gdshaderinc"

uniform vec3 colour : source_color = vec3(0.9, 0.9, 0.9);
uniform float metallic : hint_range(0.0, 1.0) = 1.0;
uniform float roughness : hint_range(0.0, 1.0) = 0.3;
uniform float anisotropy : hint_range(-1.0, 1.0) = 0.0;

void fragment() {
	LobelightPixel pixel = LOBELIGHT_PIXEL;
	vec3 albedo = lobelight_linear(colour);
	EMISSION = lobelight_emission(
			lobelight_surface(pixel, NORMAL, TANGENT, roughness, anisotropy, albedo, metallic, 0.5));
	// What the engine's lamps light.
	ALBEDO = colour;
	METALLIC = metallic;
	ROUGHNESS = roughness;
}
"""

var _undo: EditorUndoRedoManager


func _init(undo: EditorUndoRedoManager) -> void:
	_undo = undo


func _can_handle(object: Object) -> bool:
	return object is ShaderMaterial and not object is LobeMaterial3D


func _parse_begin(object: Object) -> void:
	var material := object as ShaderMaterial
	add_custom_control(WarningList.new(OwnShaderWarnings.of.bind(material)))
	if material is LobeShaderMaterial and material.shader == null:
		var button := Button.new()
		button.text = "Create Shader"
		button.tooltip_text = "A shader of a few lines that shows what a LobeMaterial3D does."
		button.pressed.connect(create_shader.bind(material))
		add_custom_control(button)


func _parse_property(
	_object: Object,
	_type: Variant.Type,
	name: String,
	_hint_type: PropertyHint,
	_hint_string: String,
	_usage_flags: int,
	_wide: bool
) -> bool:
	return name.begins_with(_HIDDEN)


## Gives the material a shader to begin with, in one undo step.
func create_shader(material: LobeShaderMaterial) -> void:
	var shader := Shader.new()
	shader.code = _FIRST
	_undo.create_action("Create Shader", UndoRedo.MERGE_DISABLE, material)
	_undo.add_do_property(material, &"shader", shader)
	_undo.add_undo_property(material, &"shader", null)
	_undo.commit_action()
