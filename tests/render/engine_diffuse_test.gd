extends GdUnitTestSuite
## Diffuse light from the engine, and what of the engine acts on diffuse light of ours.

const EngineScenes := preload("res://demo/engine_light/engine_scenes.gd")
const Kit := preload("support/render_kit.gd")
const Oracle := preload("support/material_oracle.gd")
const SIDE := 48
const SETTING := "lobelight/materials/diffuse_light"
const ENVIRONMENT := LobeMaterial3D.DiffuseLight.ENVIRONMENT
const ENGINE := LobeMaterial3D.DiffuseLight.ENGINE
# Seconds until the engine's light is noticed, and frames until its buffers are filled.
const NOTICE := 0.7
const SETTLING := 8

var _view: LinearViewport
var _environment: LobeEnvironment3D
var _sphere: MeshInstance3D
var _tables := Oracle.make_set()


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_environment = LobeEnvironment3D.new()
	_view.add_child(_environment)
	_sphere = Kit.make_sphere(null, 128)
	_view.add_child(_sphere)


func after_test() -> void:
	_view.free()


func test_lamps_show_as_in_godots_material() -> void:
	# In the dark, with lobes that are not compensated: the engine does not compensate where it is told
	# to leave ambient light out.
	await _light(0.0)
	_add_lamps()
	for kind: String in ["matte", "satin", "half metal", "brushed", "across", "coat", "bumps"]:
		var godots := _standard(kind)
		godots.disable_ambient_light = true
		_sphere.material_override = godots
		var expected: Image = await _view.capture()
		var ours := _made_from(godots, ENGINE)
		ours.table_set = _tables
		var widths := LobeMaterial3D.widths_of(ours.roughness, ours.get_shown_anisotropy())
		ours.table = _tables.table_at(widths)
		_sphere.material_override = ours
		var got: Image = await _view.capture()
		_assert_same(got, expected, kind)


func test_energy_that_lobes_lose_counts_in_lamps() -> void:
	# A white metal, but for a trace, in the dark: a lamp's reflection grows by what lobes lose.
	await _light(0.0)
	_add_lamps()
	var ours := LobeMaterial3D.new()
	ours.table_set = _tables
	ours.metallic = 0.999
	ours.roughness = 0.6
	ours.diffuse_light = ENGINE
	_sphere.material_override = ours
	var compensated: Image = await _view.capture()
	ours.table = _tables.table_at(LobeMaterial3D.widths_of(0.6, 0.0))
	var plain: Image = await _view.capture()
	@warning_ignore("integer_division")
	var middle := SIDE / 2
	var lobes := 0.0
	for lobe in ours.table.lobes_at(Vector3.BACK):
		lobes += lobe.weight
	var gain := compensated.get_pixel(middle, middle).g / plain.get_pixel(middle, middle).g
	assert_float(gain).is_equal_approx(1.0 / lobes, 0.01 / lobes)


func test_the_engine_lights_as_it_does_godots() -> void:
	# By what stands still and what is captured; nothing is reflected. ./dev demo --engine-diffuse has
	# all kinds of scenes.
	var view := SubViewport.new()
	view.size = SIDE * Vector2i.ONE
	view.use_hdr_2d = true
	view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	add_child(view)
	var scene := EngineScenes.new(view, EngineScenes.Kind.LIGHTMAP)
	await scene.lobe_environment.rebuild()
	var standard := EngineScenes.make_materials(false)
	scene.dress(standard)
	var expected := await _settled(view)
	var lobes := standard.map(LobeMaterial3D.from_standard)
	scene.dress(lobes)
	var got := await _settled(view)
	# By itself: it was noticed.
	var code: String = lobes[0].get_shader_code()
	assert_str(code).contains("LOBELIGHT_ENGINE_DIFFUSE")
	_assert_same(got, expected, "lightmap", 50.0)
	# It does not come from the environment.
	for material: LobeMaterial3D in lobes:
		material.diffuse_light = ENVIRONMENT
	var other := await _settled(view)
	assert_float(Kit.psnr(other, expected)).is_less(40.0)
	view.free()
	for frame in 6:
		await RenderingServer.frame_post_draw


func test_switches_are_noticed() -> void:
	await _light(0.5)
	var material := LobeMaterial3D.new()
	material.roughness = 0.5
	var before := material.get_shader_code()
	assert_str(before).not_contains("LOBELIGHT_ENGINE").contains("ambient_light_disabled")
	var surroundings := _view.camera.environment
	if _is_forward_plus():
		surroundings.sdfgi_enabled = true
		assert_str(await _noticed(material)).contains("LOBELIGHT_ENGINE_DIFFUSE")
		surroundings.sdfgi_enabled = false
		surroundings.ssil_enabled = true
		assert_str(await _noticed(material)).contains("LOBELIGHT_SCREEN_OCCLUSION")
		surroundings.ssil_enabled = false
		assert_str(await _noticed(material)).is_equal(before)
	var lightmap := LightmapGI.new()
	_view.add_child(lightmap)
	assert_str(await _noticed(material)).is_equal(before)
	lightmap.light_data = LightmapGIData.new()
	var code := await _noticed(material)
	assert_str(code).contains("LOBELIGHT_ENGINE_DIFFUSE").not_contains("ambient_light_disabled")
	# Of metals there is no diffuse light, and some materials say where they take it from.
	material.metallic = 1.0
	assert_str(material.get_shader_code()).not_contains("LOBELIGHT_ENGINE")
	material.metallic = 0.0
	material.diffuse_light = ENVIRONMENT
	assert_str(material.get_shader_code()).is_equal(before)
	material.diffuse_light = LobeMaterial3D.DiffuseLight.AUTOMATIC
	lightmap.visible = false
	assert_str(await _noticed(material)).is_equal(before)
	lightmap.visible = true
	ProjectSettings.set_setting(SETTING, ENVIRONMENT)
	assert_str(await _noticed(material)).is_equal(before)
	ProjectSettings.set_setting(SETTING, ENGINE)
	lightmap.visible = false
	assert_str(await _noticed(material)).contains("LOBELIGHT_ENGINE_DIFFUSE")
	ProjectSettings.set_setting(SETTING, null)
	assert_str(await _noticed(material)).is_equal(before)


