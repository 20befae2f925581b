extends Node3D
## A ball and a brushed one in the light of the scene's sky; the second is drawn with brushed.res
## where that has been baked. [code]-- FILE.png[/code] saves a frame; without a renderer the scene
## runs as long and nothing is drawn.

const FRAMES := 12


func _ready() -> void:
	_add_sky()
	add_child(LobeEnvironment3D.new())
	_add_ball(-0.6, LobeMaterial3D.new())
	var brushed := LobeMaterial3D.new()
	brushed.metallic = 1.0
	brushed.anisotropy = 0.9
	brushed.anisotropy_enabled = true
	if ResourceLoader.exists("res://brushed.res"):
		brushed.table = load("res://brushed.res")
	_add_ball(0.6, brushed)
	for frame in FRAMES:
		await get_tree().process_frame
	var arguments := OS.get_cmdline_user_args()
	if not arguments.is_empty():
		await RenderingServer.frame_post_draw
		get_viewport().get_texture().get_image().save_png(arguments[0])
	print("main: %s, %d frames" % ["own table" if brushed.table else "ready set", FRAMES])
	get_tree().quit()


func _add_sky() -> void:
	var world := WorldEnvironment.new()
	world.environment = Environment.new()
	world.environment.background_mode = Environment.BG_SKY
	world.environment.sky = Sky.new()
	world.environment.sky.sky_material = ProceduralSkyMaterial.new()
	add_child(world)
	var camera := Camera3D.new()
	camera.position.z = 2.6
	camera.fov = 40.0
	add_child(camera)


func _add_ball(x: float, material: LobeMaterial3D) -> void:
	var ball := MeshInstance3D.new()
	ball.mesh = SphereMesh.new()
	ball.material_override = material
	ball.position.x = x
	add_child(ball)
