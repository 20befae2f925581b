@tool
extends Object
## What keeps a scene from looking as it could, each in a sentence or two that say what to do.

const Pyramid := preload("../../runtime/pyramid.gd")
const SceneUsage := preload("../menu/scene_usage.gd")

# A panorama of as many texels around shows lamps as boxes on smooth materials.
const _LEAST_PANORAMA := 512


## All that concerns a scene.
static func of_scene(root: Node) -> PackedStringArray:
	var warnings: PackedStringArray = []
	var usage: SceneUsage = SceneUsage.of(root)
	if usage.environments.is_empty() and not usage.materials.is_empty():
		warnings.append(_without_environment())
	for environment in usage.environments:
		warnings.append_array(of_environment(environment, root))
	for material in usage.materials:
		warnings.append_array(_of_properties(material))
	for instance in usage.without_tangents:
		warnings.append("%s: its mesh has no tangents." % root.get_path_to(instance))
	return warnings


## Of a material as it is used in a scene, which may be null.
static func of_material(material: LobeMaterial3D, root: Node) -> PackedStringArray:
	var warnings := _of_properties(material)
	if root != null and not SceneUsage.has_environment(root):
		warnings.append(_without_environment())
	return warnings


static func of_environment(environment: LobeEnvironment3D, root: Node) -> PackedStringArray:
	var warnings: PackedStringArray = []
	var takes_panorama := environment.panorama != null
	if environment.source != LobeEnvironment3D.Source.AUTOMATIC:
		takes_panorama = environment.source == LobeEnvironment3D.Source.PANORAMA
	if takes_panorama:
		warnings.append_array(_of_panorama(environment.panorama))
	elif environment.source != LobeEnvironment3D.Source.CAPTURE:
		if root != null and not has_sky(root):
			warnings.append(
				"The scene has no sky: add a WorldEnvironment with a sky, or set Panorama."
			)
	if is_compatibility():
		var is_live := environment.update_mode == LobeEnvironment3D.UpdateMode.EVERY_FRAME
		if is_live or environment.source == LobeEnvironment3D.Source.CAPTURE:
			warnings.append(
				(
					"In Compatibility, every update waits for the GPU: set Update Mode to Once or "
					+ "Time Sliced, and a small Size."
				)
			)
	return warnings


## Whether something in the scene has a background: a sky or a colour.
static func has_sky(node: Node) -> bool:
	var environment: Environment
	if node is WorldEnvironment:
		environment = (node as WorldEnvironment).environment
	elif node is Camera3D:
		environment = (node as Camera3D).environment
	if environment != null:
		var is_sky := environment.background_mode == Environment.BG_SKY
		if is_sky and environment.sky != null:
			return true
		if environment.background_mode in [Environment.BG_COLOR, Environment.BG_CLEAR_COLOR]:
			return true
	for child in node.get_children():
		if has_sky(child):
			return true
	return false


static func is_compatibility() -> bool:
	return RenderingServer.get_current_rendering_method() == "gl_compatibility"


static func _without_environment() -> String:
	return (
		"The scene has no LobeEnvironment3D, so LobeMaterial3Ds show a neutral map: add one, and it "
		+ "takes the light of the scene's sky."
	)


static func _of_panorama(panorama: Texture2D) -> PackedStringArray:
	var warnings: PackedStringArray = []
	# Without one the node itself warns.
	if panorama == null or panorama.get_width() < 1:
		return warnings
	if panorama.get_width() < _LEAST_PANORAMA:
		(
			warnings
			. append(
				(
					"The panorama is only %d texels wide, which smooth materials show: take one of 1024."
					% panorama.get_width()
				)
			)
		)
	if _format_of(panorama) not in Pyramid.LINEAR_FORMATS:
		(
			warnings
			. append(
				(
					"The panorama has no values above 1, so lamps do not glare: take an .exr or .hdr, and "
					+ "for files that Godot refuses the importer Panorama (Lobelight)."
				)
			)
		)
	return warnings


# Not that of its image, for which all texels would be read back from the GPU at every look.
# Without a renderer, only the texture itself knows.
static func _format_of(panorama: Texture2D) -> Image.Format:
	var texture := panorama as ImageTexture
	if texture != null:
		return texture.get_format()
	return RenderingServer.texture_get_format(panorama.get_rid())


static func _of_properties(material: LobeMaterial3D) -> PackedStringArray:
	var warnings: PackedStringArray = []
	if material.table != null and not material.table.get_problem().is_empty():
		warnings.append("The material's table has no lobes yet: open it and press Bake.")
	if material.table_set != null and not material.table_set.get_problem().is_empty():
		warnings.append("The material's set of tables cannot be used: choose one of the addon's.")
	if is_compatibility() and material.transparency == LobeMaterial3D.Transparency.ALPHA_HASH:
		warnings.append("Compatibility has no alpha hash and blends instead: take Alpha Scissor.")
	return warnings
