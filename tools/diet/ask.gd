extends SceneTree
## Asks an exported project for what its pack leaves out, in ways that no export can foresee, for
## ./dev diet --acceptance: [code]--script … -- SCENE[/code]. Says what it got.

const FRAMES := 4


func _initialize() -> void:
	change_scene_to_file(OS.get_cmdline_user_args()[0])
	_ask.call_deferred()


func _ask() -> void:
	await _draw()
	var ball: MeshInstance3D = current_scene.get_node("Ball")
	var light := current_scene.get_node("Light")
	print("cube map before: %s" % (light.call("get_cubemap") != null))
	print("material: %s" % ball.get_active_material(0).call("to_" + "standard"))
	light.set("sou" + "rce", 1)
	await _draw()
	print("cube map without: %s" % (light.call("get_cubemap") != null))
	light.set("sou" + "rce", 2)
	await _draw()
	print("cube map after: %s" % (light.call("get_cubemap") != null))
	quit()


func _draw() -> void:
	for frame in FRAMES:
		await process_frame
