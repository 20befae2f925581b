extends GdUnitTestSuite
## LobeMaterial3D as a resource: variants, files, life time. What it draws, tests/render says.

const FILES := [["user://material_test.tres"], ["user://material_test.res"]]
const LightRegistry := preload("res://addons/lobelight/runtime/light_registry.gd")


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
	assert_str(material.get_shader_code()).contains("#define LOBELIGHT_LOBES 1\n")
	assert_str(material.get_shader_code()).contains("#define LOBELIGHT_ISOTROPIC\n")
	material.table = _make_table(5, 2)
	assert_str(material.get_shader_code()).contains("#define LOBELIGHT_LOBES 5\n")
	assert_bool("LOBELIGHT_ISOTROPIC" in material.get_shader_code()).is_false()
	# What is not used is not in the shader.
	for feature: String in ["ALBEDO_TEXTURE", "NORMAL_TEXTURE", "EMISSION", "ANISOTROPY_ROTATION"]:
		assert_bool(feature in material.get_shader_code()).is_false()
	material.albedo_texture = _texture()
	material.normal_texture = _texture()
	material.emission = Color.RED
	material.anisotropy_rotation = 0.3
	for feature: String in ["ALBEDO_TEXTURE", "NORMAL_TEXTURE", "EMISSION", "ANISOTROPY_ROTATION"]:
		assert_str(material.get_shader_code()).contains("#define LOBELIGHT_%s\n" % feature)
	material.emission_energy = 0.0
	assert_bool("EMISSION" in material.get_shader_code()).is_false()


func test_incomplete_tables_are_stood_in_for() -> void:
	# As the inspector fills a new table in, property by property.
	var material := LobeMaterial3D.new()
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
	material.table = _make_table(5, 2)
	material.albedo = Color(0.9, 0.6, 0.3)
	material.normal_texture = _texture()
	material.normal_scale = 0.5
	material.anisotropy_rotation = 0.25
	material.emission = Color(0.1, 0.2, 0.3)
	material.emission_energy = 2.0
	assert_int(ResourceSaver.save(material, path)).is_equal(OK)
	var loaded: LobeMaterial3D = ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE)
	assert_str(loaded.get_shader_code()).is_equal(material.get_shader_code())
	assert_that(loaded.albedo).is_equal(material.albedo)
	assert_float(loaded.normal_scale).is_equal(0.5)
	assert_float(loaded.anisotropy_rotation).is_equal(0.25)
	assert_that(loaded.emission).is_equal(material.emission)
	assert_float(loaded.emission_energy).is_equal(2.0)
	assert_object(loaded.next_pass).is_null()
	var text := FileAccess.get_file_as_bytes(path).get_string_from_ascii()
	if path.ends_with(".tres"):
		assert_str(text).contains("normal_scale = 0.5")
		for word: String in ["shader_parameter", "Cubemap", "LOBELIGHT_", 'type="Shader"']:
			assert_bool(word in text).append_failure_message(word).is_false()
	DirAccess.remove_absolute(path)


func test_inspector_shows_no_shader() -> void:
	var material := LobeMaterial3D.new()
	var shown: Array[String] = []
	for property in material.get_property_list():
		if property["usage"] & (PROPERTY_USAGE_EDITOR | PROPERTY_USAGE_STORAGE):
			shown.append(property["name"])
	assert_array(shown).contains(["table", "albedo", "next_pass", "render_priority"])
	assert_array(shown).not_contains(["shader"])
	for name in shown:
		assert_bool(name.begins_with("shader_parameter/")).is_false()


func test_copies_are_independent() -> void:
	var material := LobeMaterial3D.new()
	material.table = _make_table(5, 2)
	var copy := material.duplicate() as LobeMaterial3D
	assert_object(copy.table).is_same(material.table)
	copy.table = null
	assert_str(material.get_shader_code()).contains("#define LOBELIGHT_LOBES 5\n")
	assert_str(copy.get_shader_code()).contains("#define LOBELIGHT_LOBES 1\n")


func test_materials_and_tables_are_freed() -> void:
	var before: int = LightRegistry._materials.size()
	var material := LobeMaterial3D.new()
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
	var second := LobeMaterial3D.new()
	first.table = _make_table(5, 2)
	second.table = _make_table(5, 3)
	await await_idle_frame()
	assert_object(first._shader).is_not_null()
	assert_object(first._shader).is_same(second._shader)
	second.table = _make_table(5, 1)
	await await_idle_frame()
	assert_bool(first._shader == second._shader).is_false()
