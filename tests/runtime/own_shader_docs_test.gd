extends GdUnitTestSuite
## The C# code of the documentation, of which no compiler knows here: what it names exists in the
## engine, in the addon's scripts and in the shaders that it sets parameters of.

const PAGES: Array[String] = ["res://docs/own-shaders.md", "res://docs/examples/README.md"]
const SHADERS: Array[String] = [
	"res://demo/examples/car_paint/car_paint.gdshader",
	"res://demo/examples/water/water.gdshader",
	"res://demo/examples/brushed_dial/brushed_dial.gdshader",
]
## What C# has that is not the engine's, or that its binding adds.
const OF_CSHARP: Array[String] = [
	"Godot",
	"Export",
	"Mathf",
	"Tau",
	"Sin",
	"GD",
	"New",
	"As",
	"AsSingle",
	"AsGodotObject",
	"Color",
	"Lightened",
	"Vector2",
	"Vector3",
	"Basis",
	"StringName",
	"Variant",
	"Callable",
]

var _word := RegEx.create_from_string("\\b_?[A-Z]\\w*")
var _string := RegEx.create_from_string('"([^"\\n]*)"')
var _comment := RegEx.create_from_string("//[^\\n]*")
var _declared := RegEx.create_from_string("\\b(?:class|void|double|float|int)\\s+([A-Z]\\w*)")


func test_names_of_csharp_exist() -> void:
	var count := 0
	for page in PAGES:
		for code in _blocks_of(page):
			count += 1
			assert_array(find_unknown(code)).is_empty()
	assert_int(count).is_greater(2)


## The test itself: misspelt names are found.
func test_unknown_names_are_found() -> void:
	assert_array(find_unknown("var m = new ShaderMateriel();")).is_equal(["ShaderMateriel"])
	assert_array(find_unknown("paint.SetShaderParam(x);")).is_equal(["SetShaderParam"])
	assert_array(find_unknown('lobeLight.Call("bnd", m);')).is_equal(["bnd"])
	assert_array(find_unknown('m.SetShaderParameter("flake", 1);')).is_equal(["flake"])
	assert_array(find_unknown('GD.Load<GDScript>("res://addons/x.gd");')).is_equal(
		["res://addons/x.gd"]
	)
	assert_array(find_unknown('new ShaderMaterial().SetShaderParameter("flakes", 1);')).is_empty()


## What C# does with the scripts works: static methods and New() are called by name.
func test_scripts_are_called_by_name() -> void:
	var script: GDScript = load(
		"res://addons/lobelight/runtime/own_shaders/lobe_shader_material.gd"
	)
	var paint: ShaderMaterial = script.call(&"new")
	paint.shader = load("res://demo/examples/car_paint/car_paint.gdshader")
	paint.set(&"light", LobeLight.make_constant(Color.WHITE, true))
	assert_object(paint.get(&"light")).is_instanceof(LobeLight)
	var lobe_light: GDScript = load("res://addons/lobelight/runtime/light/lobe_light.gd")
	var other := ShaderMaterial.new()
	other.shader = paint.shader
	lobe_light.call(&"bind", other)
	lobe_light.call(&"unbind", other)


## In GDScript and in shaders, too, the page names what there is.
func test_names_of_the_api_are_described() -> void:
	var api := FileAccess.get_file_as_string("res://addons/lobelight/lobelight.gdshaderinc")
	api += FileAccess.get_file_as_string(
		"res://addons/lobelight/runtime/shaders/colour.gdshaderinc"
	)
	var text := FileAccess.get_file_as_string(PAGES[0])
	var named := RegEx.create_from_string("\\b(lobelight_\\w+)\\(|\\b(LOBELIGHT_\\w+)\\b")
	for found in named.search_all(text):
		var name := found.get_string(1) + found.get_string(2)
		assert_bool(name in api).override_failure_message("%s is not in the API" % name).is_true()
	for name: String in ["reflection", "diffuse", "surface", "linear", "emission", "encode"]:
		assert_str(text).contains("`lobelight_%s(" % name)


func find_unknown(code: String) -> Array[String]:
	var unknown: Array[String] = []
	for found in _string.search_all(code):
		var text := found.get_string(1)
		if not _is_known_string(text):
			unknown.append(text)
	var bare := _comment.sub(_string.sub(code, '""', true), "", true)
	var own: Array[String] = []
	for found in _declared.search_all(bare):
		own.append(found.get_string(1))
	var members := _members_of(bare)
	for found in _word.search_all(bare):
		var name := found.get_string()
		var is_member := found.get_start() > 0 and bare[found.get_start() - 1] == "."
		var is_known := (
			name in OF_CSHARP
			or name in own
			or members.has(name)
			or (not is_member and ClassDB.class_exists(name))
		)
		if not is_known and name not in unknown:
			unknown.append(name)
	return unknown


## All that the classes have that the code names, as C# spells it; and what any object has.
func _members_of(code: String) -> Dictionary[String, bool]:
	var members: Dictionary[String, bool] = {}
	var classes: Array[String] = ["Node3D", "ShaderMaterial", "GDScript", "PackedScene"]
	for found in _word.search_all(code):
		classes.append(found.get_string())
	for name in classes:
		if not ClassDB.class_exists(name):
			continue
		for list: Array[Dictionary] in [
			ClassDB.class_get_method_list(name), ClassDB.class_get_property_list(name)
		]:
			for entry in list:
				var known: String = entry["name"]
				# What is overridden keeps its dash.
				var dash := "_" if known.begins_with("_") else ""
				members[dash + known.to_pascal_case()] = true
	# Of GD.
	members["Load"] = true
	return members


func _is_known_string(text: String) -> bool:
	if text.is_empty():
		return true
	if text.begins_with("res://"):
		return ResourceLoader.exists(text)
	text = text.trim_prefix("shader_parameter/")
	for path in SHADERS:
		var scene: PackedScene = load(path.get_basename() + ".tscn")
		for node in scene.get_state().get_node_count():
			if scene.get_state().get_node_name(node) == text:
				return true
	for path in SHADERS:
		var shader: Shader = load(path)
		for uniform: Dictionary in shader.get_shader_uniform_list():
			if uniform["name"] == text:
				return true
	for script in _scripts():
		for list: Array[Dictionary] in [
			script.get_script_method_list(), script.get_script_property_list()
		]:
			for entry in list:
				if entry["name"] == text:
					return true
	return false


func _scripts() -> Array[Script]:
	var found: Array[Script] = []
	for path: String in [
		"own_shaders/lobe_shader_material.gd",
		"light/lobe_light.gd",
		"light/lobe_environment_3d.gd",
		"material/lobe_material_3d.gd",
	]:
		found.append(load("res://addons/lobelight/runtime/" + path))
	return found


func _blocks_of(page: String) -> PackedStringArray:
	var blocks: PackedStringArray = []
	for part in FileAccess.get_file_as_string(page).split("```csharp\n").slice(1):
		blocks.append(part.get_slice("```", 0))
	return blocks
