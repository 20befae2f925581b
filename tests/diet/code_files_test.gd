extends GdUnitTestSuite
## Which scripts and shaders of the run time scenes need.

const CodeFiles := preload("res://addons/lobelight/editor/export/code_files.gd")
const Diet := preload("res://addons/lobelight/editor/export/diet.gd")
const OnDemand := preload("res://addons/lobelight/runtime/on_demand.gd")
const ProjectFiles := preload("res://addons/lobelight/editor/export/project_files.gd")
const SCENES := "res://tests/diet/scenes/"
const RUN_TIME := "res://addons/lobelight/runtime/"
const FEATURES: PackedStringArray = [
	"clear_coat/clear_coat.gdshaderinc",
	"diffuse/diffuse.gdshaderinc",
	"filters/pyramid_reduce.gdshader",
	"skies/six_views.gd",
	"skies/world_views.gd",
	"conversion/material_conversion.gd",
	"probes/placed_lights.gd",
	"occlusion/occlusion.gdshaderinc",
	"detail/detail.gdshaderinc",
	"msdf/msdf.gdshaderinc",
	"parallax/parallax.gdshaderinc",
	"triplanar/triplanar.gdshaderinc",
	"vertices/vertices.gdshaderinc",
	"sheen/sheen.gdshaderinc",
	"gltf/lobe_gltf_extension.gd",
	"fades/fades.gdshaderinc",
	"lamps/lamps.gdshaderinc",
	"engine_light/engine_watch.gd",
]

## A scene, and which of FEATURES it needs.
const NEEDS := [
	["isotropic", []],
	["anisotropic", [3, 4]],
	["everything", [0, 1, 2, 3, 4, 7]],
]

## A line of a script, and which of FEATURES it may ask for.
const ASKING := [
	["position = Vector3.ZERO", []],
	["material.clearcoat_roughness = 0.3", [0]],
	["material.metallic = 0.0", [1]],
	["material.normal_texture = null", [7]],
	["material.ao_enabled = true", [7]],
	["$Light.filter = 1", [2]],
	["$Light.panorama = null", [3, 4]],
	["add_child(LobeEnvironment3D.new())", [3, 4]],
	["material.set(property, 0.1)", [0, 1, 2, 3, 4, 7, 8, 9, 10, 11, 12, 13, 15, 16, 17]],
	["material.sheen_enabled = true", [13]],
	["material.proximity_fade_enabled = true", [15]],
	["material.refraction_enabled = true", [15]],
	["material.rim_enabled = true", [16]],
	["environment.ssao_enabled = true", [17]],
	["material.diffuse_light = 2", [17]],
	[
		"var extension := LobeGLTFExtension.new()",
		[0, 1, 2, 3, 4, 5, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17]
	],
	["LobeMaterial3D.get_losses_from(material)", [5]],
	['material.call("to_standard")', [5]],
	["add_child(LobeProbe3D.new())", [3, 4, 6]],
	["viewport.own_world_3d = true", [6]],
	["$Light.fade_time = 2.0", [6]],
	["viewport.world_2d = null", []],
	["material.detail_enabled = true", [8]],
	["material.albedo_texture_msdf = true", [9]],
	["material.heightmap_texture = load(path)", [10]],
	["material.uv2_triplanar = true", [11]],
	["material.uv1_world_triplanar = true", [11]],
	["material.grow = true", [12]],
	["material.billboard_mode = 1", [12]],
]

## Rendering methods of a project and whether the engine may fall back to OpenGL, and which cubes an
## export needs: that of the rendering device, that of Compatibility.
const RENDERERS := [
	["mobile", "mobile", true, [true, true]],
	["gl_compatibility", "gl_compatibility", true, [false, true]],
	["gl_compatibility", "mobile", true, [true, true]],
]

