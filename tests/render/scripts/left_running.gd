extends SceneTree
## Ends in the middle of captures and of a fade, in two worlds, with nodes, lights and a rebuild
## that is awaited left as they are; exit_test.gd looks at how.

const FRAMES := 5


func _initialize() -> void:
	_run()


func _run() -> void:
	await process_frame
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.4
	for i in 2:
		_add_world(i, material)
	for i in FRAMES:
		await RenderingServer.frame_post_draw
	var probe := LobeProbe3D.new()
	root.add_child(probe)
	probe.rebuild()
	quit()


func _add_world(index: int, material: LobeMaterial3D) -> void:
	var view := SubViewport.new()
	view.own_world_3d = true
	view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	root.add_child(view)
	var camera := Camera3D.new()
	camera.position.z = 4
	view.add_child(camera)
	var ball := MeshInstance3D.new()
	ball.mesh = SphereMesh.new()
	ball.mesh.material = material
	view.add_child(ball)
	for mode: LobeProbe3D.UpdateMode in LobeProbe3D.UpdateMode.values():
		var probe := LobeProbe3D.new()
		probe.update_mode = mode
		view.add_child(probe)
	for value: float in [0.5, 1.0]:
		var light := LobeEnvironment3D.new()
		var image := Image.create_empty(8, 4, false, Image.FORMAT_RGBAF)
		image.fill(Color(value, value, index))
		light.panorama = ImageTexture.create_from_image(image)
		light.fade_time = 10.0
		view.add_child(light)
		if value == 0.5:
			light.rebuild_finished.connect(light.queue_free)
