extends GdUnitTestSuite
## LobeMaterial3D as a resource: variants, files, life time. What it draws, tests/render says.

const FILES := [["user://material_test.tres"], ["user://material_test.res"]]
const FEATURES: PackedStringArray = [
	"ALBEDO_TEXTURE",
	"ALPHA",
	"ALPHA_HASH",
	"AO",
	"AO_TEXTURE",
	"COAT",
	"DEEP_PARALLAX",
	"DETAIL",
	"DETAIL_ALBEDO",
	"DETAIL_MASK",
	"DETAIL_NORMAL",
	"DETAIL_ON_UV2",
	"DIELECTRIC",
	"EMISSION",
	"FACING",
	"FLOWMAP",
	"GROW",
	"NORMAL_TEXTURE",
	"PARALLAX",
	"ROUGHNESS_TEXTURE",
	"TRIPLANAR",
	"UV2_TRIPLANAR",
	"UV_TRANSFORM",
	"VERTEX_COLOUR",
	"VERTICES",
]
const LightRegistry := preload("res://addons/lobelight/runtime/light/light_registry.gd")


func _make_table(lobes: int, azimuths: int) -> LobeTable:
	var table := LobeTable.new()
	table.lobe_count = lobes
	table.views = Vector2i(3, azimuths)
	table.image = Image.create_empty(3, azimuths * lobes, false, Image.FORMAT_RGBAH)
	return table


func _texture() -> Texture2D:
	return ImageTexture.create_from_image(Image.create_empty(2, 2, false, Image.FORMAT_RGB8))


func test_variants_follow_the_properties() -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	# The ready set.
	assert_str(material.get_shader_code()).contains("#define LOBELIGHT_LOBES 8\n")
	assert_str(material.get_shader_code()).contains("#define LOBELIGHT_ISOTROPIC\n")
	material.table = _make_table(5, 2)
	assert_str(material.get_shader_code()).contains("#define LOBELIGHT_LOBES 5\n")
	assert_bool("LOBELIGHT_ISOTROPIC" in material.get_shader_code()).is_false()
	# What is not used is not in the shader.
	for feature: String in FEATURES:
		(
			assert_bool(feature in material.get_shader_code())
			. append_failure_message(feature)
			. is_false()
		)
	material.albedo_texture = _texture()
	material.normal_texture = _texture()
	material.normal_enabled = true
	material.emission = Color.RED
	material.emission_enabled = true
	material.metallic = 0.0
	material.clearcoat = 0.5
	material.clearcoat_enabled = true
	material.ao_texture = _texture()
	material.ao_enabled = true
	material.roughness_texture = _texture()
	material.anisotropy_flowmap = _texture()
	material.transparency = BaseMaterial3D.TRANSPARENCY_ALPHA_HASH
	material.vertex_color_use_as_albedo = true
	material.uv1_scale = Vector3(2.0, 2.0, 1.0)
	material.uv2_triplanar = true
	material.detail_enabled = true
	material.detail_albedo = _texture()
	material.detail_mask = _texture()
	material.detail_normal = _texture()
	material.detail_uv_layer = BaseMaterial3D.DETAIL_UV_2
	material.heightmap_enabled = true
	material.heightmap_texture = _texture()
	material.heightmap_deep_parallax = true
	material.billboard_mode = BaseMaterial3D.BILLBOARD_ENABLED
	material.grow = true
	material.use_particle_trails = true
	assert_str(material.get_shader_code()).contains("particle_trails")
	for feature: String in FEATURES:
		assert_str(material.get_shader_code()).contains("#define LOBELIGHT_" + feature)
	material.emission_energy_multiplier = 0.0
	assert_bool("EMISSION" in material.get_shader_code()).is_false()


func test_sources_of_a_light_take_another_shader() -> void:
	var material := LobeMaterial3D.new()
	var without := material.get_shader_code()
	material.light = LobeLight.make_dark(true)
	assert_str(material.get_shader_code()).is_equal(without)
	material.light.sources = PlaceholderTexture2D.new()
	var code := "#define LOBELIGHT_SOURCES\n#define LOBELIGHT_SOURCES_GGX\n"
	assert_str(material.get_shader_code()).contains(code)
	assert_str(material.get_shader_code().replace(code, "")).is_equal(without)
	material.table = LobeTable.make_single_lobe()
	assert_str(material.get_shader_code()).contains("#define LOBELIGHT_SOURCES_IN_LOBES\n")
	material.light = null
	assert_str(material.get_shader_code()).not_contains("SOURCES")


