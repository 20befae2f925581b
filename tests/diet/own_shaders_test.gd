extends GdUnitTestSuite
## What shaders of one's own need of the addon in an export, which goes along with nobody else.

const Diet := preload("res://addons/lobelight/editor/export/diet.gd")
const OnDemand := preload("res://addons/lobelight/runtime/on_demand.gd")
const OwnShaders := preload("res://addons/lobelight/editor/export/own_shaders.gd")
const ProjectFiles := preload("res://addons/lobelight/editor/export/project_files.gd")
const ShaderText := preload("res://addons/lobelight/editor/export/shader_text.gd")

const SCENES := "res://tests/diet/scenes/"
const ADDON := "res://addons/lobelight/"
const INCLUDE := '#include "res://addons/lobelight/lobelight.gdshaderinc"'
const GGX := ADDON + "tables/ggx_8.res"
const WARD := ADDON + "tables/ward_8.res"
const F := "vec3 f(LobelightPixel p, vec3 n) { return %s; }"
const REFLECT := F % "lobelight_reflection(p, n, n, 1.0, 0.0, n)"
const SCATTER := F % "lobelight_diffuse(p, n)"
const BOTH := F % "lobelight_surface(p, n, n, 1.0, 0.0, n, 1.0, 0.5)"
const BINDER := "extends Node\n\n\nfunc _ready() -> void:\n\tLobeLight.bind(material)\n"

## Lines of a shader, and what it needs: the line's lobes, diffuse light, anisotropic tables.
const SHADERS := [
	[INCLUDE + " ; " + REFLECT, true, false, true],
	["#define LOBELIGHT_ISOTROPIC ; " + INCLUDE, false, false, false],
	["#define LOBELIGHT_ISOTROPIC ; " + INCLUDE + " ; " + SCATTER, false, true, false],
	["#define LOBELIGHT_QUALITY 8 ; " + INCLUDE, false, false, true],
	["#define LOBELIGHT_QUALITY 12 ; " + INCLUDE, true, false, true],
	[INCLUDE + " ; " + BOTH, true, true, true],
	["// #define LOBELIGHT_ISOTROPIC ; " + INCLUDE, true, false, true],
	["/* ; #define LOBELIGHT_ISOTROPIC ; */ ; " + INCLUDE, true, false, true],
	[INCLUDE + " ; #define LOBELIGHT_ISOTROPIC", true, false, true],
	["#define LOBELIGHT_ISOTROPIC ; #undef LOBELIGHT_ISOTROPIC ; " + INCLUDE, true, false, true],
	# Of some renderers only.
	["#ifdef A ; #define LOBELIGHT_ISOTROPIC ; #endif ; " + INCLUDE, true, false, true],
	["#ifdef A ; #define LOBELIGHT_ISOTROPIC ; %s ; #endif" % INCLUDE, false, false, false],
	["#ifdef A ; #define LOBELIGHT_ISOTROPIC ; #else ; %s ; #endif" % INCLUDE, true, false, true],
	[
		(
			"#ifdef A ; #define LOBELIGHT_ISOTROPIC ; "
			+ INCLUDE
			+ " ; #else ; "
			+ INCLUDE
			+ " ; #endif"
		),
		true,
		false,
		true
	],
	['#include "user://own_outer.gdshaderinc"', false, false, false],
	['#include "own_outer.gdshaderinc" ; ' + SCATTER, false, true, false],
	['#include "uid://bo3opf488xa4o" ; // ' + SCATTER, true, false, true],
]
# In the text of a scene.
const OUTER := (
	"#ifndef OUTER\n#define OUTER\n#define LOBELIGHT_ISOTROPIC\n" + INCLUDE + "\n#endif\n"
)

## Lines of a script, and whether shaders of one's own are reached.
const LINES := [
	["LobeLight.bind(material)", true],
	["LobeLight.unbind(material)", true],
	["LobeLight.bind.call_deferred(material)", true],
	['lobeLight.Call("bind", material);', true],
	['GD.Load<GDScript>("res://addons/lobelight/runtime/light/lobe_light.gd");', true],
	["var material := LobeShaderMaterial.new()", true],
	["button.pressed.connect(_press.bind(material))", false],
	["var light := LobeLight.make_dark(true)", false],
]

var _written: PackedStringArray = []


func after_test() -> void:
	for file in _written:
		DirAccess.remove_absolute(file)
	_written.clear()


func _write(path: String, text: String) -> String:
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_string(text)
	file.close()
	_written.append(path)
	return path


func _save(resource: Resource, path: String) -> String:
	ResourceSaver.save(resource, path)
	_written.append(path)
	return path


func _diet(files: Array, freezes := false) -> Diet:
	return Diet.of_files(PackedStringArray(files), 0.0, true, freezes)


func _is_kept(diet: Diet, name: String) -> bool:
	var file := diet.code.files[ADDON + name]
	return file.after > 1


