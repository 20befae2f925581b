extends SceneTree
## Starts a task again whose handler lets go of it, as lobe_task_ending_test.gd has it do: the
## signal of the first run is emitted within the second start().

const QUICK := {"alpha": 0.1, "lobes": 2, "views": [4, 1]}

# The only reference; a call by it holds none of its own.
var _baker := LobeBaker.new()


func _initialize() -> void:
	var reference: WeakRef = weakref(_baker)
	_baker.finished.connect(_on_finished)
	_baker.start(QUICK)
	# Without a frame in between, so that the signal is still on its way.
	while _baker.is_running():
		OS.delay_msec(1)
	_baker.start(QUICK)
	if reference.get_ref() == null:
		print("the task is gone")
	quit()


func _on_finished(_table: Dictionary) -> void:
	_baker = null
