extends RefCounted
## How long frames take, and what the GPU needs for each half of the picture.

# Of each new value in the mean that is shown.
const _SHARE := 0.08

var _frame := 0.0
var _gpu: Array[float] = [0.0, 0.0]
var _measured: Array[RID] = [RID(), RID()]


## Takes a frame's times; [param viewports] are those of the left and right half.
func add_frame(delta: float, viewports: Array[RID]) -> void:
	_frame = lerpf(_frame, 1000.0 * delta, _SHARE) if _frame > 0.0 else 1000.0 * delta
	for side in 2:
		if viewports[side] != _measured[side]:
			_measured[side] = viewports[side]
			_gpu[side] = 0.0
			if viewports[side].is_valid():
				RenderingServer.viewport_set_measure_render_time(viewports[side], true)
		if viewports[side].is_valid():
			var time := RenderingServer.viewport_get_measured_render_time_gpu(viewports[side])
			_gpu[side] = lerpf(_gpu[side], time, _SHARE) if _gpu[side] > 0.0 else time


## Frames a second and milliseconds a frame.
func get_frame_text() -> String:
	return "%d fps  %.1f ms" % [roundi(1000.0 / maxf(_frame, 0.01)), _frame]


## The GPU's milliseconds for a half; empty where the driver gives no times.
func get_gpu_text(side: int) -> String:
	return "  GPU %.1f ms" % _gpu[side] if _gpu[side] > 0.0 else ""
