extends RefCounted
## What the scripts of one environment and of a material that it lights take in each frame while
## nothing changes, in microseconds: means of the middle half of the frames, less what the same
## takes without the two.

const Scene := preload("scene.gd")
const SOURCES: PackedStringArray = ["panorama", "sky", "baked"]
# Until what drew the light has been given back.
const _SETTLING := 300
const _PANORAMA := Vector2i(64, 32)

## Why there are no results, in a sentence.
var error := ""

var _tree: SceneTree


## To be awaited.
func measure(tree: SceneTree, _scale: int, rounds: int) -> Array[Dictionary]:
	_tree = tree
	var clock := ScriptClock.new(tree, true)
	var frames := 25 * rounds
	var results: Array[Dictionary] = []
	for source in SOURCES:
		var world := Node3D.new()
		tree.root.add_child(world)
		var ball := _fill(world)
		await _settle()
		var without := await _time(clock, frames)
		var environment := LobeEnvironment3D.new()
		match source:
			"panorama":
				environment.panorama = Scene.make_panorama(_PANORAMA)
			"baked":
				environment.light = LobeLight.make_constant(Color.WHITE, true)
		world.add_child(environment)
		ball.material_override = LobeMaterial3D.new()
		await _settle()
		var calls := clock.count_calls()
		var time := await _time(clock, frames)
		world.free()
		var result := {
			"renderer": RenderingServer.get_current_rendering_method(),
			"source": source,
			"frames": frames,
			"calls": calls,
			"script_usec": maxf(time - without, 0.0),
		}
		print(
			(
				"an idle environment of a %s: %d calls a frame, %.2f microseconds"
				% [source, calls, result["script_usec"]]
			)
		)
		results.append(result)
	clock.stop()
	return results


# A sky, a sun and a ball.
func _fill(world: Node3D) -> MeshInstance3D:
	var camera := Camera3D.new()
	camera.position.z = 3.0
	camera.environment = Environment.new()
	camera.environment.background_mode = Environment.BG_SKY
	camera.environment.sky = Sky.new()
	camera.environment.sky.sky_material = ProceduralSkyMaterial.new()
	world.add_child(camera)
	world.add_child(DirectionalLight3D.new())
	var ball := MeshInstance3D.new()
	ball.mesh = SphereMesh.new()
	world.add_child(ball)
	return ball


func _settle() -> void:
	for frame in _SETTLING:
		await _tree.process_frame


func _time(clock: ScriptClock, frames: int) -> float:
	var times := PackedFloat32Array()
	for frame in frames:
		clock.begin_frame()
		await _tree.process_frame
		times.append(clock.spent)
	times.sort()
	@warning_ignore("integer_division")
	var quarter := times.size() / 4
	var sum := 0.0
	for time in times.slice(quarter, times.size() - quarter):
		sum += time
	return sum / (times.size() - 2 * quarter)
