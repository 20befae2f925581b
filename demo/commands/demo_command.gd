extends SceneTree
## What the demo's headless commands share: `--out`, one sentence on stderr where something fails,
## and the exit status. They are called by `./dev demo` and are no part of an exported demo.

var _arguments: CommandLine


func _initialize() -> void:
	_arguments = CommandLine.new("demo", PackedStringArray(["out"]) + _own_options())
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	_arguments.required("out")
	if _arguments.error.is_empty():
		await _work(_arguments.path("out"))
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
	quit(0 if _arguments.error.is_empty() else 1)


## Options besides `--out`, without the dashes.
func _own_options() -> PackedStringArray:
	return []


## Does what the command is for; [param _out] is an absolute path. What fails is told to
## [code]_arguments[/code].
func _work(_out: String) -> void:
	pass


## Adds a viewport with the demo in it, which draws when it is told to.
func _add_demo(view: SubViewport) -> Node:
	view.own_world_3d = true
	view.render_target_update_mode = SubViewport.UPDATE_DISABLED
	root.add_child(view)
	var scene: PackedScene = load("res://demo/demo.tscn")
	var demo := scene.instantiate()
	view.add_child(demo)
	return demo
