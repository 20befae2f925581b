extends GdUnitTestSuite
## What the properties of shading, blending and depth do: the same as those of Godot's own
## material, where both have the same light, that of lamps.
##
## A sphere of one material and then of the other, and around it what the properties need: something
## before it, through it and behind it.

const Kit := preload("support/render_kit.gd")
const SIDE := 48
# A picture that is like another one, and one that is not, in decibels.
const ALIKE := 40.0
const CHANGED := 55.0
# Where little light shines through; equal pictures have 120.
const FAINT := 100.0

## What to set, one after the other: each of them has to change the picture.
const CASES := [
	["unshaded", [{"shading_mode": BaseMaterial3D.SHADING_MODE_UNSHADED}]],
	["per vertex", [{"shading_mode": BaseMaterial3D.SHADING_MODE_PER_VERTEX}]],
	[
		"lambert",
		[
			{"diffuse_mode": BaseMaterial3D.DIFFUSE_LAMBERT_WRAP},
			{"specular_mode": BaseMaterial3D.SPECULAR_DISABLED},
		]
	],
	[
		"toon",
		[
			{"specular_mode": BaseMaterial3D.SPECULAR_TOON},
			{"diffuse_mode": BaseMaterial3D.DIFFUSE_TOON},
		]
	],
	["depth draw", [{"depth_draw_mode": BaseMaterial3D.DEPTH_DRAW_DISABLED}]],
	["no depth test", [{"no_depth_test": true}]],
	["depth test", [{"depth_test": BaseMaterial3D.DEPTH_TEST_INVERTED}]],
	[
		"rim",
		[
			{"rim_enabled": true},
			{"rim_tint": 1.0},
			{"rim": 0.6},
			{"rim_texture": "half"},
		]
	],
	[
		"backlight",
		[
			{"backlight_enabled": true, "backlight": Color(0.7, 0.4, 0.1)},
			{"backlight": Color(0.1, 0.3, 0.5)},
			{"backlight_texture": "half"},
		]
	],
	[
		"refraction",
		[
			{
				"refraction_enabled": true,
				"albedo_color": Color(0.7, 0.8, 0.9, 0.0),
				"roughness": 0.1
			},
			{"refraction_scale": 0.3},
			{"refraction_texture": "half"},
			{"refraction_texture_channel": BaseMaterial3D.TEXTURE_CHANNEL_GREEN},
			{"roughness": 0.6},
		]
	],
	[
		"proximity fade",
		[
			{"proximity_fade_enabled": true, "proximity_fade_distance": 0.5},
			{"proximity_fade_distance": 1.4},
		]
	],
	[
		"distance fade",
		[
			{"distance_fade_mode": BaseMaterial3D.DISTANCE_FADE_PIXEL_ALPHA},
			{"distance_fade_min_distance": 2.5},
			{"distance_fade_max_distance": 4.5},
		]
	],
	[
		"pixel dither",
		[
			{
				"distance_fade_mode": BaseMaterial3D.DISTANCE_FADE_PIXEL_DITHER,
				"distance_fade_max_distance": 6.0
			},
			{"distance_fade_max_distance": 4.5},
		]
	],
	[
		"object dither",
		[
			{
				"distance_fade_mode": BaseMaterial3D.DISTANCE_FADE_OBJECT_DITHER,
				"distance_fade_max_distance": 6.0
			},
		]
	],
	[
		"stencil",
		[
			{
				"stencil_mode": BaseMaterial3D.STENCIL_MODE_CUSTOM,
				"stencil_flags": BaseMaterial3D.STENCIL_FLAG_WRITE,
				"stencil_reference": 3
			},
			{
				"transparency": BaseMaterial3D.TRANSPARENCY_ALPHA,
				"stencil_flags": BaseMaterial3D.STENCIL_FLAG_READ,
				"stencil_compare": BaseMaterial3D.STENCIL_COMPARE_EQUAL,
				"stencil_reference": 5
			},
			{"stencil_compare": BaseMaterial3D.STENCIL_COMPARE_NOT_EQUAL},
		]
	],
	[
		"outline",
		[
			{
				"stencil_mode": BaseMaterial3D.STENCIL_MODE_OUTLINE,
				"stencil_color": Color.RED,
				"stencil_outline_thickness": 0.1
			},
			{"stencil_color": Color.GREEN},
			{"stencil_outline_thickness": 0.02},
			{"stencil_mode": BaseMaterial3D.STENCIL_MODE_XRAY},
		]
	],
]

var _view: LinearViewport
var _environment: LobeEnvironment3D
var _sphere: MeshInstance3D
var _textures: Dictionary[String, Texture2D] = {}


func before() -> void:
	_textures["half"] = _paint(func(x: int, _y: int) -> Color: return Color(0.1 * x, 0.5, 0.2))
	# A disc with a soft edge.
	_textures["disc"] = _paint(
		func(x: int, y: int) -> Color:
			var distance := 0.5 + (3.0 - Vector2(x - 3.5, y - 3.5).length()) / 8.0
			return Color(0.8, 0.6, 0.4, distance)
	)


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_environment = LobeEnvironment3D.new()
	_view.add_child(_environment)
	_environment.panorama = Kit.constant(0.0)
	await _environment.rebuild()
	_sphere = Kit.make_sphere(null, 24)
	_sphere.scale = 0.8 * Vector3.ONE
	_view.add_child(_sphere)
	_add_surroundings()


