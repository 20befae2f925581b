@tool
extends EditorInspectorPlugin
## At the top of a [LobeTable]'s inspector: how it is baked, and what has been baked.

const BakePanel := preload("bake_panel.gd")
const BakeQueue := preload("bake_queue.gd")
const TableView := preload("../plots/table_view.gd")

var _queue: BakeQueue


func _init(queue: BakeQueue = null) -> void:
	_queue = queue


func _can_handle(object: Object) -> bool:
	return object is LobeTable


func _parse_begin(object: Object) -> void:
	_add_section("Bake", BakePanel.make(_queue, object as LobeTable))
	_add_section("What Was Baked", TableView.make(object as LobeTable))


func _add_section(title: String, content: Control) -> void:
	var section := FoldableContainer.new()
	section.title = title
	section.add_child(content)
	add_custom_control(section)