func test_a_light_of_its_own_may_come_to_have_sources() -> void:
	# As that of an environment does some frames later.
	var environment: LobeEnvironment3D = auto_free(LobeEnvironment3D.new())
	environment.visible = false
	add_child(environment)
	var light := LobeLight.make_dark(true)
	environment.get(&"_live").set(&"light", light)
	var material := RenderingServer.material_create()
	var asked := [0]
	LightRegistry.add_material(material, func() -> void: asked[0] += 1)
	LightRegistry.set_own_light(material, environment.get_light())
	await await_idle_frame()
	var before: int = asked[0]
	light.sources = PlaceholderTexture2D.new()
	environment.call(&"_on_drawn", true)
	await await_idle_frame()
	assert_int(asked[0]).is_greater(before)
	assert_array(Array(LightRegistry.get_defines(material))).contains(["SOURCES"])
	remove_child(environment)
	LightRegistry.remove_material(material)
	RenderingServer.free_rid(material)


func test_widths_that_cannot_vary_draw_a_line_of_the_material_s_own() -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.3
	material.anisotropy_enabled = true
	material.anisotropy = 1.0
	material.roughness_texture = _texture()
	assert_str(material.get_shader_code()).contains("LOBELIGHT_WIDTHS_PER_PIXEL\n")
	var tables: LobeTableSet = load("res://addons/lobelight/tables/ggx_8.res").duplicate()
	var widths := tables.widths.duplicate()
	widths[1] *= 1.05
	tables.widths = widths
	material.table_set = tables
	assert_str(tables.get_problem()).is_empty()
	assert_str(material.get_shader_code()).contains("LOBELIGHT_LINE 24\n")
	assert_str(material.get_shader_code()).not_contains("LOBELIGHT_WIDTHS_PER_PIXEL")


func test_levels_of_texels_have_a_variant_of_their_own() -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.4
	await get_tree().process_frame
	var define := "#define LOBELIGHT_STRETCHED_LEVELS\n"
	assert_str(material.get_shader_code()).not_contains(define)
	var shader := material._shader
	for is_even: bool in [false, true]:
		var light := LobeLight.new()
		light.cubemap = Cubemap.new()
		light.is_even = is_even
		LightRegistry.offer(get_viewport().find_world_3d(), get_instance_id(), light)
		await get_tree().process_frame
		# The material that is there takes the other variant, and new ones have it from the start.
		assert_bool(material._shader == shader).is_equal(is_even)
		assert_bool(material._shader.code.contains(define)).is_equal(not is_even)
		assert_bool(LobeMaterial3D.new().get_shader_code().contains(define)).is_equal(not is_even)
	LightRegistry.withdraw(get_instance_id())


func test_incomplete_tables_are_stood_in_for() -> void:
	# As the inspector fills a new table in, property by property.
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	var table := LobeTable.new()
	material.table = table
	table.lobe_count = 4
	table.views = Vector2i(3, 1)
	assert_str(material.get_shader_code()).contains("#define LOBELIGHT_LOBES 1\n")
	table.image = Image.create_empty(3, 4, false, Image.FORMAT_RGBAH)
	assert_str(material.get_shader_code()).contains("#define LOBELIGHT_LOBES 4\n")
	table.lobe_count = 5
	assert_str(material.get_shader_code()).contains("#define LOBELIGHT_LOBES 1\n")


func test_files_hold_the_properties_and_no_shader(path: String, _test_parameters := FILES) -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = _make_table(5, 2)
	material.albedo_color = Color(0.9, 0.6, 0.3)
	material.normal_texture = _texture()
	material.normal_enabled = true
	material.normal_scale = 0.5
	material.anisotropy_rotation = 0.25
	material.emission = Color(0.1, 0.2, 0.3)
	material.emission_enabled = true
	material.emission_energy_multiplier = 2.0
	assert_int(ResourceSaver.save(material, path)).is_equal(OK)
	var loaded: LobeMaterial3D = ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE)
	assert_str(loaded.get_shader_code()).is_equal(material.get_shader_code())
	assert_that(loaded.albedo_color).is_equal(material.albedo_color)
	assert_float(loaded.normal_scale).is_equal(0.5)
	assert_float(loaded.anisotropy_rotation).is_equal(0.25)
	assert_that(loaded.emission).is_equal(material.emission)
	assert_float(loaded.emission_energy_multiplier).is_equal(2.0)
	assert_object(loaded.next_pass).is_null()
	var text := FileAccess.get_file_as_bytes(path).get_string_from_ascii()
	if path.ends_with(".tres"):
		assert_str(text).contains("normal_scale = 0.5")
		for word: String in ["shader_parameter", "Cubemap", "LOBELIGHT_", 'type="Shader"']:
			assert_bool(word in text).append_failure_message(word).is_false()
	DirAccess.remove_absolute(path)


func test_inspector_shows_no_shader() -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.4
	var shown: Array[String] = []
	for property in material.get_property_list():
		if property["usage"] & (PROPERTY_USAGE_EDITOR | PROPERTY_USAGE_STORAGE):
			shown.append(property["name"])
	assert_array(shown).contains(
		["table", "table_set", "albedo_color", "next_pass", "render_priority"]
	)
	assert_array(shown).not_contains(["shader"])
	for name in shown:
		assert_bool(name.begins_with("shader_parameter/")).is_false()


