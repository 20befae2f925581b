extends GdUnitTestSuite
## That materials are frozen where nothing changes them and only there, and that they are the same
## then.

const Diet := preload("res://addons/lobelight/editor/export/diet.gd")
const Features := preload("res://addons/lobelight/editor/export/features.gd")
const FlatShader := preload("res://addons/lobelight/editor/export/flat_shader.gd")
const FrozenMaterial := preload("res://addons/lobelight/runtime/frozen/frozen_material.gd")
const FrozenMaterials := preload("res://addons/lobelight/editor/export/frozen_materials.gd")
const OnDemand := preload("res://addons/lobelight/runtime/on_demand.gd")
const ProjectFiles := preload("res://addons/lobelight/editor/export/project_files.gd")
const SCENES := "res://tests/diet/scenes/"

## Scenes, and a word of the reason where materials are not frozen.
const WHY := [
	["isotropic", ""],
	["anisotropic", ""],
	["everything", "filters"],
	["worn", ""],
	["by_script", "by_script.gd"],
	["by_unknown", "by_unknown.gd"],
	["animated", "roughness"],
	["room", "probes"],
	["empty", "none"],
]

## Lines of scripts, and whether materials can be frozen beside them.
const LINES := [
	["position = Vector3(0.1, 0.2, 0.3)", true],
	['node.set("visible", false)', true],
	["var roughness := 0.5", true],
	["$Ball.material_override.roughness = 0.5", false],
	['$Ball.material_override.set("roughness", 0.5)', false],
	['tween.tween_property($Ball, "material_override:albedo_color", Color.RED, 1.0)', false],
	["func paint(material: LobeMaterial3D) -> void:", false],
	["material.get_shader_code()", false],
	["environment.light = other", false],
	["var light := LobeLight.new()", false],
	["LobeLight.bind($Water.material_override)", true],
	['code = "#include \\"res://addons/lobelight/lobelight.gdshaderinc\\""', true],
	['load("res://addons/lobelight/tables/ggx_8.res")', false],
]

## Properties of materials whose shaders differ.
const SURFACES := [
	[{"metallic": 1.0}],
	[{"roughness": 0.4}],
	[{"metallic": 1.0, "anisotropy_enabled": true, "anisotropy": 0.8, "anisotropy_rotation": 0.3}],
	[{"clearcoat_enabled": true, "emission_enabled": true, "emission": Color.RED}],
	[{"sheen_enabled": true, "transparency": 1, "rim_enabled": true}],
	[{"roughness_texture": true, "normal_enabled": true, "normal_texture": true}],
	[{"albedo_texture": true, "uv1_triplanar": true, "ao_enabled": true, "ao_texture": true}],
	[{"detail_enabled": true, "detail_albedo": true, "heightmap_enabled": true, "grow": true}],
	[{"heightmap_enabled": true, "heightmap_texture": true, "distance_fade_mode": 1}],
	[{"shading_mode": 0, "albedo_texture": true}],
]


func _texture() -> Texture2D:
	return ImageTexture.create_from_image(Image.create_empty(4, 4, true, Image.FORMAT_RGBA8))


func _material(properties: Dictionary) -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	for name: String in properties:
		var is_texture := "texture" in name or name == "detail_albedo"
		material.set(name, _texture() if is_texture else properties[name])
	return material


static func _uniforms(code: String) -> Dictionary[String, int]:
	var shader := Shader.new()
	shader.code = code
	var uniforms: Dictionary[String, int] = {}
	for uniform: Dictionary in shader.get_shader_uniform_list():
		uniforms[uniform["name"]] = uniform["type"]
	return uniforms


# The engine reads both.
func test_a_flat_shader_has_the_same_uniforms(
	properties: Dictionary, _test_parameters := SURFACES
) -> void:
	var code := _material(properties).get_shader_code()
	var flat := FlatShader.of(code)
	assert_str(flat.problem).is_empty()
	assert_str(flat.code).not_contains("#include")
	assert_str(flat.code).not_contains("//")
	assert_dict(_uniforms(flat.code)).is_equal(_uniforms(code))
	assert_int(_uniforms(flat.code).size()).is_greater(0)


