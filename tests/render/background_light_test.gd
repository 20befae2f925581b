extends GdUnitTestSuite
## Without a sky, a LobeEnvironment3D has the light that the engine gives its own materials: a matte
## white ball is as bright as Godot's, and metal is not black.

const Kit := preload("support/render_kit.gd")
const SIDE := 32
const NeutralWarning := preload("res://addons/lobelight/runtime/warnings/neutral_warning.gd")
const EvenLight := preload("res://addons/lobelight/runtime/skies/even_light.gd")
const COLOUR := Color(0.2, 0.5, 0.9)
const AMBIENT := Color(0.7, 0.4, 0.2)
# The engine's own picture is of eight bits, and in Compatibility of sRGB.
const OFF := 0.006
# Background, energy, ambient light, whether there is a sky that is not seen; and whether that is
# light.
const CASES := [
	[Environment.BG_COLOR, 1.0, Environment.AMBIENT_SOURCE_BG, true],
	[Environment.BG_COLOR, 0.5, Environment.AMBIENT_SOURCE_BG, true],
	[Environment.BG_CLEAR_COLOR, 1.0, Environment.AMBIENT_SOURCE_BG, true],
	[Environment.BG_CLEAR_COLOR, 2.0, Environment.AMBIENT_SOURCE_BG, true],
	[Environment.BG_COLOR, 1.0, Environment.AMBIENT_SOURCE_COLOR, true],
	[Environment.BG_CANVAS, 1.0, Environment.AMBIENT_SOURCE_COLOR, true],
	[Environment.BG_KEEP, 1.0, Environment.AMBIENT_SOURCE_COLOR, true],
	[Environment.BG_CANVAS, 1.0, Environment.AMBIENT_SOURCE_BG, false],
	[Environment.BG_CANVAS, 1.0, Environment.AMBIENT_SOURCE_DISABLED, false],
	[Environment.BG_SKY, 1.0, Environment.AMBIENT_SOURCE_COLOR, true],
]

var _view: LinearViewport
var _surroundings: Environment
var _ball: MeshInstance3D
var _environment: LobeEnvironment3D


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	# The engine's clear colour is none otherwise.
	_view.transparent_bg = false
	add_child(_view)
	_surroundings = Environment.new()
	_surroundings.background_color = COLOUR
	_surroundings.ambient_light_color = AMBIENT
	_surroundings.ambient_light_energy = 0.8
	_surroundings.tonemap_mode = Environment.TONE_MAPPER_LINEAR
	_view.camera.environment = _surroundings
	_environment = LobeEnvironment3D.new()
	_view.add_child(_environment)
	_ball = Kit.make_sphere(null, 24)
	_view.add_child(_ball)


func after_test() -> void:
	_view.free()


func test_backgrounds(
	mode: Environment.BGMode,
	energy: float,
	source: Environment.AmbientSource,
	is_light: bool,
	_test_parameters := CASES
) -> void:
	_surroundings.background_mode = mode
	_surroundings.background_energy_multiplier = energy
	_surroundings.ambient_light_source = source
	await _assert_as_the_engine(is_light)


func test_a_sky_that_is_missing() -> void:
	_surroundings.background_mode = Environment.BG_SKY
	# Compatibility shows the ambient light's colour then.
	await _assert_as_the_engine(LinearViewport.is_compatibility())
	_surroundings.ambient_light_sky_contribution = 0.25
	await _assert_as_the_engine(true)


func test_no_environment_at_all() -> void:
	_view.camera.environment = null
	if LinearViewport.is_compatibility():
		# There, the engine goes on with the ambient light of what it drew last.
		assert_bool(await _environment.rebuild()).is_true()
		_ball.material_override = _make(1.0)
		var clear := RenderingServer.get_default_clear_color().srgb_to_linear()
		assert_float((await _see()).g).is_equal_approx(clear.g, OFF)
	else:
		await _assert_as_the_engine(true)
	assert_str(EvenLight.find_shortage(null)).contains("add a WorldEnvironment with a sky")


# What is not seen may light.
func test_a_sky_behind_a_colour() -> void:
	_surroundings.background_mode = Environment.BG_COLOR
	_surroundings.ambient_light_source = Environment.AMBIENT_SOURCE_SKY
	_surroundings.ambient_light_sky_contribution = 1.0
	_surroundings.sky = Sky.new()
	var material := PanoramaSkyMaterial.new()
	material.panorama = Kit.constant(0.5)
	_surroundings.sky.sky_material = material
	assert_bool(await _environment.rebuild()).is_true()
	var expected := 0.5
	if LinearViewport.is_compatibility():
		# It takes skies for sRGB.
		expected = Color(0.5, 0.5, 0.5).srgb_to_linear().r
	_ball.material_override = _make(0.0)
	assert_float((await _see()).r).is_equal_approx(expected, OFF)


