extends SceneTree
## `./dev bench runtime`: what an update of a pyramid of 256 texels costs beside a frame of 720p
## that is lit by it, for each filter. `--scale N` divides both sides; `--rounds N`; `--json FILE`.
##
## Times are the GPU's own, updates and frames in turns, and medians over the rounds; the ratio is
## the median of each round's.

const TABLES := "res://addons/lobelight/tables/ggx_8.res"
const FRAME := Vector2i(1280, 720)
const SIZE := 256
const ALPHA := Vector2(0.1, 0.1)
const _FRAMES := 3
# Frames until the GPU's clock has answered, and the environment has stopped drawing for it.
const _FRAMES_LATE := 16
const _MOST_SCALE := 16
const _MOST_ROUNDS := 100

var _arguments := CommandLine.new("bench runtime", ["scale", "rounds", "json"])


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	var scale := _arguments.integer("scale", 1, 1, _MOST_SCALE)
	var rounds := _arguments.integer("rounds", 8, 1, _MOST_ROUNDS)
	var json := _arguments.path("json") if _arguments.has("json") else ""
	if _arguments.error.is_empty() and DisplayServer.get_name() == "headless":
		_arguments.fail("the engine runs without a renderer.")
	if _arguments.error.is_empty():
		root.size = Vector2i(64, 64)
		var results := await _measure(scale, rounds)
		if _arguments.error.is_empty() and not json.is_empty():
			_arguments.fail_if(AtomicFile.save_json(results, json))
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
	quit(0 if _arguments.error.is_empty() else 1)


func _measure(scale: int, rounds: int) -> Array[Dictionary]:
	var view := LinearViewport.new()
	view.size = FRAME / scale
	root.add_child(view)
	var surroundings := view.camera.environment
	surroundings.background_mode = Environment.BG_SKY
	surroundings.sky = Sky.new()
	surroundings.sky.sky_material = ProceduralSkyMaterial.new()
	view.add_child(_make_sphere())
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
			_arguments.fail("the driver gives no times of the GPU.")
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


# Eight lobes in every pixel of a frame, of all directions and many levels.
func _make_sphere() -> MeshInstance3D:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = (load(TABLES) as LobeTableSet).table_at(ALPHA)
	var mesh := SphereMesh.new()
	mesh.radius = 1.0
	mesh.height = 2.0
	mesh.material = material
	var sphere := MeshInstance3D.new()
	sphere.mesh = mesh
	sphere.scale = Vector3(3.0, 3.0, 1.0)
	return sphere


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
