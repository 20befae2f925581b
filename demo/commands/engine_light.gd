extends "demo_command.gd"
## Draws what the engine's own light makes of a [LobeMaterial3D], beside Godot's material in the
## same scenes, as one picture: `./dev demo --engine-light FILE`.

const PictureFile := preload("picture_file.gd")
const SKY := preload("res://demo/environments/hall.exr")
const TILE := Vector2i(440, 300)
const COLUMNS := 3
# Frames until shaders, reflection probes and voxels are there.
const SETTLING := 24
const CASES: PackedStringArray = [
	"Environment", "and a lamp", "and fog", "and a decal", "and a reflection probe", "and VoxelGI"
]

var _environment: LobeEnvironment3D


func _work(out: String) -> void:
	@warning_ignore("integer_division")
	var rows := (CASES.size() + COLUMNS - 1) / COLUMNS
	var sheet := SubViewport.new()
	sheet.size = TILE * Vector2i(COLUMNS, rows)
	sheet.use_hdr_2d = true
	sheet.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	root.add_child(sheet)
	var line := ProgressLine.new("drawing")
	for index in CASES.size():
		@warning_ignore("integer_division")
		var corner := TILE * Vector2i(index % COLUMNS, index / COLUMNS)
		await _add_tile(sheet, corner, index)
		line.show((index + 1.0) / CASES.size())
	await RenderingServer.frame_post_draw
	line.finish()
	_arguments.fail_if(PictureFile.save(sheet, out))


# A picture of its own, which stays as it is once it has been drawn.
func _add_tile(sheet: SubViewport, corner: Vector2i, index: int) -> void:
	var view := SubViewport.new()
	view.size = TILE
	view.own_world_3d = true
	view.msaa_3d = Viewport.MSAA_4X
	view.use_hdr_2d = true
	view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	sheet.add_child(view)
	var surroundings := _add_scene(view)
	if _environment == null:
		# All worlds show the light of one environment.
		_environment = LobeEnvironment3D.new()
		_environment.update_mode = LobeEnvironment3D.UpdateMode.ONCE
		view.add_child(_environment)
		_arguments.fail_if("" if await _environment.rebuild() else _environment.get_rebuild_error())
	match index:
		1:
			_add_lamp(view)
		2:
			surroundings.fog_enabled = true
			surroundings.fog_density = 0.1
			surroundings.fog_sky_affect = 0.0
		3:
			_add_lamp(view)
			_add_decal(view)
		4:
			_add_red_wall(view)
			_add_probe(view)
		5:
			_add_red_wall(view)
			_add_voxels(view)
	for frame in SETTLING:
		await RenderingServer.frame_post_draw
	view.render_target_update_mode = SubViewport.UPDATE_DISABLED
	var picture := TextureRect.new()
	picture.texture = view.get_texture()
	picture.position = corner
	sheet.add_child(picture)
	var label := Label.new()
	label.text = CASES[index]
	label.position = corner + Vector2i(10, 6)
	label.add_theme_color_override(&"font_outline_color", Color.BLACK)
	label.add_theme_constant_override(&"outline_size", 6)
	sheet.add_child(label)


# A LobeMaterial3D on the left, the material of Godot's that it is made from on the right.
func _add_scene(view: SubViewport) -> Environment:
	var surroundings := Environment.new()
	surroundings.background_mode = Environment.BG_SKY
	surroundings.sky = Sky.new()
	var sky_material := PanoramaSkyMaterial.new()
	sky_material.panorama = SKY
	surroundings.sky.sky_material = sky_material
	surroundings.tonemap_mode = Environment.TONE_MAPPER_FILMIC
	var camera := Camera3D.new()
	camera.environment = surroundings
	camera.fov = 40.0
	view.add_child(camera)
	camera.look_at_from_position(Vector3(0.0, 1.3, 4.3), Vector3(0.0, 0.05, 0.0))

	var godots := StandardMaterial3D.new()
	godots.albedo_color = Color(0.72, 0.6, 0.45)
	godots.metallic = 0.6
	godots.roughness = 0.45
	godots.anisotropy_enabled = true
	godots.anisotropy = 0.7
	for side: int in [-1, 1]:
		var ball := MeshInstance3D.new()
		ball.mesh = SphereMesh.new()
		ball.scale = 1.3 * Vector3.ONE
		ball.position.x = 0.85 * side
		ball.material_override = LobeMaterial3D.from_standard(godots) if side < 0 else godots
		ball.gi_mode = GeometryInstance3D.GI_MODE_STATIC
		view.add_child(ball)
	var grey := StandardMaterial3D.new()
	grey.albedo_color = Color(0.5, 0.5, 0.5)
	_add_box(view, Vector3(5.0, 0.1, 4.0), Vector3(0.0, -0.7, 0.0), grey)
	return surroundings


func _add_box(view: SubViewport, size: Vector3, at: Vector3, material: Material) -> void:
	var box := MeshInstance3D.new()
	var mesh := BoxMesh.new()
	mesh.size = size
	box.mesh = mesh
	box.position = at
	box.material_override = material
	box.gi_mode = GeometryInstance3D.GI_MODE_STATIC
	view.add_child(box)


func _add_lamp(view: SubViewport) -> void:
	var lamp := DirectionalLight3D.new()
	lamp.shadow_enabled = true
	lamp.light_energy = 1.5
	lamp.rotation_degrees = Vector3(-40.0, 50.0, 0.0)
	view.add_child(lamp)


func _add_decal(view: SubViewport) -> void:
	var picture := Image.create_empty(64, 64, false, Image.FORMAT_RGBA8)
	for y in 64:
		for x in 64:
			@warning_ignore("integer_division")
			var is_dark := (x / 8 + y / 8) % 2 == 0
			picture.set_pixel(x, y, Color(0.1, 0.2, 0.8, 1.0 if is_dark else 0.0))
	var decal := Decal.new()
	decal.texture_albedo = ImageTexture.create_from_image(picture)
	decal.size = Vector3(4.0, 3.0, 4.0)
	view.add_child(decal)


func _add_red_wall(view: SubViewport) -> void:
	var red := StandardMaterial3D.new()
	red.emission_enabled = true
	red.emission = Color(1.0, 0.05, 0.02)
	red.emission_energy_multiplier = 2.0
	_add_box(view, Vector3(3.4, 1.2, 0.1), Vector3(0.0, -0.05, -1.4), red)


func _add_probe(view: SubViewport) -> void:
	var probe := ReflectionProbe.new()
	probe.size = Vector3(8.0, 4.0, 8.0)
	view.add_child(probe)


func _add_voxels(view: SubViewport) -> void:
	var voxels := VoxelGI.new()
	voxels.size = Vector3(6.0, 3.0, 5.0)
	voxels.subdiv = VoxelGI.SUBDIV_64
	view.add_child(voxels)
	voxels.bake(view)
