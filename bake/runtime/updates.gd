extends RefCounted
## What an update of a pyramid of 256 texels costs beside a frame of 720p that is lit by it, for
## each filter: times of the GPU's own, updates and frames in turns, medians over the rounds; the
## ratio is the median of each round's.

const Scene := preload("scene.gd")
const SIZE := 256
const _FRAMES := 3
# Frames until the GPU's clock has answered, and the environment has stopped drawing for it.
const _FRAMES_LATE := 16

## Why there are no results, in a sentence.
var error := ""


## To be awaited.
func measure(tree: SceneTree, scale: int, rounds: int) -> Array[Dictionary]:
	var view := Scene.make_view(tree, scale)
	var surroundings := view.camera.environment
	surroundings.background_mode = Environment.BG_SKY
	surroundings.sky = Sky.new()
	surroundings.sky.sky_material = ProceduralSkyMaterial.new()
	var environment := LobeEnvironment3D.new()
	@warning_ignore("integer_division")
	environment.size = SIZE / scale
	environment.measure_cost = true
	environment.update_mode = LobeEnvironment3D.UpdateMode.ONCE
	view.add_child(environment)
	var results: Array[Dictionary] = []
	for filter: LobeEnvironment3D.Filter in LobeEnvironment3D.Filter.values():
		environment.filter = filter
		var result := await _measure_filter(view, environment, rounds)
		if result.is_empty():
			error = "the driver gives no times of the GPU."
			break
		print(
			(
				"%s: an update takes %.2f ms of the GPU and %.2f ms of the processor, %.2f frames"
				% [
					result["filter"],
					result["update_gpu_ms"],
					result["update_cpu_ms"],
					result["update_frames_ratio"],
				]
			)
		)
		results.append(result)
	view.free()
	return results


# Empty if there are no times.
func _measure_filter(
	view: LinearViewport, environment: LobeEnvironment3D, rounds: int
) -> Dictionary:
	var updates := PackedFloat32Array()
	var processor := PackedFloat32Array()
	var frames := PackedFloat32Array()
	var ratios := PackedFloat32Array()
	for i in rounds:
		await environment.rebuild()
		for frame in _FRAMES_LATE:
			await RenderingServer.frame_post_draw
		updates.append(environment.update_gpu_time)
		processor.append(environment.update_cpu_time)
		frames.append(LinearViewport.median(await view.measure_gpu_time(_FRAMES, 1)))
		if frames[-1] == 0.0 or updates[-1] == 0.0:
			return {}
		ratios.append(updates[-1] / frames[-1])
	return {
		"renderer": RenderingServer.get_current_rendering_method(),
		"filter": (LobeEnvironment3D.Filter.find_key(environment.filter) as String).to_lower(),
		"size": environment.size,
		"frame": [view.size.x, view.size.y],
		"rounds": rounds,
		"update_gpu_ms": LinearViewport.median(updates),
		"update_cpu_ms": LinearViewport.median(processor),
		"frame_gpu_ms": LinearViewport.median(frames),
		"update_frames_ratio": LinearViewport.median(ratios),
	}
