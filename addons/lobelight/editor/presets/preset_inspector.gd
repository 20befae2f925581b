@tool
extends EditorInspectorPlugin
## A row of looks at the top of a [LobeMaterial3D]'s inspector.

const FormRow := preload("../bake/form_row.gd")
const PresetChoice := preload("preset_choice.gd")

const _TOOLTIP := "Sets colour, metal, roughness, brushing and coat in one step; textures stay."

var _history: EditorUndoRedoManager


func _init(history: EditorUndoRedoManager = null) -> void:
	_history = history


func _can_handle(object: Object) -> bool:
	return object is LobeMaterial3D


func _parse_begin(object: Object) -> void:
	var choice := PresetChoice.make(object as LobeMaterial3D, _history)
	add_custom_control(FormRow.make("Preset", choice, _TOOLTIP))
