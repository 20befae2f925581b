@tool
extends VBoxContainer
## Sentences in the inspector that are looked up anew twice a second, as the scene may change.

const WarningLabel := preload("warning_label.gd")

const _PERIOD := 0.5

# Gives a PackedStringArray.
var _find: Callable
var _shown: PackedStringArray = []
var _waited := 0.0


func _init(find: Callable = Callable()) -> void:
	_find = find


func _enter_tree() -> void:
	_update()


func _process(delta: float) -> void:
	_waited += delta
	if _waited > _PERIOD and is_visible_in_tree():
		_waited = 0.0
		_update()


## What is said at the moment.
func get_warnings() -> PackedStringArray:
	return _shown


func _update() -> void:
	var found: PackedStringArray = _find.call()
	if found == _shown:
		return
	_shown = found
	for child in get_children():
		child.queue_free()
	for sentence in found:
		add_child(WarningLabel.new(sentence))
