@tool
extends Object
## The light of a world without a sky, which comes evenly from all sides.

# The backgrounds that are no light.
const _NAMES: Dictionary[Environment.BGMode, String] = {
	Environment.BG_CANVAS: "Canvas",
	Environment.BG_KEEP: "Keep",
	Environment.BG_CAMERA_FEED: "Camera Feed",
}


## Linear, as the engine has its own materials lit by it: its ambient light, which metals reflect
## here, too. (Godot 4.6, render_scene_data_rd.cpp, update_ubo, and the same in
## rasterizer_scene_gles3.cpp.) Where ambient light is disabled, the background is seen, but not
## taken for light by the engine; here it is reflected.
static func of(environment: Environment) -> Color:
	if environment == null:
		return _finish(RenderingServer.get_default_clear_color(), 1.0)
	var mode := environment.background_mode
	var is_colour := mode == Environment.BG_CLEAR_COLOR or mode == Environment.BG_COLOR
	var colour := environment.background_color
	if mode == Environment.BG_CLEAR_COLOR:
		colour = RenderingServer.get_default_clear_color()
	match environment.ambient_light_source:
		Environment.AMBIENT_SOURCE_BG:
			if is_colour:
				return _finish(colour, environment.background_energy_multiplier)
			# A sky that is not there, mixed with the colour.
			if mode == Environment.BG_SKY:
				return _mix(environment)
		Environment.AMBIENT_SOURCE_COLOR:
			return _finish(environment.ambient_light_color, environment.ambient_light_energy)
		Environment.AMBIENT_SOURCE_SKY:
			return _mix(environment)
		_:
			if is_colour:
				# As a camera sees it.
				var factor := environment.background_energy_multiplier
				if ProjectSettings.get_setting(
					"rendering/lights_and_shadows/use_physical_light_units"
				):
					factor *= environment.background_intensity
				return _finish(Color(colour.r * factor, colour.g * factor, colour.b * factor), 1.0)
	return Color.BLACK


## Why that light is none, or shows nothing, and what to do, in a sentence; empty if it is as meant.
static func find_shortage(environment: Environment) -> String:
	if environment == null:
		return (
			"The world has no Environment, so LobeMaterial3Ds reflect the clear colour, which smooth "
			+ "metals vanish in: add a WorldEnvironment with a sky, or set Panorama."
		)
	if not _is_black(of(environment)):
		if (
			environment.background_mode == Environment.BG_CLEAR_COLOR
			and environment.ambient_light_source == Environment.AMBIENT_SOURCE_BG
		):
			return (
				"The Environment's background is the clear colour, which smooth metals vanish in: set "
				+ "its Background Mode to Sky, or this node's Panorama."
			)
		return ""
	var cause := "The background is black"
	if environment.background_mode == Environment.BG_SKY:
		cause = "The Environment's Sky is not set"
	elif _NAMES.has(environment.background_mode):
		cause = "The background %s gives no light" % _NAMES[environment.background_mode]
	return (
		cause
		+ ", so LobeMaterial3Ds are black: set a Sky, the Environment's Ambient Light to Color, or "
		+ "this node's Panorama."
	)


# With a black sky; Compatibility has none then.
static func _mix(environment: Environment) -> Color:
	var left := 1.0 - environment.ambient_light_sky_contribution
	if RenderingServer.get_current_rendering_method() == "gl_compatibility":
		left = 1.0
	return _finish(environment.ambient_light_color, left * environment.ambient_light_energy)


static func _is_black(colour: Color) -> bool:
	return colour.r <= 0.0 and colour.g <= 0.0 and colour.b <= 0.0


# Half floats, and no negative light.
static func _finish(colour: Color, factor: float) -> Color:
	const LARGEST := 65504.0
	var linear := colour.srgb_to_linear() * factor
	return linear.clamp(Color.BLACK, Color(LARGEST, LARGEST, LARGEST))