func after_test() -> void:
	_view.free()
	# Its light lingers.
	for frame in 3:
		await await_idle_frame()


func test_properties_do_what_godots_do(
	name: String, steps: Array, _test_parameters := CASES
) -> void:
	var ours := LobeMaterial3D.new()
	var godots := StandardMaterial3D.new()
	_set_up(ours)
	_set_up(godots)
	var before := await _draw(ours)
	for step: Dictionary in steps:
		_assign(ours, step)
		_assign(godots, step)
		var got := await _draw(ours)
		_expect_alike(got, await _draw(godots), "%s %s" % [name, step])
		_expect_changed(got, before, "%s %s" % [name, step])
		before = got


func test_refraction_behind_a_colour() -> void:
	# Compatibility multiplies Godot's colours as they are, in sRGB; ours are linear there too.
	var clear := {"refraction_enabled": true, "roughness": 0.1}
	await _compare(
		{"albedo_color": Color(0.7, 0.8, 0.9, 0.3)}, clear, not LinearViewport.is_compatibility()
	)


func test_fog() -> void:
	var surroundings := _view.camera.environment
	surroundings.fog_enabled = true
	surroundings.fog_light_color = Color.WHITE
	surroundings.fog_density = 0.2
	await _compare({"disable_fog": true})


func test_shadows() -> void:
	_add_shadows()
	await _compare({"disable_receive_shadows": true})


func test_shadows_make_opaque() -> void:
	# The engine takes the opacity from its ambient light, less what lamps light.
	var surroundings := _view.camera.environment
	surroundings.ambient_light_source = Environment.AMBIENT_SOURCE_COLOR
	surroundings.ambient_light_color = Color.WHITE
	_add_shadows()
	await _compare({"shadow_to_opacity": true})


func test_no_light_of_the_surroundings() -> void:
	_environment.panorama = Kit.constant(1.0)
	await _environment.rebuild()
	var surroundings := _view.camera.environment
	surroundings.ambient_light_source = Environment.AMBIENT_SOURCE_COLOR
	surroundings.ambient_light_color = Color.WHITE
	await _compare({"disable_ambient_light": true})


func test_edges_of_alpha() -> void:
	_view.msaa_3d = Viewport.MSAA_4X
	var scissor := {
		"transparency": BaseMaterial3D.TRANSPARENCY_ALPHA_SCISSOR, "albedo_texture": "disc"
	}
	var to_coverage := BaseMaterial3D.ALPHA_ANTIALIASING_ALPHA_TO_COVERAGE
	if LinearViewport.is_compatibility():
		# It has none.
		scissor["alpha_antialiasing_mode"] = to_coverage
		await _compare({"alpha_scissor_threshold": 0.7}, scissor)
		return
	await _compare({"alpha_antialiasing_mode": to_coverage}, scissor)
	scissor["alpha_antialiasing_mode"] = to_coverage
	await _compare({"alpha_antialiasing_edge": 0.05}, scissor)


func test_light_below_the_surface() -> void:
	if RenderingServer.get_current_rendering_method() != "forward_plus":
		await _expect_nothing_below_the_surface()
		return
	# With a transparent background the engine leaves it out.
	_view.transparent_bg = false
	RenderingServer.sub_surface_scattering_set_scale(0.4, 0.1)
	_add_shadows()
	var spread := {"subsurf_scatter_enabled": true, "subsurf_scatter_strength": 1.0}
	await _compare(spread)
	await _compare({"subsurf_scatter_texture": "half"}, spread)
	await _compare({"subsurf_scatter_skin_mode": true}, spread)
	spread["subsurf_scatter_transmittance_enabled"] = true
	spread["subsurf_scatter_transmittance_boost"] = 0.5
	spread["subsurf_scatter_transmittance_depth"] = 8.0
	await _compare({"subsurf_scatter_transmittance_boost": 1.0}, spread, true, FAINT)
	await _compare({"subsurf_scatter_transmittance_color": Color.RED}, spread, true, FAINT)
	await _compare({"subsurf_scatter_transmittance_depth": 2.0}, spread, true, FAINT)
	await _compare({"subsurf_scatter_transmittance_texture": "half"}, spread, true, FAINT)
	RenderingServer.sub_surface_scattering_set_scale(0.05, 0.01)


# Forward+ alone has it. Mobile of Godot 4.6 refuses the code of Godot's own material.
func _expect_nothing_below_the_surface() -> void:
	var material := LobeMaterial3D.new()
	var before := await _draw(material)
	material.subsurf_scatter_enabled = true
	material.subsurf_scatter_strength = 1.0
	material.subsurf_scatter_transmittance_enabled = true
	_expect_alike(await _draw(material), before, "nothing below the surface")


