@tool
extends OptionButton
## Gives a [LobeMaterial3D] one of some looks, and shows which one it has.

const MaterialPresets := preload("material_presets.gd")

var _material: LobeBaseMaterial3D
var _history: EditorUndoRedoManager


static func make(for_material: LobeBaseMaterial3D, history: EditorUndoRedoManager) -> OptionButton:
	var choice := new()
	choice._material = for_material
	choice._history = history
	choice.clip_text = true
	choice.add_item("Choose …")
	for name in MaterialPresets.get_names():
		choice.add_item(name)
	choice.item_selected.connect(choice._on_selected)
	for_material.changed.connect(choice._show_name)
	choice._show_name()
	return choice


func _show_name() -> void:
	select(MaterialPresets.get_names().find(MaterialPresets.find_name(_material)) + 1)


func _on_selected(index: int) -> void:
	if index > 0:
		MaterialPresets.apply(_material, get_item_text(index), _history)
