extends "demo_command.gd"
## Draws scenes that the engine lights, with LobeMaterial3Ds and with Godot's materials, as one
## picture, and prints how far the diffuse light of both is apart:
## `./dev demo --engine-diffuse FILE`.

const EngineScenes := preload("res://demo/engine_light/engine_scenes.gd")
const PictureFile := preload("picture_file.gd")
const TILE := Vector2i(300, 220)
# Until what the engine has is noticed, in seconds.
const NOTICE := 0.7
# Frames until other materials show.
const SWITCHING := 6
# What is asked, of 255.
const MEAN := 3.0
const MOST := 12.0

var _sheet := SubViewport.new()


func _work(out: String) -> void:
	var method := RenderingServer.get_current_rendering_method()
	var kinds := EngineScenes.of_renderer(method)
	_sheet.size = TILE * Vector2i(kinds.size(), 2)
	_sheet.use_hdr_2d = true
	_sheet.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	root.add_child(_sheet)
	RenderingServer.environment_set_sdfgi_frames_to_converge(
		RenderingServer.ENV_SDFGI_CONVERGE_IN_15_FRAMES
	)
	print("Diffuse light in %s beside Godot's own, of 255: mean, 99 %% of the pixels" % method)
	for column in kinds.size():
		await _draw_scene(kinds[column], column)
	await RenderingServer.frame_post_draw
	_arguments.fail_if(PictureFile.save(_sheet, out))


func _draw_scene(kind: EngineScenes.Kind, column: int) -> void:
	var view := SubViewport.new()
	view.size = TILE
	view.use_hdr_2d = true
	view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	root.add_child(view)
	var scene := EngineScenes.new(view, kind)
	_arguments.fail_if(
		"" if await scene.lobe_environment.rebuild() else scene.lobe_environment.get_rebuild_error()
	)
	await create_timer(NOTICE).timeout
	await _settle(EngineScenes.SETTLING[kind])
	if kind == EngineScenes.Kind.PROBE:
		scene.add_probe(view)
		await _settle(EngineScenes.SETTLING[kind])
	var godots := await _show(view, scene, EngineScenes.make_materials(true))
	var ours := await _show(view, scene, _make_lobes(true, 0))
	_add_tile(godots, Vector2i(column, 1), "Godot's material")
	_add_tile(ours, Vector2i(column, 0), EngineScenes.TITLES[kind] + ": LobeMaterial3D")
	var mask := await _find_subjects(view, scene)
	godots = await _show(view, scene, EngineScenes.make_materials(false))
	for source: String in LobeMaterial3D.DiffuseLight:
		var materials := _make_lobes(false, LobeMaterial3D.DiffuseLight[source])
		ours = await _show(view, scene, materials)
		var differences := _differences(ours, godots, mask)
		var material: LobeMaterial3D = materials[0]
		var taken := (
			"the engine's"
			if "ENGINE_DIFFUSE" in material.get_shader_code()
			else "the environment's"
		)
		if source != "AUTOMATIC":
			taken = ""
		_tell(EngineScenes.TITLES[kind], source.capitalize(), differences, taken)
	view.queue_free()
	# The light lingers for some frames.
	await _settle(6)


func _settle(frames: int) -> void:
	for frame in frames:
		await RenderingServer.frame_post_draw


func _make_lobes(with_specular: bool, source: int) -> Array:
	return EngineScenes.make_materials(with_specular).map(
		func(godots: StandardMaterial3D) -> LobeMaterial3D:
			var made := LobeMaterial3D.from_standard(godots)
			made.diffuse_light = source as LobeMaterial3D.DiffuseLight
			return made
	)


# What is seen, as the display shows it.
func _show(view: SubViewport, scene: EngineScenes, materials: Array) -> Image:
	scene.dress(materials)
	await _settle(SWITCHING)
	var image := view.get_texture().get_image()
	image.convert(Image.FORMAT_RGBF)
	return image


# The pixels of the subjects, from two pictures of them in different colours.
func _find_subjects(view: SubViewport, scene: EngineScenes) -> PackedByteArray:
	var images: Array[Image] = []
	for colour: Color in [Color.BLACK, Color(8.0, 8.0, 8.0)]:
		var plain := StandardMaterial3D.new()
		plain.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
		plain.albedo_color = colour
		images.append(await _show(view, scene, [plain, plain, plain]))
	var mask := PackedByteArray()
	for y in TILE.y:
		for x in TILE.x:
			var is_dark := images[0].get_pixel(x, y).v < 0.01
			mask.append(1 if is_dark and images[1].get_pixel(x, y).v > 0.9 else 0)
	return mask


# Of the largest of the channels, of 255, sorted.
func _differences(ours: Image, godots: Image, mask: PackedByteArray) -> PackedFloat32Array:
	var differences := PackedFloat32Array()
	for y in TILE.y:
		for x in TILE.x:
			if mask[y * TILE.x + x]:
				var a := _displayed(ours.get_pixel(x, y))
				var b := _displayed(godots.get_pixel(x, y))
				var apart := (Vector3(a.r, a.g, a.b) - Vector3(b.r, b.g, b.b)).abs()
				differences.append(255.0 * apart[apart.max_axis_index()])
	differences.sort()
	return differences


static func _displayed(colour: Color) -> Color:
	if RenderingServer.get_current_rendering_method() != "gl_compatibility":
		colour = colour.linear_to_srgb()
	return colour.clamp()


func _tell(title: String, source: String, differences: PackedFloat32Array, taken: String) -> void:
	var sum := 0.0
	for difference in differences:
		sum += difference
	var mean := sum / differences.size()
	var most := differences[int(0.99 * differences.size())]
	var verdict := "within" if mean <= MEAN and most <= MOST else "beyond"
	if taken:
		source += " (%s)" % taken
	print(
		(
			"  %-24s %-28s %6.2f %6.2f  %s %.0f and %.0f"
			% [title, source, mean, most, verdict, MEAN, MOST]
		)
	)


func _add_tile(image: Image, tile: Vector2i, title: String) -> void:
	var picture := TextureRect.new()
	picture.texture = ImageTexture.create_from_image(image)
	picture.position = TILE * tile
	_sheet.add_child(picture)
	var label := Label.new()
	label.text = title
	label.position = TILE * tile + Vector2i(8, 4)
	label.add_theme_font_size_override(&"font_size", 12)
	label.add_theme_color_override(&"font_outline_color", Color.BLACK)
	label.add_theme_constant_override(&"outline_size", 5)
	_sheet.add_child(label)