## Lines of a shader, and those that are left without X.
const BRANCHES := [
	["a ; #ifdef X ; b ; #endif ; c", "a ; c"],
	["#ifdef X ; b ; #else ; c ; #endif ; d", "c ; d"],
	["#ifndef X ; b ; #else ; c ; #endif", "b"],
	[
		"#ifdef Y ; #ifdef X ; b ; #endif ; c ; #else ; d ; #endif",
		"#ifdef Y ; c ; #else ; d ; #endif"
	],
	["#ifdef X ; #if Y > 1 ; b ; #elif Y ; c ; #else ; d ; #endif ; #endif ; e", "e"],
	["#ifndef X ; #ifdef Y ; b ; #endif ; #endif", "#ifdef Y ; b ; #endif"],
	["#if defined(X) || Y ; b ; #endif", "#if defined(X) || Y ; b ; #endif"],
	["#ifdef X ; b ; #elif Y ; c ; #endif", "#ifdef X ; b ; #elif Y ; c ; #endif"],
]


func _code(scene: String) -> CodeFiles:
	return Diet.of_files(ProjectFiles.of_scene(SCENES + scene + ".tscn"), 0.0, true, false).code


func test_files_of_features_that_nothing_reaches_stay_out(
	scene: String, needed: Array, _test_parameters := NEEDS
) -> void:
	_expect_features(ProjectFiles.of_scene(SCENES + scene + ".tscn"), needed)


func test_scripts_keep_the_files_that_they_may_ask_for(
	line: String, needed: Array, _test_parameters := ASKING
) -> void:
	var file := "user://diet_feature.gd"
	_write(file, "extends Node\n\n\nfunc _ready() -> void:\n\t%s\n" % line)
	_expect_features(PackedStringArray([SCENES + "isotropic.tscn", file]), needed)
	DirAccess.remove_absolute(file)


func _expect_features(files: PackedStringArray, needed: Array) -> void:
	var code: CodeFiles = Diet.of_files(files, 0.0, true, false).code
	for feature in FEATURES.size():
		var file := code.files[RUN_TIME + FEATURES[feature]]
		assert_bool(file.after > 500).is_equal(feature in needed)
		# A script preloads it.
		if FEATURES[feature].ends_with(".gdshaderinc"):
			assert_int(file.after).is_greater(0)
		elif feature not in needed:
			assert_int(file.after).is_equal(0)


func test_what_features_alone_load_stays_out_with_them() -> void:
	var code := _code("isotropic")
	for name: String in ["six_views.gd", "sky_stage.gd", "surroundings.gd"]:
		var path := RUN_TIME + "skies/" + name
		assert_int(code.files[path].after).is_equal(0)
		assert_int(_code("anisotropic").files[path].after).is_greater(500)


# Only the editor asks for them.
func test_no_export_has_the_warnings() -> void:
	for scene: String in ["isotropic", "everything"]:
		(
			assert_int(_code(scene).files[RUN_TIME + "warnings/environment_warnings.gd"].after)
			. is_equal(0)
		)


func test_scenes_may_declare_features() -> void:
	var scene := Node.new()
	scene.set_meta("lobelight_features", [OnDemand.CONVERSION, OnDemand.SKIES])
	_expect_features_of_scene(scene, [3, 4, 5])


func test_scenes_of_probes_or_of_several_worlds_have_what_tells_places() -> void:
	# Captures draw the surroundings; a light that was baked needs none.
	_expect_features_of_scene(LobeProbe3D.new(), [3, 4, 6])
	var probe := LobeProbe3D.new()
	probe.light = LobeLight.make_dark(true)
	_expect_features_of_scene(probe, [6])
	var viewport := SubViewport.new()
	_expect_features_of_scene(viewport, [])
	viewport = SubViewport.new()
	viewport.own_world_3d = true
	_expect_features_of_scene(viewport, [6])
	var environment := LobeEnvironment3D.new()
	environment.fade_time = 1.0
	_expect_features_of_scene(environment, [3, 4, 6])


func _expect_features_of_scene(scene: Node, needed: Array) -> void:
	var packed := PackedScene.new()
	packed.pack(scene)
	scene.free()
	var file := "user://diet_feature.tscn"
	ResourceSaver.save(packed, file)
	_expect_features(PackedStringArray([SCENES + "isotropic.tscn", file]), needed)
	DirAccess.remove_absolute(file)