func test_a_flat_shader_keeps_what_only_the_game_can_decide() -> void:
	var code := "#define A 3\n#define KEPT 1\n#if CURRENT_RENDERER == RENDERER_MOBILE\n"
	code += "#define B\n#else\nint x = KEPT; // one\n#endif\n#ifdef B\nint y;\n#endif\n"
	code += "#if A == 2\nint z;\n#elif A / 2 == 1 && !defined(C)\nint w;\n#else\nint v;\n#endif\n"
	var wanted := "#define KEPT 1\n#if CURRENT_RENDERER == RENDERER_MOBILE\n#define B\n#else\n"
	wanted += "int x = KEPT;\n#endif\n#ifdef B\nint y;\n#endif\nint w;\n"
	assert_str(FlatShader.of(code).code).is_equal(wanted)
	(
		assert_str(FlatShader.of("#if CURRENT_RENDERER == 1\n#endif\n/* a\n b */").problem)
		. is_not_empty()
	)
	assert_str(FlatShader.of('#include "res://tests/diet/none.gdshaderinc"').problem).contains(
		"none"
	)


func test_materials_are_frozen_where_nothing_changes_them(
	scene: String, why_not: String, _test_parameters := WHY
) -> void:
	var diet: Diet = Diet.of_files(ProjectFiles.of_scene(SCENES + scene + ".tscn"))
	assert_bool(diet.frozen.is_frozen()).is_equal(why_not.is_empty())
	assert_bool(why_not.is_empty() or why_not in diet.frozen.why_not).is_true()
	var kept := diet.code.files.keys().filter(
		func(path: String) -> bool: return diet.code.files[path].after > 0
	)
	var has_class := "res://addons/lobelight/runtime/material/lobe_material_3d.gd" in kept
	assert_bool(has_class).is_equal(not why_not.is_empty() and scene != "empty")
	for share: Diet.Share in diet.shares.values():
		assert_bool(share.is_left_out() or not diet.frozen.is_frozen()).is_true()


func test_a_line_that_names_what_materials_have_keeps_them(
	line: String, can_freeze: bool, _test_parameters := LINES
) -> void:
	var frozen := FrozenMaterials.new()
	frozen.read_line("script.gd", line)
	assert_bool(frozen.is_frozen()).is_equal(can_freeze)


func test_what_is_exported_has_all_that_its_shader_takes() -> void:
	var diet: Diet = Diet.of_files(ProjectFiles.of_scene(SCENES + "anisotropic.tscn"))
	var path := "user://frozen.scn"
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_buffer(diet.edit(SCENES + "anisotropic.tscn"))
	file.close()
	var scene := ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene
	var root := scene.instantiate()
	var count := 0
	for node: MeshInstance3D in root.find_children("*", "MeshInstance3D"):
		var material := node.get_active_material(0) as FrozenMaterial
		if material == null:
			continue
		count += 1
		for uniform in _uniforms(material.shader.code):
			# Those of the light come from the light, and what is not used has a default.
			if not uniform.begins_with("lobelight_environment"):
				assert_array(material.parameters.keys()).contains([StringName(uniform)])
	assert_int(count).is_greater(0)
	root.free()
	DirAccess.remove_absolute(path)


func test_lights_with_sources_are_a_feature() -> void:
	var features := Features.new()
	var light := LobeLight.make_dark(true)
	features.look_at_light("plain.res", light)
	assert_bool(features.reached.is_empty()).is_true()
	light.sources = PlaceholderTexture2D.new()
	features.look_at_light("sunny.res", light)
	assert_str(features.reached[OnDemand.SOURCES]).is_equal("sunny.res")


func test_lights_that_take_another_shader_keep_materials() -> void:
	var frozen := FrozenMaterials.new()
	frozen.look_at_light("even.res", LobeLight.make_dark(true))
	assert_bool(frozen.is_frozen()).is_true()
	frozen.look_at_light("stretched.res", LobeLight.make_dark(false))
	assert_str(frozen.why_not).contains("stretched.res")
