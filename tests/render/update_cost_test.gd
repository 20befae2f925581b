extends GdUnitTestSuite
## What an update of a pyramid of 256 texels costs beside a frame of 720p that is lit by it: less,
## with the filter that is the default. Both are drawn at half of the side, for time's sake;
## LOBELIGHT_COST_SCALE=1 draws them whole.

const Kit := preload("support/render_kit.gd")
const SkyKit := preload("support/sky_kit.gd")
const TABLES: LobeTableSet = preload("res://addons/lobelight/tables/ggx_8.res")
const ROUNDS := 4
const MOST_ROUNDS := 12
const FRAMES := 3

var _window_size: Vector2i


func before() -> void:
	_window_size = get_window().size
	get_window().size = Vector2i(64, 64)


func after() -> void:
	get_window().size = _window_size


func test_an_update_costs_less_than_a_frame() -> void:
	var scale := 2
	if OS.has_environment("LOBELIGHT_COST_SCALE"):
		scale = OS.get_environment("LOBELIGHT_COST_SCALE").to_int()
	var view := LinearViewport.new()
	@warning_ignore("integer_division")
	view.size = Vector2i(1280, 720) / scale
	add_child(view)
	SkyKit.set_sky(view.camera.environment, "procedural")
	# Eight lobes in every pixel of a frame, of all directions and many levels.
	var material := LobeMaterial3D.new()
	material.table = TABLES.table_at(Vector2(0.1, 0.1))
	var sphere := Kit.make_sphere(material)
	sphere.scale = Vector3(3.0, 3.0, 1.0)
	view.add_child(sphere)
	var environment := LobeEnvironment3D.new()
	@warning_ignore("integer_division")
	environment.size = 256 / scale
	environment.measure_cost = true
	environment.update_mode = LobeEnvironment3D.UpdateMode.ONCE
	view.add_child(environment)
	for filter: LobeEnvironment3D.Filter in LobeEnvironment3D.Filter.values():
		environment.filter = filter
		var update := PackedFloat32Array()
		var frame := PackedFloat32Array()
		var processor := PackedFloat32Array()
		for i in MOST_ROUNDS:
			# On a busy machine it takes longer until nothing has come between.
			if i >= ROUNDS and _least(update) < _least(frame):
				break
			update.append(await _time_of_updates(environment))
			processor.append(environment.update_cpu_time)
			frame.append_array(await view.measure_gpu_time(FRAMES, 1))
		var ratio := _least(update) / _least(frame)
		print(
			(
				"  %s: an update takes %.2f ms of the GPU and %.2f ms of the processor, %.2f frames"
				% [
					(LobeEnvironment3D.Filter.find_key(filter) as String).to_lower(),
					_least(update),
					_least(processor),
					ratio,
				]
			)
		)
		assert_float(ratio).is_greater(0.0)
		if filter == LobeEnvironment3D.Filter.DISC:
			assert_float(ratio).is_less(1.0)
	view.free()


# The least of a few times: what other programs add to the others says nothing.
func _least(times: PackedFloat32Array) -> float:
	var sorted := times.duplicate()
	sorted.sort()
	return sorted[0]


# The times come some frames late.
func _time_of_updates(environment: LobeEnvironment3D) -> float:
	environment.update_mode = LobeEnvironment3D.UpdateMode.EVERY_FRAME
	for i in 8:
		await RenderingServer.frame_post_draw
	environment.update_mode = LobeEnvironment3D.UpdateMode.ONCE
	for i in 4:
		await RenderingServer.frame_post_draw
	return environment.update_gpu_time
