@tool
extends GdUnitTestSuite
## Materials have their shaders when Godot's shader baker asks for them: right after they were
## loaded, in an export that bakes shaders.

const ExportPlugin := preload("res://addons/lobelight/editor/export/export_plugin.gd")
const FILE := "user://baked_shader.tres"


func after_test() -> void:
	DirAccess.remove_absolute(FILE)


func test_a_loaded_material_has_its_shader() -> void:
	var plugin := ExportPlugin.new()
	# The engine sorts them; its own is called so.
	assert_bool(plugin._get_name() < "ShaderBaker").is_true()
	assert_bool(plugin._begin_customize_resources(null, ["mobile"])).is_false()
	assert_bool(plugin._begin_customize_resources(null, ["shader_baker"])).is_true()
	var material := LobeMaterial3D.new()
	material.metallic = 0.5
	material.emission_enabled = true
	material.emission = Color.RED
	ResourceSaver.save(material, FILE)
	var loaded: LobeMaterial3D = ResourceLoader.load(FILE, "", ResourceLoader.CACHE_MODE_IGNORE)
	assert_object(plugin._customize_resource(loaded, FILE)).is_null()
	assert_str(loaded._shader.code).is_equal(loaded.get_shader_code())
	assert_str(loaded._shader.code).contains("LOBELIGHT_EMISSION")
