extends Node
## Draws scenes and saves what they show and what their materials are, for ./dev diet --acceptance:
## [code]-- FOLDER SCENE…[/code] writes NAME.png and NAME.json for each. Names nothing of the addon,
## which the exported project need not have.

const FRAMES := 12


func _ready() -> void:
	var arguments := OS.get_cmdline_user_args()
	# A scene alone is for ask.gd.
	if arguments.size() > 1:
		_draw.call_deferred(arguments[0], arguments.slice(1))


func _draw(folder: String, scenes: PackedStringArray) -> void:
	for scene in scenes:
		get_tree().change_scene_to_file(scene)
		for frame in FRAMES:
			await get_tree().process_frame
		await RenderingServer.frame_post_draw
		var path := folder.path_join(scene.get_file().get_basename())
		get_viewport().get_texture().get_image().save_png(path + ".png")
		var file := FileAccess.open(path + ".json", FileAccess.WRITE)
		file.store_string(JSON.stringify({"materials": _materials(), "sizes": _sizes()}))
		file.close()
		# Compatibility reports a sky's textures as leaked if the game ends while it is shown.
		get_tree().unload_current_scene()
		await get_tree().process_frame
	get_tree().quit()


func _materials() -> Array[Dictionary]:
	var found: Array[Dictionary] = []
	for node in get_tree().root.find_children("*", "MeshInstance3D", true, false):
		var material := (node as MeshInstance3D).get_active_material(0)
		if material is not ShaderMaterial:
			continue
		# Put together: what names a material's methods may change it, for all that exports know.
		var asks := material.has_method("get_shader" + "_code")
		var frozen := (material as ShaderMaterial).shader
		# Not shaders of the project's own.
		if not asks and (frozen == null or not &"parameters" in material):
			continue
		var code: String = material.call("get_shader" + "_code") if asks else frozen.code
		# In lights with suns.
		var other: Variant = null if asks else material.get("shader_for_" + "sources")
		var sunny := (other as Shader).code if other is Shader else ""
		var fetches: Dictionary = material.call("get_fet" + "ches") if asks else {}
		(
			found
			. append(
				{
					"code": code,
					"fetches": fetches,
					"uniforms": _uniforms(code),
					"uniforms_for_sources": _uniforms(sunny),
					"is_frozen": not asks,
				}
			)
		)
	return found


# Of environments.
func _sizes() -> Array[int]:
	var sizes: Array[int] = []
	for node in get_tree().root.find_children("*", "Node3D", true, false):
		if node.has_method(&"get_sliced_frames"):
			sizes.append(node.get(&"size"))
	return sizes


# Of each uniform its name, and whether it is a texture.
func _uniforms(code: String) -> Dictionary[String, bool]:
	var uniforms: Dictionary[String, bool] = {}
	if code.is_empty():
		return uniforms
	var shader := Shader.new()
	shader.code = code
	for uniform: Dictionary in shader.get_shader_uniform_list():
		uniforms[uniform["name"]] = uniform["type"] == TYPE_OBJECT
	return uniforms
