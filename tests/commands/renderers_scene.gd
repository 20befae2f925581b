extends SceneTree
## Draws one scene with the renderer that is running, as 8-bit sRGB: --script …/renderers_scene.gd
## -- FILE.png. For renderers_test.sh.
##
## Everything that lights itself by the environment: metals and dielectrics, brushed ones, roughness
## that varies, normal maps, clear coat, mirrored and stretched meshes, before a neutral background.
## The engine's own lights and skies differ between renderers, and are not in it.

const SIZE := Vector2i(480, 270)


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	await process_frame
	var viewport := LinearViewport.new()
	viewport.size = SIZE
	root.add_child(viewport)
	viewport.camera.environment.background_color = Color(0.18, 0.18, 0.2)
	viewport.camera.set_perspective(30.0, 0.1, 20.0)
	viewport.camera.position = Vector3(0.0, 0.4, 7.0)
	viewport.camera.look_at(Vector3.ZERO)
	var environment := LobeEnvironment3D.new()
	environment.panorama = load("res://demo/environments/hall.exr")
	environment.rotation.y = 0.7
	viewport.add_child(environment)
	var materials := _materials()
	for i in materials.size():
		viewport.add_child(_object(i, materials[i]))
	if not await environment.rebuild():
		printerr("renderers_scene: " + environment.get_rebuild_error())
		quit(1)
		return
	var image: Image = await viewport.capture()
	for y in image.get_height():
		for x in image.get_width():
			var colour := image.get_pixel(x, y).clamp().linear_to_srgb()
			image.set_pixel(x, y, Color(colour, 1.0))
	image.convert(Image.FORMAT_RGB8)
	quit(0 if image.save_png(OS.get_cmdline_user_args()[0]) == OK else 1)


func _object(index: int, material: LobeMaterial3D) -> MeshInstance3D:
	var object := MeshInstance3D.new()
	object.mesh = TorusMesh.new() if index % 3 == 2 else SphereMesh.new()
	object.material_override = material
	@warning_ignore("integer_division")
	object.position = Vector3(1.4 * (index % 4) - 2.1, 0.8 - 1.6 * (index / 4), 0.0)
	object.rotation = Vector3(0.9, 0.3 * index, 0.2)
	object.scale = Vector3(0.6, 0.6, 0.6) if index % 3 == 2 else Vector3(1.2, 1.0, 1.1)
	if index == 5:
		object.scale = Vector3(-0.6, 0.5, 0.6)
	return object


func _materials() -> Array[LobeMaterial3D]:
	var made: Array[LobeMaterial3D] = []
	for i in 8:
		var material := LobeMaterial3D.new()
		material.metallic = 1.0
		material.albedo_color = Color.from_hsv(0.11 * i, 0.4, 0.9)
		material.roughness = 0.2 + 0.08 * i
		made.append(material)
	made[1].anisotropy = 0.9
	made[2].anisotropy = -0.8
	made[2].anisotropy_rotation = 0.6
	made[3].metallic = 0.0
	made[4].metallic = 0.5
	made[4].clearcoat = 1.0
	made[5].anisotropy = 1.05
	made[6].roughness_texture = _ramp()
	made[6].normal_texture = _waves()
	made[7].roughness_texture = _ramp()
	made[7].anisotropy = 0.7
	return made


func _ramp() -> ImageTexture:
	var image := Image.create_empty(64, 64, false, Image.FORMAT_R8)
	for y in 64:
		for x in 64:
			image.set_pixel(x, y, Color8(4 * y, 0, 0))
	return ImageTexture.create_from_image(image)


func _waves() -> ImageTexture:
	var image := Image.create_empty(64, 64, false, Image.FORMAT_RGB8)
	for y in 64:
		for x in 64:
			var slope := 0.3 * sin(TAU * x / 32.0)
			image.set_pixel(x, y, Color(0.5 + 0.5 * slope, 0.5, 0.95))
	return ImageTexture.create_from_image(image)