# Neither what they include nor what binds them.
func _has_none(diet: Diet) -> bool:
	return diet.code.files.keys().all(
		func(path: String) -> bool:
			return (
				OwnShaders.Features.of_file(path) != OnDemand.OWN_SHADERS
				or (diet.code.files[path].after == 0)
			)
	)


func _has_all(diet: Diet) -> bool:
	return diet.code.files.keys().all(
		func(path: String) -> bool:
			return (
				OwnShaders.Features.of_file(path) != OnDemand.OWN_SHADERS
				or (diet.code.files[path].after > 500)
			)
	)


func _expect_needs(diet: Diet, line: bool, diffuse: bool, anisotropic: bool) -> void:
	assert_bool(_has_all(diet)).is_true()
	assert_bool(_is_kept(diet, "runtime/line/line.gdshaderinc")).is_equal(line)
	assert_bool(_is_kept(diet, "runtime/diffuse/diffuse.gdshaderinc")).is_equal(diffuse)
	assert_bool(_is_kept(diet, "runtime/material/lobe_material_3d.gd")).is_false()
	var share := diet.shares[GGX]
	assert_bool(share.is_left_out()).is_false()
	assert_bool(share.after > 0.1 * share.before).is_equal(anisotropic)


func test_what_a_shader_needs(
	lines: String, line: bool, diffuse: bool, anisotropic: bool, _test_parameters := SHADERS
) -> void:
	_write("user://own_outer.gdshaderinc", OUTER)
	var code := "shader_type spatial;\n" + lines.replace(" ; ", "\n") + "\n"
	var shader := _write("user://own.gdshader", code)
	var binder := _write("user://own.gd", BINDER)
	_expect_needs(_diet([shader, binder]), line, diffuse, anisotropic)
	# Scenes have shaders, too.
	var material := LobeShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = code.replace('"own_', '"user://own_')
	var file := _save(material, "user://own.tres")
	_expect_needs(_diet([file]), line, diffuse, anisotropic)


func test_of_a_shader_that_includes_nothing_of_the_addon_nothing_goes_along() -> void:
	var shader := _write("user://own.gdshader", "shader_type spatial;\n// %s\n" % INCLUDE)
	assert_int(_diet([SCENES + "empty.tscn", shader]).code.get_size_after()).is_equal(0)
	var scene := PackedStringArray(Array(ProjectFiles.of_scene(SCENES + "everything.tscn")))
	scene.append(shader)
	assert_bool(_has_none(_diet(scene))).is_true()


func test_visual_shaders_are_read_as_text() -> void:
	var shader := VisualShader.new()
	var node := VisualShaderNodeGlobalExpression.new()
	node.expression = "#define LOBELIGHT_ISOTROPIC\n%s\n" % INCLUDE
	shader.add_node(VisualShader.TYPE_FRAGMENT, node, Vector2.ZERO, 2)
	var material := LobeShaderMaterial.new()
	material.shader = shader
	_expect_needs(_diet([_save(material, "user://own.tres")]), false, false, false)


# What a material shows of a graph has the include before all else.
func test_nodes_of_visual_shaders_say_what_they_need() -> void:
	for brushing: float in [0.0, 0.8]:
		var shader := VisualShader.new()
		var node := VisualShaderNodeLobelightReflection.new()
		node.set_input_port_default_value(3, brushing)
		shader.add_node(VisualShader.TYPE_FRAGMENT, node, Vector2.ZERO, 2)
		shader.connect_nodes(VisualShader.TYPE_FRAGMENT, 2, 1, 0, 5)
		var material := LobeShaderMaterial.new()
		material.shader = shader
		var diet := _diet([_save(material, "user://own_%s.tres" % brushing)])
		_expect_needs(diet, brushing > 0.0, false, brushing > 0.0)
		assert_bool(_is_kept(diet, "runtime/visual_shader/nodes.gdshaderinc")).is_true()
		assert_bool(_is_kept(diet, "runtime/visual_shader/reflection_node.gd")).is_true()
	var none := _diet(ProjectFiles.of_scene(SCENES + "own_shaders.tscn"))
	for path in none.code.files:
		assert_bool("/visual_shader/" in path and none.code.files[path].after > 0).is_false()


func test_what_scripts_write_may_be_any_shader() -> void:
	var outer := _write("user://own_outer.gdshaderinc", OUTER)
	for line: String in [INCLUDE.c_escape(), '#include \\"user://own_outer.gdshaderinc\\"']:
		var text := BINDER + '\tmaterial.shader.code = "%s"\n' % line
		_expect_needs(_diet([_write("user://own.gd", text), outer]), true, true, true)
	var graph := BINDER + "\tgraph.add_node(0, VisualShaderNodeLobelightSurface.new(), at, 2)\n"
	_expect_needs(_diet([_write("user://own.gd", graph)]), true, true, true)
	# So may be those that include what no shader of the project does.
	_expect_needs(_diet([_write("user://own.gd", BINDER), outer]), true, true, true)


