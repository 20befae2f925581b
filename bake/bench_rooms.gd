extends SceneTree
## `./dev bench rooms`: what the scripts of the run time take in each frame of a scene of many
## rooms, while nothing moves, while a probe moves, and while one is captured.
## `--probes N`, `--meshes N`, `--frames N`, `--json FILE`.

const _SPACING := 8.0
const _MATERIALS := 20
# Until all has been captured and what drew it has been given back.
const _SETTLING := 600

var _arguments := CommandLine.new("bench rooms", ["probes", "meshes", "frames", "json"])


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	var probes := _arguments.integer("probes", 16, 1, 256)
	var meshes := _arguments.integer("meshes", 200, 1, 10000)
	var frames := _arguments.integer("frames", 100, 10, 10000)
	var json := _arguments.path("json") if _arguments.has("json") else ""
	if _arguments.error.is_empty() and DisplayServer.get_name() == "headless":
		_arguments.fail("the engine runs without a renderer.")
	if _arguments.error.is_empty():
		root.size = Vector2i(64, 64)
		var results := await _measure(probes, meshes, frames)
		if not json.is_empty():
			_arguments.fail_if(AtomicFile.save_json(results, json))
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
	quit(0 if _arguments.error.is_empty() else 1)


func _measure(count: int, meshes: int, frames: int) -> Array[Dictionary]:
	var clock := ScriptClock.new(self)
	var before := _texture_bytes()
	var world := Node3D.new()
	root.add_child(world)
	world.add_child(Camera3D.new())
	_add_meshes(world, meshes)
	var environment := LobeEnvironment3D.new()
	environment.panorama = _make_panorama()
	world.add_child(environment)
	var probes := _add_probes(world, count)
	for frame in _SETTLING:
		await process_frame
	var results: Array[Dictionary] = []
	for state: String in ["still", "a probe moves", "a probe is captured"]:
		var times := PackedFloat32Array()
		var most_calls := 0
		for frame in frames:
			if state == "a probe moves":
				probes[0].position.y = 0.001 * (frame % 2)
				probes[0].force_update_transform()
			elif state == "a probe is captured":
				probes[0].interior = frame % 2 == 0
			clock.begin_frame()
			most_calls = maxi(most_calls, clock.count_calls())
			await process_frame
			times.append(clock.spent)
		var result := {
			"renderer": RenderingServer.get_current_rendering_method(),
			"probes": count,
			"meshes": meshes,
			"state": state,
			"calls": most_calls,
			"script_usec": LinearViewport.median(times),
			"texture_mib": (_texture_bytes() - before) / 1048576.0,
		}
		results.append(result)
		print(
			(
				"%s: %d calls a frame, %.0f microseconds of scripts"
				% [state, most_calls, result["script_usec"]]
			)
		)
	world.free()
	clock.stop()
	return results


func _add_meshes(world: Node3D, count: int) -> void:
	var materials: Array[LobeMaterial3D] = []
	for i in _MATERIALS:
		var material := LobeMaterial3D.new()
		material.metallic = 1.0
		material.roughness = 0.1 + 0.8 * i / _MATERIALS
		materials.append(material)
	for i in count:
		var mesh := MeshInstance3D.new()
		mesh.mesh = SphereMesh.new()
		mesh.material_override = materials[i % _MATERIALS]
		mesh.position = Vector3(i % 20, 0.0, -floorf(i / 20.0)) * 2.0
		world.add_child(mesh)


func _add_probes(world: Node3D, count: int) -> Array[LobeProbe3D]:
	var probes: Array[LobeProbe3D] = []
	for i in count:
		var probe := LobeProbe3D.new()
		probe.size = Vector3(_SPACING, 4.0, _SPACING)
		probe.position = Vector3(i % 4, 0.0, -floorf(i / 4.0)) * _SPACING
		world.add_child(probe)
		probes.append(probe)
	return probes


func _make_panorama() -> ImageTexture:
	var image := Image.create_empty(64, 32, false, Image.FORMAT_RGBAF)
	image.fill(Color(0.5, 0.6, 0.8))
	return ImageTexture.create_from_image(image)


func _texture_bytes() -> int:
	return RenderingServer.get_rendering_info(RenderingServer.RENDERING_INFO_TEXTURE_MEM_USED)
