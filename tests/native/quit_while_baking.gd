extends SceneTree
## Quits while a task is running, as lobe_task_ending_test.gd has it do. The argument says what
## becomes of the task: "held" by this script until the engine lets go of it, or "leaked", so that
## nothing ever frees it.

const LONG := {"alpha": [0.01, 0.3], "lobes": 32, "views": [64, 64]}

var _baker := LobeBaker.new()


func _initialize() -> void:
	if OS.get_cmdline_user_args().has("leaked"):
		var baker := _baker
		baker.finished.connect(func(_table: Dictionary) -> void: baker.cancel())
	_baker.start(LONG)
	# A worker that has only just begun would prove less.
	OS.delay_msec(100)
	if _baker.is_running():
		print("quitting while a task is running")
	quit()
