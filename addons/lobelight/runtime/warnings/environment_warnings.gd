@tool
extends Object
## What keeps a [LobeEnvironment3D] from lighting its scene as it could, each in a sentence or two
## that say what to do. The scene tree and the inspector show them; players never look.

const LightSettings := preload("../light/light_settings.gd")
const Pyramid := preload("../pyramid/pyramid.gd")

# A panorama of as many texels around shows lamps as boxes on smooth materials.
const _LEAST_PANORAMA := 512
# A smooth material shows the texels of a smaller cube.
const _LEAST_SIZE := 64


## All of a node's; [param root] is the scene around it, [code]null[/code] where none is known.
static func of(environment: LobeEnvironment3D, root: Node) -> PackedStringArray:
	var warnings: PackedStringArray = []
	if environment.is_inside_tree() and environment.is_visible_in_tree():
		if not environment.is_active():
			warnings.append(
				"Another LobeEnvironment3D lights this world; this one waits for it to go."
			)
	if environment.energy == 0.0:
		warnings.append("Energy is 0, so LobeMaterial3Ds reflect nothing: set it to 1.")
	if environment.light != null:
		var problem := environment.light.get_problem()
		if problem.is_empty():
			return warnings
		warnings.append("Until then the light is live. " + problem)
	if environment.size > 0 and environment.size < _LEAST_SIZE:
		warnings.append(
			"Size is only %d texels, which smooth materials show: take 256." % environment.size
		)
	var source := LightSettings.decide(
		environment.source as LightSettings.Source, environment.panorama != null
	)
	if source == LightSettings.Source.PANORAMA:
		warnings.append_array(_of_own_panorama(environment.panorama))
	elif source == LightSettings.Source.CAPTURE:
		warnings.append_array(_of_capture(environment, root))
	elif root != null:
		warnings.append_array(_of_sky(root))
		if environment.update_mode == LobeEnvironment3D.UpdateMode.WHEN_CHANGED:
			warnings.append_array(_of_unseen_changes(root))
	if is_compatibility() and environment.update_mode == LobeEnvironment3D.UpdateMode.EVERY_FRAME:
		warnings.append(
			(
				"In Compatibility, every update waits for the GPU: set Update Mode to Once or Time "
				+ "Sliced, and a small Size."
			)
		)
	return warnings


static func is_compatibility() -> bool:
	return RenderingServer.get_current_rendering_method() == "gl_compatibility"


static func _of_own_panorama(panorama: Texture2D) -> PackedStringArray:
	if panorama == null:
		return ["Set a panorama; until then LobeMaterial3Ds show a neutral map."]
	if panorama.get_width() < 1 or panorama.get_height() < 1:
		return ["The panorama is empty: import its file again, or take another one."]
	return _of_panorama(panorama, "panorama")


static func _of_capture(environment: LobeEnvironment3D, root: Node) -> PackedStringArray:
	if environment.capture_far <= environment.capture_near:
		return ["Far of the capture is not beyond Near, so nothing is captured: set it to 1000 m."]
	if root == null or not _find_backgrounds(root).is_empty():
		return []
	for node: GeometryInstance3D in root.find_children("*", "GeometryInstance3D", true, false):
		if node.layers & environment.capture_cull_mask:
			return []
	return [
		"There is nothing to capture: the scene has no sky, and nothing on the Cull Mask's layers."
	]


static func _of_sky(root: Node) -> PackedStringArray:
	var backgrounds := _find_backgrounds(root)
	if backgrounds.is_empty():
		return ["The scene has no sky: add a WorldEnvironment with a sky, or set Panorama."]
	var warnings: PackedStringArray = []
	for background in backgrounds:
		if background.background_mode == Environment.BG_CLEAR_COLOR and background.sky == null:
			warnings.append(
				"The background is the clear colour, which smooth metals vanish in: set it to Sky."
			)
		if background.background_mode != Environment.BG_SKY:
			continue
		var material := background.sky.sky_material as PanoramaSkyMaterial
		if material == null:
			continue
		if material.panorama == null:
			warnings.append("The sky's panorama is not set, so the sky is black.")
		else:
			warnings.append_array(_of_panorama(material.panorama, "sky's panorama"))
	return warnings


# The engine keeps the values of global uniforms from games.
static func _of_unseen_changes(root: Node) -> PackedStringArray:
	var declared := RegEx.create_from_string("\\bglobal\\s+uniform\\b")
	for background in _find_backgrounds(root):
		var sky := background.sky if background.background_mode == Environment.BG_SKY else null
		var material := sky.sky_material as ShaderMaterial if sky != null else null
		if material != null and material.shader != null:
			if declared.search(material.shader.code) != null:
				return [
					(
						"The sky's shader reads a global uniform, whose changes nothing tells of: call "
						+ "rebuild() after them, or set Update Mode to Time Sliced."
					)
				]
	return []


# What in the scene, as far as it says so, gives it a background: skies and colours.
static func _find_backgrounds(root: Node) -> Array[Environment]:
	var nodes := root.find_children("*", "WorldEnvironment", true, false)
	nodes.append_array(root.find_children("*", "Camera3D", true, false))
	nodes.append(root)
	var found: Array[Environment] = []
	for node in nodes:
		var environment: Environment
		if node is WorldEnvironment:
			environment = (node as WorldEnvironment).environment
		elif node is Camera3D:
			environment = (node as Camera3D).environment
		if environment == null:
			continue
		var is_sky := environment.background_mode == Environment.BG_SKY
		var is_color := (
			environment.background_mode in [Environment.BG_COLOR, Environment.BG_CLEAR_COLOR]
		)
		if is_color or is_sky and environment.sky != null:
			found.append(environment)
	return found


static func _of_panorama(panorama: Texture2D, what: String) -> PackedStringArray:
	var warnings: PackedStringArray = []
	var width := panorama.get_width()
	if width < _LEAST_PANORAMA:
		warnings.append(
			(
				"The %s is only %d texels wide, which smooth materials show: take one of 1024."
				% [what, width]
			)
		)
	if _format_of(panorama) not in Pyramid.LINEAR_FORMATS:
		(
			warnings
			. append(
				(
					(
						"The %s has no values above 1, so lamps do not glare: take an .exr or .hdr, and for "
						+ "files that Godot refuses the importer Panorama (Lobelight)."
					)
					% what
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
