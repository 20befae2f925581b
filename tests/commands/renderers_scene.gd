extends SceneTree
## Draws one scene with the renderer that is running, as 8-bit sRGB: --script …/renderers_scene.gd
## -- FILE.png. For renderers_test.sh.
##
## Everything that lights itself by the environment: metals and dielectrics, brushed ones, roughness
## that varies, normal maps, all layers, all kinds of coordinates, mirrored and stretched meshes,
## before a neutral background. Together the materials have every include of LobeMaterial3D, or the
## scene ends with an error. The engine's own lights and skies differ between renderers, and are not
## in it.

const FlatShader := preload("res://addons/lobelight/editor/export/flat_shader.gd")
const SIZE := Vector2i(480, 270)
const COLUMNS := 5
const SOURCE_FRAMES := 24
# What other suites draw: antialiasing_test, in every renderer; line_shift_test, in Forward+, which
# alone has it.
const DRAWN_ELSEWHERE: PackedStringArray = ["normal_variance.gdshaderinc", "line_shift.gdshaderinc"]


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
	materials.append_array(_layers_and_coordinates())
	for i in materials.size():
		viewport.add_child(_object(i, materials[i]))
	if not await environment.rebuild():
		printerr("renderers_scene: " + environment.get_rebuild_error())
		quit(1)
		return
	# Lamps of the hall are taken out of its light some frames later.
	for frame in SOURCE_FRAMES:
		await process_frame
	var image: Image = await viewport.capture()
	var missing := _missing_includes(materials)
	if not missing.is_empty():
		printerr("renderers_scene: no material has " + ", ".join(missing))
		quit(1)
		return
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
	object.position = Vector3(1.2 * (index % COLUMNS) - 2.4, 1.2 - 1.2 * (index / COLUMNS), 0.0)
	object.rotation = Vector3(0.9, 0.3 * index, 0.2)
	object.scale = Vector3(0.5, 0.5, 0.5) if index % 3 == 2 else Vector3(1.0, 0.85, 0.95)
	if index == 5:
		object.scale = Vector3(-0.5, 0.4, 0.5)
	return object


func _materials() -> Array[LobeMaterial3D]:
	var made: Array[LobeMaterial3D] = []
	for i in 8:
		var material := LobeMaterial3D.new()
		material.metallic = 1.0
		material.albedo_color = Color.from_hsv(0.11 * i, 0.4, 0.9)
		material.roughness = 0.2 + 0.08 * i
		made.append(material)
	for i: int in [1, 2, 5, 7]:
		made[i].anisotropy_enabled = true
	made[1].anisotropy = 0.9
	made[2].anisotropy = -0.8
	made[2].anisotropy_rotation = 0.6
	made[3].metallic = 0.0
	made[4].metallic = 0.5
	made[4].clearcoat_enabled = true
	made[5].anisotropy = 1.05
	made[6].roughness_texture = _ramp()
	made[6].normal_enabled = true
	made[6].normal_texture = _waves()
	made[7].roughness_texture = _ramp()
	made[7].anisotropy = 0.7
	return made


# Each with as much as goes together. They mix no colours, which Compatibility has in sRGB.
func _layers_and_coordinates() -> Array[LobeMaterial3D]:
	var layers := LobeMaterial3D.new()
	_assign(
		layers,
		{
			"metallic": 0.3,
			"metallic_texture": _ramp(),
			"roughness": 0.5,
			"normal_enabled": true,
			"normal_texture": _waves(),
			"specular_antialiasing": LobeMaterial3D.SpecularAntialiasing.DISABLED,
			"clearcoat_enabled": true,
			"clearcoat": 0.7,
			"clearcoat_roughness": 0.2,
			"clearcoat_texture": _ramp(),
			"sheen_enabled": true,
			"sheen_color": Color(0.3, 0.5, 0.4),
			"sheen_texture": _ramp(),
			"ao_enabled": true,
			"ao_texture": _ramp(),
			"detail_enabled": true,
			"detail_blend_mode": BaseMaterial3D.BLEND_MODE_MUL,
			"detail_mask": _ramp(),
			"detail_normal": _waves(),
		}
	)
	var planes := LobeMaterial3D.new()
	_assign(planes, {"metallic": 1.0, "roughness": 0.8, "roughness_texture": _ramp()})
	planes.uv1_triplanar = true
	var relief := LobeMaterial3D.new()
	_assign(relief, {"albedo_texture": _waves(), "roughness": 0.6})
	_assign(
		relief, {"heightmap_enabled": true, "heightmap_texture": _ramp(), "heightmap_scale": 4.0}
	)
	var letters := LobeMaterial3D.new()
	_assign(letters, {"albedo_texture": _waves(), "albedo_texture_msdf": true, "roughness": 0.5})
	_assign(letters, {"transparency": BaseMaterial3D.TRANSPARENCY_ALPHA_SCISSOR})
	var faded := LobeMaterial3D.new()
	_assign(faded, {"roughness": 0.3, "distance_fade_max_distance": 12.0})
	_assign(faded, {"distance_fade_mode": BaseMaterial3D.DISTANCE_FADE_PIXEL_DITHER})
	# Without a lamp, what they show is their light of the environment.
	var lit := LobeMaterial3D.new()
	_assign(lit, {"roughness": 0.35, "rim_enabled": true, "backlight_enabled": true})
	_assign(lit, {"backlight": Color(0.2, 0.1, 0.1)})
	var grown := LobeMaterial3D.new()
	_assign(grown, {"metallic": 1.0, "roughness": 0.45, "grow": true, "grow_amount": 0.03})
	return [layers, planes, relief, letters, faded, lit, grown]


func _assign(material: LobeMaterial3D, properties: Dictionary[String, Variant]) -> void:
	for property in properties:
		material.set(property, properties[property])


# Of the includes of materials, those of whose functions no material's shader has any.
func _missing_includes(materials: Array[LobeMaterial3D]) -> PackedStringArray:
	var codes := ""
	for material in materials:
		codes += FlatShader.of(material.get_shader_code()).code
	var missing: PackedStringArray = []
	for include: ShaderInclude in LobeMaterial3D._INCLUDES:
		var file := include.resource_path.get_file()
		if file not in DRAWN_ELSEWHERE and not _has_part_of(codes, include):
			missing.append(file)
	return missing


func _has_part_of(codes: String, include: ShaderInclude) -> bool:
	var head := RegEx.create_from_string("(?m)^(?:\\w+ )?\\w+ \\w+\\(.*\\)$")
	var found := head.search_all(include.code)
	# One with names for other parts only is drawn with these.
	return (
		found.is_empty()
		or found.any(func(one: RegExMatch) -> bool: return one.get_string() in codes)
	)


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
