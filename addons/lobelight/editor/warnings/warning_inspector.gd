@tool
extends EditorInspectorPlugin
## Warnings at the top of the inspectors of [LobeMaterial3D], [LobeEnvironment3D] and [LobeProbe3D],
## and below an environment's, spheres in its light.

const EnvironmentPreview := preload("../preview/environment_preview.gd")
const ProbeWarnings := preload("../../runtime/warnings/probe_warnings.gd")
const SceneWarnings := preload("scene_warnings.gd")
const WarningList := preload("warning_list.gd")


func _can_handle(object: Object) -> bool:
	return object is LobeMaterial3D or object is LobeEnvironment3D or object is LobeProbe3D


func _parse_begin(object: Object) -> void:
	var material := object as LobeMaterial3D
	if material != null:
		add_custom_control(WarningList.new(find_of_material.bind(material)))
		return
	var probe := object as LobeProbe3D
	if probe != null:
		add_custom_control(WarningList.new(find_of_probe.bind(probe)))
		return
	var environment := object as LobeEnvironment3D
	add_custom_control(WarningList.new(find_of_environment.bind(environment)))
	add_custom_control(EnvironmentPreview.new())


static func find_of_material(material: LobeMaterial3D) -> PackedStringArray:
	return SceneWarnings.of_material(material, EditorInterface.get_edited_scene_root())


static func find_of_environment(environment: LobeEnvironment3D) -> PackedStringArray:
	if not is_instance_valid(environment):
		return []
	return SceneWarnings.of_environment(environment, EditorInterface.get_edited_scene_root())


static func find_of_probe(probe: LobeProbe3D) -> PackedStringArray:
	return ProbeWarnings.of(probe) if is_instance_valid(probe) else PackedStringArray()