func test_folders_of_features_stay_or_go_whole() -> void:
	var probes := "user://diet_probes.gd"
	_write(probes, "extends LobeProbe3D\n")
	for name: String in ["empty", "worn", "isotropic", "everything"]:
		for script: Array in [[], [probes]]:
			var files := ProjectFiles.of_scene(SCENES + name + ".tscn")
			files.append_array(PackedStringArray(script))
			var code: CodeFiles = Diet.of_files(files, 0.0, true, false).code
			for folder: String in CodeFiles.Features.FOLDERS:
				var sizes := _sizes(code, RUN_TIME + folder + "/")
				assert_int(sizes.size()).append_failure_message(folder).is_greater(0)
				# Of includes that scripts preload an empty line goes along.
				var kept := sizes.filter(func(size: int) -> bool: return size > 1)
				assert_int(kept.size()).append_failure_message(folder).is_in([0, sizes.size()])
			# Not a byte without probes.
			var has_probes := _sizes(code, RUN_TIME + "probes/").count(0) == 0
			assert_bool(has_probes).is_equal(not script.is_empty())
			var lobes := code.files[RUN_TIME + "shaders/specular.gdshaderinc"].bytes
			if not lobes.is_empty():
				var asks := "LOBELIGHT_PLACED" in lobes.get_string_from_utf8()
				assert_bool(asks).is_equal(has_probes)
	DirAccess.remove_absolute(probes)


func _sizes(code: CodeFiles, folder: String) -> Array[int]:
	var sizes: Array[int] = []
	for path in code.files:
		if path.begins_with(folder):
			sizes.append(code.files[path].after)
	return sizes


func test_renderers_that_no_system_has_stay_out(
	method: String, mobile: String, fallback: bool, kept: Array, _test_parameters := RENDERERS
) -> void:
	var settings := {
		"rendering/renderer/rendering_method": method,
		"rendering/renderer/rendering_method.mobile": mobile,
		"rendering/rendering_device/fallback_to_opengl3": fallback,
	}
	var before := {}
	for setting: String in settings:
		before[setting] = ProjectSettings.get_setting(setting)
		ProjectSettings.set_setting(setting, settings[setting])
	var code := _code("isotropic")
	for setting: String in before:
		ProjectSettings.set_setting(setting, before[setting])
	var names: PackedStringArray = ["rendering_device/gpu_cube.gd", "compatibility/packed_cube.gd"]
	for cube in 2:
		assert_bool(code.files[RUN_TIME + names[cube]].after > 500).is_equal(kept[cube])
	assert_bool(code.files[RUN_TIME + "rendering_device/owned_cubemap.gd"].after > 0).is_equal(
		kept[0]
	)


func test_shaders_lose_their_comments_and_nothing_else() -> void:
	var probes := "user://diet_probes.gd"
	# With every feature of materials.
	_write(probes, "extends LobeProbe3D\n\n\nfunc give(name, value):\n\tself.set(name, value)\n")
	var files := ProjectFiles.of_scene(SCENES + "everything.tscn")
	files.append(probes)
	var code: CodeFiles = Diet.of_files(files, 0.0, true, false).code
	DirAccess.remove_absolute(probes)
	var shaders := 0
	for path in code.files:
		if path.get_extension() == "gd" or code.files[path].after == 0:
			continue
		shaders += 1
		var text := code.files[path].bytes.get_string_from_utf8()
		assert_bool("//" in text).is_false()
		assert_str(_words_of(text)).is_equal(_words_of(FileAccess.get_file_as_string(path)))
	assert_int(shaders).is_greater(10)