func test_emission_in_nits() -> void:
	const UNITS := "rendering/lights_and_shadows/use_physical_light_units"
	var glow := {"emission_enabled": true, "emission": Color(0.5, 0.3, 0.2)}
	ProjectSettings.set_setting(UNITS, true)
	glow["emission_intensity"] = 0.8
	await _compare({"emission_intensity": 1.0}, glow)
	ProjectSettings.set_setting(UNITS, false)


func _add_surroundings() -> void:
	var lamp := DirectionalLight3D.new()
	lamp.basis = Basis.looking_at(Vector3(-0.3, -0.5, -1.0))
	lamp.light_energy = 0.5
	_view.add_child(lamp)
	var back := OmniLight3D.new()
	back.position = Vector3(0.4, 0.6, -1.2)
	back.omni_range = 4.0
	_view.add_child(back)
	var behind := _add_box(Vector3(2.0, 2.0, 0.01), Vector3(0.0, 0.0, -1.6), Color.WHITE)
	behind.albedo_texture = _paint(func(x: int, y: int) -> Color: return Color(0.1 * x, 0.1 * y, 0))
	_add_box(Vector3(0.2, 2.0, 0.1), Vector3(-0.5, 0.0, 1.2), Color(0.6, 0.0, 0.0))
	var through := _add_box(Vector3(0.3, 0.3, 2.2), Vector3(0.2, 0.2, -0.6), Color(0.0, 0.0, 0.6))
	through.stencil_mode = BaseMaterial3D.STENCIL_MODE_CUSTOM
	through.stencil_flags = BaseMaterial3D.STENCIL_FLAG_WRITE
	through.stencil_reference = 5
	# Drawn after the sphere: behind it, and before it where the stencil says so.
	var late := _add_box(
		Vector3(1.0, 0.3, 0.01), Vector3(0.0, -0.3, -1.2), Color(0.0, 0.6, 0.0, 0.6)
	)
	late.transparency = BaseMaterial3D.TRANSPARENCY_ALPHA
	late.render_priority = 10
	var reader := _add_box(
		Vector3(1.0, 0.3, 0.01), Vector3(0.0, 0.5, 1.4), Color(0.0, 0.6, 0.6, 0.6)
	)
	reader.transparency = BaseMaterial3D.TRANSPARENCY_ALPHA
	reader.render_priority = 20
	reader.stencil_mode = BaseMaterial3D.STENCIL_MODE_CUSTOM
	reader.stencil_flags = BaseMaterial3D.STENCIL_FLAG_READ
	reader.stencil_compare = BaseMaterial3D.STENCIL_COMPARE_EQUAL
	reader.stencil_reference = 3


func _add_shadows() -> void:
	var lamp := SpotLight3D.new()
	lamp.look_at_from_position(Vector3(-1.2, 0.3, 3.0), Vector3.ZERO)
	lamp.spot_range = 8.0
	lamp.light_energy = 4.0
	lamp.shadow_enabled = true
	_view.add_child(lamp)


func _add_box(size: Vector3, place: Vector3, colour: Color) -> StandardMaterial3D:
	var material := StandardMaterial3D.new()
	material.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	material.albedo_color = colour
	var box := MeshInstance3D.new()
	box.mesh = BoxMesh.new()
	(box.mesh as BoxMesh).size = size
	box.position = place
	box.material_override = material
	_view.add_child(box)
	return material


func _set_up(material: Material) -> void:
	material.set("albedo_color", Color(0.7, 0.8, 0.9))
	material.set("roughness", 0.5)


func _assign(material: Material, values: Dictionary) -> void:
	for name: String in values:
		var value: Variant = values[name]
		material.set(name, _textures[value] if value is String else value)


# Of some values, the same with both materials, and another picture than without.
func _compare(values: Dictionary, given := {}, is_alike := true, changed := CHANGED) -> void:
	var ours := LobeMaterial3D.new()
	var godots := StandardMaterial3D.new()
	for material: Material in [ours, godots]:
		_set_up(material)
		_assign(material, given)
	var before := await _draw(ours)
	_assign(ours, values)
	_assign(godots, values)
	var got := await _draw(ours)
	if is_alike:
		_expect_alike(got, await _draw(godots), str(values))
	_expect_changed(got, before, str(values), changed)


func _draw(material: Material) -> Image:
	_sphere.material_override = material
	# A material asks for its shader at the end of the frame.
	await await_idle_frame()
	return await _view.capture()


func _expect_alike(got: Image, expected: Image, what: String) -> void:
	var found := Kit.psnr(got, expected)
	var message := "%s: %.1f dB from Godot's" % [what, found]
	assert_float(found).append_failure_message(message).is_greater(ALIKE)


func _expect_changed(got: Image, before: Image, what: String, changed := CHANGED) -> void:
	var found := Kit.psnr(got, before)
	var message := "%s: no change, %.1f dB" % [what, found]
	assert_float(found).append_failure_message(message).is_less(changed)


func _paint(colour: Callable) -> ImageTexture:
	var image := Image.create_empty(8, 8, false, Image.FORMAT_RGBA8)
	for y in 8:
		for x in 8:
			var painted: Color = colour.call(x, y)
			image.set_pixel(x, y, painted)
	return ImageTexture.create_from_image(image)
