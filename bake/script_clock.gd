class_name ScriptClock
extends RefCounted
## What scripts take in a frame: those that hang on the engine's signals and, where asked for, those
## that nodes run in each frame.
##
## What is called in a frame hangs on signals: the time is that between a call of ours that comes
## before all others and one that comes after them. Nodes are called by their priority: the time is
## that between a node of ours with the first one and one with the last.

const _OURS := "res://addons/lobelight/"
const _FIRST := -2147483648
const _LAST := 2147483647


class Mark:
	extends Node

	var on_process: Callable

	func _init(priority: int, called: Callable) -> void:
		process_priority = priority
		on_process = called

	func _process(_delta: float) -> void:
		on_process.call()


## Microseconds since [method begin_frame].
var spent := 0

var _signals: Array[Signal] = []
var _root: Node
var _begin := 0
var _marks: Array[Mark] = []


## To be made before anything that is measured. With [param with_nodes], what nodes do in
## [method Node._process] counts too.
func _init(tree: SceneTree, with_nodes := false) -> void:
	_root = tree.root
	_signals = [
		tree.process_frame,
		tree.physics_frame,
		RenderingServer.frame_pre_draw,
		RenderingServer.frame_post_draw,
	]
	for one in _signals:
		one.connect(_on_begin)
	if with_nodes:
		_marks = [Mark.new(_FIRST, _on_begin), Mark.new(_LAST, _on_end)]
		for mark in _marks:
			_root.add_child(mark)


## Ends what the clock does; it is of no use then.
func stop() -> void:
	for one in _signals:
		one.disconnect(_on_begin)
		if one.is_connected(_on_end):
			one.disconnect(_on_end)
	for mark in _marks:
		mark.free()
	_marks.clear()


## From now on time counts as that of a new frame, with what has been connected meanwhile.
func begin_frame() -> void:
	for one in _signals:
		if one.is_connected(_on_end):
			one.disconnect(_on_end)
		one.connect(_on_end)
	spent = 0


## Functions of the run time that a frame calls.
func count_calls() -> int:
	var calls := 0
	for one in _signals:
		for connection: Dictionary in one.get_connections():
			var called: Callable = connection["callable"]
			var script: Script = called.get_object() as Script
			if script == null and called.get_object() != null:
				script = called.get_object().get_script()
			if script != null and script.resource_path.begins_with(_OURS):
				calls += 1
	for node in _root.find_children("*", "Node3D", true, false):
		calls += int(node.is_processing()) + int(node.is_physics_processing())
	return calls


func _on_begin() -> void:
	_begin = Time.get_ticks_usec()


func _on_end() -> void:
	spent += Time.get_ticks_usec() - _begin
