@tool
extends EditorInspectorPlugin
## A button in the inspector of a [LobeMaterial3D] with a normal map: it bakes the map's
## [member LobeBaseMaterial3D.normal_variance_texture], in one undo step.

var _undo: EditorUndoRedoManager


func _init(undo: EditorUndoRedoManager) -> void:
	_undo = undo


func _can_handle(object: Object) -> bool:
	return object is LobeMaterial3D


func _parse_property(
	object: Object,
	_type: Variant.Type,
	name: String,
	_hint_type: PropertyHint,
	_hint_string: String,
	_usage_flags: int,
	_wide: bool
) -> bool:
	var material := object as LobeMaterial3D
	if name == "normal_variance_texture" and material.normal_texture != null:
		var button := Button.new()
		button.text = "Bake Normal Variance"
		button.tooltip_text = "Makes Normal Variance Texture from the image of Normal Texture."
		button.pressed.connect(bake.bind(material))
		add_custom_control(button)
	return false


## Gives the material the variance of its normal map; stored with the material, unless it is saved
## in a file of its own.
func bake(material: LobeMaterial3D) -> void:
	var texture := LobeMaterial3D.bake_normal_variance(material.normal_texture.get_image())
	if texture == null:
		return
	_undo.create_action("Bake Normal Variance", UndoRedo.MERGE_DISABLE, material)
	_undo.add_do_property(material, &"normal_variance_texture", texture)
	_undo.add_undo_property(material, &"normal_variance_texture", material.normal_variance_texture)
	_undo.commit_action()