func test_copies_are_independent() -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = _make_table(5, 2)
	var copy := material.duplicate() as LobeMaterial3D
	assert_object(copy.table).is_same(material.table)
	copy.table = null
	assert_str(material.get_shader_code()).contains("#define LOBELIGHT_LOBES 5\n")
	assert_str(copy.get_shader_code()).contains("#define LOBELIGHT_LOBES 8\n")


func test_materials_and_tables_are_freed() -> void:
	var before: int = LightRegistry._materials.size()
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = _make_table(5, 2)
	var table: WeakRef = weakref(material.table)
	var reference: WeakRef = weakref(material)
	await await_idle_frame()
	assert_int(LightRegistry._materials.size()).is_equal(before + 1)
	material = null
	assert_object(reference.get_ref()).is_null()
	assert_object(table.get_ref()).is_null()
	assert_int(LightRegistry._materials.size()).is_equal(before)


func test_materials_of_a_kind_share_their_shader() -> void:
	var first := LobeMaterial3D.new()
	first.metallic = 1.0
	var second := LobeMaterial3D.new()
	second.metallic = 1.0
	first.table = _make_table(5, 2)
	second.table = _make_table(5, 3)
	await await_idle_frame()
	assert_object(first._shader).is_not_null()
	assert_object(first._shader).is_same(second._shader)
	second.table = _make_table(5, 1)
	await await_idle_frame()
	assert_bool(first._shader == second._shader).is_false()


func test_widths_are_godots() -> void:
	# Burley 2012: r² / aspect and r² · aspect, aspect = sqrt(1 - 0.9 a).
	for case: Array in [
		[0.5, 0.0, Vector2(0.25, 0.25)],
		[0.5, 1.0, Vector2(0.25 / sqrt(0.1), 0.25 * sqrt(0.1))],
		[0.3, -1.0, Vector2(0.09 / sqrt(1.9), 0.09 * sqrt(1.9))],
		[0.4, 1.1, Vector2(1.6, 0.016)],
	]:
		var widths := LobeMaterial3D.widths_of(case[0], case[1])
		assert_vector(widths).is_equal_approx(case[2] as Vector2, 1e-5 * Vector2.ONE)
		var back := LobeMaterial3D.Widths.to_roughness(widths)
		assert_vector(back).is_equal_approx(Vector2(case[0], case[1]), 1e-5 * Vector2.ONE)
	var turned := LobeMaterial3D.Widths.exchanged(-0.7)
	var widths := LobeMaterial3D.widths_of(0.6, -0.7)
	assert_vector(LobeMaterial3D.widths_of(0.6, turned)).is_equal_approx(
		Vector2(widths.y, widths.x), 1e-5 * Vector2.ONE
	)


func test_equal_materials_share_their_table() -> void:
	var first := LobeMaterial3D.new()
	first.metallic = 1.0
	first.roughness = 0.4
	var second := LobeMaterial3D.new()
	second.metallic = 1.0
	for material: LobeMaterial3D in [first, second]:
		material.roughness = 0.35
		material.anisotropy = 0.8
		material.anisotropy_enabled = true
		material.get_shader_code()
	assert_object(first._choice.table).is_not_null()
	assert_object(first._choice.table).is_same(second._choice.table)
	assert_vector(first._choice.table.alpha).is_equal_approx(
		LobeMaterial3D.widths_of(0.35, 0.8), 1e-3 * Vector2.ONE
	)
	second.roughness = 0.4
	second.get_shader_code()
	assert_bool(first._choice.table == second._choice.table).is_false()


func test_fetches_are_counted() -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.4
	assert_dict(material.get_fetches()).is_equal({"environment": 8, "table": 8, "samplers": 2})
	material.roughness_texture = _texture()
	assert_dict(material.get_fetches()).is_equal({"environment": 8, "table": 8, "samplers": 2})
	material.anisotropy = 0.5
	material.anisotropy_enabled = true
	assert_dict(material.get_fetches()).is_equal({"environment": 8, "table": 16, "samplers": 2})
	material.metallic = 0.0
	material.clearcoat = 1.0
	material.clearcoat_enabled = true
	assert_dict(material.get_fetches()).is_equal({"environment": 18, "table": 20, "samplers": 3})


func test_questions_leave_what_is_drawn() -> void:
	# By its number: a reference would keep it.
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.37
	material.anisotropy = 0.7
	material.anisotropy_enabled = true
	material.clearcoat = 1.0
	material.clearcoat_enabled = true
	await await_idle_frame()
	var table := material._choice.table.get_instance_id()
	var coat := material._choice.coat.get_instance_id()
	material.needs_tangents()
	material.get_fetches()
	material.get_shader_code()
	assert_int(material._choice.table.get_instance_id()).is_equal(table)
	assert_int(material._choice.coat.get_instance_id()).is_equal(coat)