func test_the_colour_is_followed() -> void:
	_surroundings.background_mode = Environment.BG_COLOR
	_ball.material_override = _make(1.0)
	await _environment.rebuild()
	_surroundings.background_color = Color.WHITE
	for frame in 2:
		await RenderingServer.frame_post_draw
	assert_float((await _see()).r).is_equal_approx(1.0, OFF)
	_environment.energy = 0.5
	assert_float((await _see()).r).is_equal_approx(0.5, OFF)
	assert_int(_environment.get_light().size).is_equal(1)


func test_what_is_said_of_it() -> void:
	assert_str(EvenLight.find_shortage(Environment.new())).contains("Background Mode to Sky")
	_surroundings.background_mode = Environment.BG_COLOR
	assert_str(EvenLight.find_shortage(_surroundings)).is_empty()
	_surroundings.background_color = Color.BLACK
	assert_str(EvenLight.find_shortage(_surroundings)).contains("The background is black")
	_surroundings.background_mode = Environment.BG_CANVAS
	assert_str(EvenLight.find_shortage(_surroundings)).contains("Canvas gives no light")
	# Drawn, it has the engine complain of cameras that are not there.
	_surroundings.background_mode = Environment.BG_CAMERA_FEED
	assert_str(EvenLight.find_shortage(_surroundings)).contains("Camera Feed gives no light")
	_surroundings.background_mode = Environment.BG_SKY
	_surroundings.ambient_light_color = Color.BLACK
	assert_str(EvenLight.find_shortage(_surroundings)).contains("Sky is not set")
	_surroundings.ambient_light_color = AMBIENT
	_surroundings.ambient_light_source = Environment.AMBIENT_SOURCE_COLOR
	assert_str(EvenLight.find_shortage(_surroundings)).is_empty()


func test_a_running_game_is_told_once() -> void:
	_surroundings.background_mode = Environment.BG_CANVAS
	var warnings := Warnings.new()
	OS.add_logger(warnings)
	await _environment.rebuild()
	# Not at once: the sky may come.
	await _frames(2)
	assert_array(warnings.seen).is_empty()
	for repetition in 2:
		_environment._live._tell_time = 0
		await _environment.rebuild()
		await _frames(2)
	OS.remove_logger(warnings)
	assert_int(warnings.seen.size()).is_equal(1)
	assert_str(warnings.seen[0]).contains(str(_environment.get_path()))
	assert_str(warnings.seen[0]).contains("set a Sky")


func test_who_is_told_of_the_neutral_map() -> void:
	var root := Node3D.new()
	add_child(root)
	_ball.reparent(root)
	_environment.free()
	# Lights that have left stay for some frames.
	await _frames(6)
	assert_str(NeutralWarning.find_sentence(root)).is_empty()
	_ball.material_override = _make(1.0)
	assert_str(NeutralWarning.find_sentence(root)).contains(str(_ball.get_path()))
	_ball.hide()
	assert_str(NeutralWarning.find_sentence(root)).is_empty()
	_ball.show()
	var own: LobeMaterial3D = _ball.material_override
	own.light = LobeLight.make_constant(Color.WHITE, true)
	assert_str(NeutralWarning.find_sentence(root)).is_empty()
	own.light = null
	# An environment that has not made its light yet.
	root.add_child(LobeEnvironment3D.new())
	assert_str(NeutralWarning.find_sentence(root)).is_empty()
	root.free()
	await _frames(6)


func _frames(count: int) -> void:
	for frame in count:
		await get_tree().process_frame


func _assert_as_the_engine(is_light: bool) -> void:
	assert_bool(await _environment.rebuild()).is_true()
	var standard := StandardMaterial3D.new()
	standard.metallic_specular = 0.0
	_ball.material_override = standard
	var engine: Color = await _see()
	_ball.material_override = _make(0.0)
	var matte: Color = await _see()
	_ball.material_override = _make(1.0)
	var metal: Color = await _see()
	for channel in 3:
		assert_float(matte[channel]).is_equal_approx(engine[channel], OFF)
		assert_float(metal[channel]).is_equal_approx(engine[channel], OFF)
	assert_bool(metal.g > 0.02).is_equal(is_light)


static func _make(metallic: float) -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.metallic = metallic
	material.metallic_specular = 0.0
	return material


# The addon's.
class Warnings:
	extends Logger
	var seen: PackedStringArray = []

	func _log_error(
		_function: String,
		_file: String,
		_line: int,
		code: String,
		rationale: String,
		_notify: bool,
		_type: int,
		_traces: Array[ScriptBacktrace]
	) -> void:
		var sentence := rationale if rationale else code
		if sentence.begins_with("Lobe"):
			seen.append(sentence)


func _see() -> Color:
	var image: Image = await _view.capture()
	return image.get_pixel(SIDE / 2, SIDE / 2)
