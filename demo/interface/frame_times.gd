extends RefCounted
## How long frames take, and what the GPU needs for each half of the picture: medians of the last
## frames, so that one in which a shader is compiled does not count.

const _MOST_FRAMES := 25
# Before, nothing is shown.
const _LEAST_FRAMES := 5

var _last := 0
var _frames: Array[float] = []
var _gpu: Array[Array] = [[], []]
var _measured: Array[RID] = [RID(), RID()]


## Takes a frame's times; [param viewports] are those of the left and right half.
func add_frame(viewports: Array[RID]) -> void:
	# By the clock: the engine gives its scripts no longer frames than 133 ms.
	var now := Time.get_ticks_usec()
	if _last > 0:
		_add(_frames, 0.001 * (now - _last))
	_last = now
	for side in 2:
		if viewports[side] != _measured[side]:
			if _measured[side].is_valid() and _measured[side] not in viewports:
				RenderingServer.viewport_set_measure_render_time(_measured[side], false)
			_measured[side] = viewports[side]
			_gpu[side].clear()
			if viewports[side].is_valid():
				RenderingServer.viewport_set_measure_render_time(viewports[side], true)
		if viewports[side].is_valid():
			var time := RenderingServer.viewport_get_measured_render_time_gpu(viewports[side])
			_add(_gpu[side], time)


## Frames a second and milliseconds a frame; empty as long as there are too few.
func get_frame_text() -> String:
	var time := _median(_frames)
	if time <= 0.0:
		return ""
	return ("%.1f fps  %.0f ms" if time > 100.0 else "%.0f fps  %.1f ms") % [1000.0 / time, time]


## The GPU's milliseconds for a half; empty where the driver gives no times.
func get_gpu_text(side: int) -> String:
	var time := _median(_gpu[side])
	return "GPU %.1f ms" % time if time > 0.0 else ""


static func _add(times: Array, time: float) -> void:
	times.append(time)
	if times.size() > _MOST_FRAMES:
		times.pop_front()


static func _median(times: Array) -> float:
	if times.size() < _LEAST_FRAMES:
		return 0.0
	var sorted := times.duplicate()
	sorted.sort()
	@warning_ignore("integer_division")
	return sorted[sorted.size() / 2]
