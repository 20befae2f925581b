extends WorldEnvironment
## A sky of day and night in a script on the [WorldEnvironment], as addons for skies do it: it makes
## its [Environment] and [Sky] itself and turns the sun.
##
## A [LobeEnvironment3D] in the scene needs to know nothing of this: its light follows the sky that
## the world shows, in [code]When Changed[/code] by each change that it sees.

## Of the day; the sun is highest at 12.
@export_range(0.0, 24.0, 0.01) var hour := 9.0:
	set(value):
		hour = fposmod(value, 24.0)
		_turn()
## The sky's sun.
@export var sun: DirectionalLight3D

var _sky := ProceduralSkyMaterial.new()


func _ready() -> void:
	environment = Environment.new()
	environment.background_mode = Environment.BG_SKY
	environment.tonemap_mode = Environment.TONE_MAPPER_FILMIC
	environment.sky = Sky.new()
	environment.sky.sky_material = _sky
	# The engine's own blurred map, made anew by each change: LobeMaterial3D does not read it.
	environment.sky.radiance_size = Sky.RADIANCE_SIZE_32
	_turn()


func _turn() -> void:
	if not is_node_ready() and environment == null:
		return
	# 1 at noon, -1 at midnight.
	var height := -cos(TAU * hour / 24.0)
	var day := smoothstep(-0.2, 0.3, height)
	var dusk := clampf(1.0 - absf(height) / 0.35, 0.0, 1.0)
	_sky.sky_top_color = Color(0.02, 0.03, 0.08).lerp(Color(0.2, 0.42, 0.8), day)
	_sky.sky_horizon_color = (Color(0.05, 0.07, 0.13).lerp(Color(0.65, 0.75, 0.85), day).lerp(
		Color(0.95, 0.45, 0.2), 0.7 * dusk
	))
	_sky.ground_bottom_color = Color(0.01, 0.01, 0.015).lerp(Color(0.12, 0.11, 0.1), day)
	_sky.ground_horizon_color = _sky.sky_horizon_color.darkened(0.5)
	if sun != null:
		sun.rotation = Vector3(-asin(clampf(height, -1.0, 1.0)), TAU * hour / 48.0, 0.0)
		sun.light_energy = 1.5 * smoothstep(-0.05, 0.2, height)
		sun.light_color = Color(1.0, 0.95, 0.88).lerp(Color(1.0, 0.55, 0.3), dusk)