func test_scripts_that_bind(line: String, reaches: bool, _test_parameters := LINES) -> void:
	var script := "extends Node\n\n\nfunc _ready() -> void:\n\t%s\n" % line
	var diet := _diet([SCENES + "isotropic.tscn", _write("user://own.gd", script)])
	assert_bool(_has_all(diet)).is_equal(reaches)
	assert_bool(_has_none(diet)).is_equal(not reaches)
	# There is nothing to bind.
	assert_bool(_is_kept(diet, "runtime/line/line.gdshaderinc")).is_false()


func test_scenes_may_declare_them() -> void:
	var scene := Node.new()
	scene.set_meta("lobelight_features", [OnDemand.OWN_SHADERS])
	var packed := PackedScene.new()
	packed.pack(scene)
	scene.free()
	var files := [_save(packed, "user://own.tscn"), SCENES + "own_isotropic.tscn"]
	_expect_needs(_diet(files), true, true, true)


func test_a_shader_that_nobody_binds_takes_no_lobes() -> void:
	var shader := _write("user://own.gdshader", "shader_type spatial;\n%s\n" % INCLUDE)
	var diet := _diet([shader])
	assert_bool(_has_all(diet)).is_true()
	assert_bool(diet.shares[GGX].is_left_out()).is_true()


func test_materials_take_the_sets_that_they_have() -> void:
	var material := LobeShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = "shader_type spatial;\n#define LOBELIGHT_ISOTROPIC\n%s\n" % INCLUDE
	material.table_set = load(WARD)
	var diet := _diet([_save(material, "user://own.tres")])
	assert_bool(diet.shares[GGX].is_left_out()).is_true()
	assert_int(diet.shares[WARD].after).is_between(1000, 200000)
	assert_str(diet.shares[WARD].why).contains("user://own.tres has a shader of its own")


# The parts of the set that stay are as they were, so that pixels find them.
func test_all_isotropic_tables_stay() -> void:
	var files := ProjectFiles.of_scene(SCENES + "own_isotropic.tscn")
	var file := FileAccess.open("user://own_set.res", FileAccess.WRITE)
	file.store_buffer(_diet(files).shares[GGX].bytes)
	file.close()
	_written.append("user://own_set.res")
	var whole: LobeTableSet = load(GGX)
	var left: LobeTableSet = load("user://own_set.res")
	assert_array(left.widths).is_equal(whole.widths)
	for width in whole.widths.size():
		var number := whole.get_pair_count() + width
		assert_array(left.get_table_data(number)).is_equal(whole.get_table_data(number))


# The light that they share stays for both.
func test_materials_are_frozen_beside_them() -> void:
	var files := ProjectFiles.of_scene(SCENES + "isotropic.tscn")
	for file in ProjectFiles.of_scene(SCENES + "own_shaders.tscn"):
		if file not in files:
			files.append(file)
	var diet := _diet(files, true)
	assert_str(diet.frozen.why_not).is_empty()
	_expect_needs(diet, true, true, true)
	for name: String in ["light_registry.gd", "lobe_light.gd", "shader_variants.gd"]:
		assert_bool(_is_kept(diet, "runtime/light/" + name)).is_true()
	assert_bool(_is_kept(diet, "runtime/frozen/frozen_material.gd")).is_true()
	assert_bool(diet.shares[WARD].is_left_out()).is_true()


func test_the_report_says_who_needs_it() -> void:
	var diet := _diet(ProjectFiles.of_scene(SCENES + "own_shaders.tscn"))
	var brushed := SCENES + "own_shaders.gdshader"
	assert_str(diet.code.files[ADDON + "lobelight.gdshaderinc"].why).contains(
		"for res://tests/diet"
	)
	assert_str(diet.code.files[ADDON + "runtime/line/line.gdshaderinc"].why).contains(brushed)
	assert_str(diet.shares[GGX].why).contains(brushed + " has a shader of its own")


# What is exported compiles, with lights that have other places and sources and without.
func test_what_is_left_of_the_include_is_whole() -> void:
	var diet := _diet(ProjectFiles.of_scene(SCENES + "own_isotropic.tscn"))
	var text := diet.code.files[ADDON + "lobelight.gdshaderinc"].bytes.get_string_from_utf8()
	assert_str(text).not_contains("//")
	assert_str(text).not_contains("LOBELIGHT_DIFFUSE")
	assert_str(text).not_contains("lobelight_surface")
	assert_str(text).contains("vec3 lobelight_reflection(")
	var code := 'a /* b ; "c" */ "d // e" // f ; g'.replace(" ; ", "\n")
	assert_str(ShaderText.without_comments(code)).is_equal('a   "d // e"  \ng')