func test_a_feature_that_the_project_names_itself_is_not_empty() -> void:
	var file := "user://diet_include.gd"
	var path := RUN_TIME + FEATURES[0]
	_write(file, 'extends Node\n\nvar code := "#include \\"%s\\"\\n"\n' % path)
	for files: Array in [[SCENES + "isotropic.tscn", file], [file, SCENES + "isotropic.tscn"]]:
		var code: CodeFiles = Diet.of_files(PackedStringArray(files), 0.0, true, false).code
		assert_int(code.files[path].after).is_greater(500)
	DirAccess.remove_absolute(file)


func test_paths_in_includes_are_no_comments() -> void:
	var code := '#include "res://a.gdshaderinc"\n\n// why\n\tfloat x; // y\n'
	var stripped := CodeFiles.ShaderText.strip(code)
	assert_str(stripped).is_equal('#include "res://a.gdshaderinc"\nfloat x;\n')


func test_shaders_lose_the_branches_of_a_define(
	code: String, kept: String, _test_parameters := BRANCHES
) -> void:
	var found := CodeFiles.ShaderText.without(code.replace(" ; ", "\n"), "X")
	assert_str(found.replace("\n", " ; ")).is_equal(kept)


# What a compiler sees: no comments, one space between words.
func _words_of(code: String) -> String:
	var comment := RegEx.create_from_string("//[^\n]*")
	return (
		RegEx.create_from_string("\\s+").sub(comment.sub(code, "", true), " ", true).strip_edges()
	)


func test_of_a_project_without_the_addon_nothing_goes_along() -> void:
	assert_int(_code("empty").get_size_after()).is_equal(0)


func test_without_an_environment_its_scripts_stay_out() -> void:
	var code: CodeFiles = _code("worn")
	assert_int(code.files[RUN_TIME + "material/lobe_material_3d.gd"].after).is_greater(5000)
	assert_int(code.files[RUN_TIME + "material/lobe_base_material_3d.gd"].after).is_greater(5000)
	assert_int(code.files[RUN_TIME + "light/lobe_environment_3d.gd"].after).is_equal(0)
	assert_int(code.files[RUN_TIME + "skies/six_views.gd"].after).is_equal(0)


# Whatever a script of the run time that goes along loads goes along.
func test_what_is_loaded_goes_along(
	scene: String, _needed: Array, _test_parameters := NEEDS
) -> void:
	var code: CodeFiles = _code(scene)
	var loaded := RegEx.create_from_string('load\\("([^"]+)"\\)|^extends "([^"]+)"')
	var count := 0
	for path in code.files:
		if code.files[path].after == 0 or path.get_extension() != "gd":
			continue
		for found in loaded.search_all(FileAccess.get_file_as_string(path)):
			var name := found.get_string(1) + found.get_string(2)
			var target := path.get_base_dir().path_join(name).simplify_path()
			assert_bool(code.files.has(target) and code.files[target].after > 0).is_true()
			count += 1
	assert_int(count).is_greater(30)


func test_a_script_that_puts_paths_together_keeps_all_files() -> void:
	var file := "user://diet_path.gd"
	_write(file, 'extends Node\n\nvar folder := "res://addons/lobelight/runtime"\n')
	var code: CodeFiles = Diet.of_files(PackedStringArray([file]), 0.0, true, false).code
	DirAccess.remove_absolute(file)
	for path in code.files:
		assert_int(code.files[path].after).is_greater(0)


func test_a_script_may_name_files_by_their_uids() -> void:
	var file := "user://diet_uid.gd"
	var id := ResourceLoader.get_resource_uid(RUN_TIME + "light/lobe_environment_3d.gd")
	var uid := ResourceUID.id_to_text(id)
	_write(file, 'extends Node\n\nconst A := preload("%s")\nconst B := "uid://none"\n' % uid)
	var code: CodeFiles = Diet.of_files(PackedStringArray([file]), 0.0, true, false).code
	DirAccess.remove_absolute(file)
	assert_int(code.files[RUN_TIME + "light/lobe_environment_3d.gd"].after).is_greater(0)
	assert_int(code.files[RUN_TIME + "material/lobe_material_3d.gd"].after).is_equal(0)


func _write(path: String, text: String) -> void:
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_string(text)
	file.close()