func test_screen_occlusion_acts_on_the_environments_light() -> void:
	# A white wall behind the sphere: around it the wall becomes darker, and nothing brighter. In
	# Compatibility the whole picture is darkened, whatever the material; Mobile has no such thing.
	await _light(0.5)
	var material := LobeMaterial3D.new()
	material.metallic_specular = 0.0
	_sphere.material_override = material
	_sphere.scale = 0.5 * Vector3.ONE
	var plane := MeshInstance3D.new()
	plane.mesh = QuadMesh.new()
	plane.position.z = -0.4
	plane.scale = 5.0 * Vector3.ONE
	plane.material_override = material
	_view.add_child(plane)
	_view.camera.set_perspective(40.0, 0.1, 10.0)
	var plain := await _settled(_view)
	assert_float(plain.get_pixel(24, 24).g).is_equal_approx(_shown(0.5), 0.004)
	if not _is_forward_plus():
		return
	var surroundings := _view.camera.environment
	surroundings.ssao_enabled = true
	surroundings.ssao_intensity = 0.0
	var unoccluded := await _settled(_view)
	surroundings.ssao_intensity = 5.0
	var occluded := await _settled(_view)
	assert_str(material.get_shader_code()).contains("LOBELIGHT_SCREEN_OCCLUSION")
	# The environment's light comes through whole: 0.5 in a white furnace.
	assert_float(Kit.psnr(unoccluded, plain)).is_greater(55.0)
	var darkest := 1.0
	var brightest := 0.0
	for y in SIDE:
		for x in SIDE:
			var share := occluded.get_pixel(x, y).g / plain.get_pixel(x, y).g
			darkest = minf(darkest, share)
			brightest = maxf(brightest, share)
	assert_float(darkest).is_less(0.8)
	assert_float(brightest).is_between(0.9, 1.01)


func _is_forward_plus() -> bool:
	return RenderingServer.get_current_rendering_method() == "forward_plus"


# Compatibility's frame buffers hold sRGB.
func _shown(linear: float) -> float:
	return (
		Color(linear, 0.0, 0.0).linear_to_srgb().r if LinearViewport.is_compatibility() else linear
	)


# The picture after the engine's light has been noticed and gathered.
func _settled(view: SubViewport) -> Image:
	view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	await get_tree().create_timer(NOTICE).timeout
	for frame in SETTLING:
		await RenderingServer.frame_post_draw
	var image := view.get_texture().get_image()
	image.convert(Image.FORMAT_RGBAF)
	return image


func _noticed(material: LobeMaterial3D) -> String:
	await get_tree().create_timer(NOTICE).timeout
	return material.get_shader_code()


func _light(value: float) -> void:
	_environment.panorama = Kit.constant(value)
	await _environment.rebuild()


func _add_lamps() -> void:
	var sun := DirectionalLight3D.new()
	sun.basis = Basis.looking_at(Vector3(-0.3, -0.5, -1.0))
	sun.light_color = Color(1.0, 0.9, 0.7)
	_view.add_child(sun)
	var bulb := OmniLight3D.new()
	bulb.position = Vector3(-1.2, 1.0, 1.5)
	bulb.light_specular = 0.7
	bulb.light_energy = 0.5
	_view.add_child(bulb)


func _standard(kind: String) -> StandardMaterial3D:
	var material := StandardMaterial3D.new()
	material.roughness = 0.6
	material.albedo_color = Color(0.9, 0.6, 0.3)
	match kind:
		"matte":
			material.metallic_specular = 0.0
		"satin":
			material.metallic_specular = 0.8
			material.roughness = 0.3
		"half metal":
			material.metallic = 0.5
		"brushed":
			material.metallic = 0.7
			material.anisotropy_enabled = true
			material.anisotropy = 0.4
			material.roughness = 0.5
		"across":
			material.anisotropy_enabled = true
			material.anisotropy = -0.4
			material.roughness = 0.5
		"coat":
			material.clearcoat_enabled = true
			material.clearcoat_roughness = 0.8
		"bumps":
			var image := Image.create_empty(4, 4, false, Image.FORMAT_RGBA8)
			image.fill(Color(0.65, 0.4, 1.0))
			material.normal_enabled = true
			material.normal_texture = ImageTexture.create_from_image(image)
			material.normal_scale = 0.7
	return material


func _made_from(godots: StandardMaterial3D, source: LobeMaterial3D.DiffuseLight) -> LobeMaterial3D:
	var made := LobeMaterial3D.from_standard(godots)
	made.disable_ambient_light = false
	made.diffuse_light = source
	return made


func _assert_same(got: Image, expected: Image, what: String, least := 50.0) -> void:
	var brightest := _brightest(expected)
	var quality := Kit.psnr(got, expected)
	var figures := "%s: %f dB, brightest %f and %f" % [what, quality, _brightest(got), brightest]
	assert_float(brightest).append_failure_message(figures).is_greater(0.05)
	assert_float(quality).append_failure_message(figures).is_greater(least)


func _brightest(image: Image) -> float:
	var most := 0.0
	for y in SIDE:
		for x in SIDE:
			most = maxf(most, image.get_pixel(x, y).r)
	return most
