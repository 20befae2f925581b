extends GdUnitTestSuite
## The nodes of visual shaders: graphs of them show what the equal LobeMaterial3D shows, saved and
## loaded again too, and follow the lights.

const Binding := preload("res://addons/lobelight/runtime/own_shaders/shader_binding.gd")
const Kit := preload("support/render_kit.gd")
const Bench := preload("support/own_shader_bench.gd")
const SIDE := Bench.SIDE
# As screens show them.
const STEP := 1.0 / 255.0
const FRAGMENT := VisualShader.TYPE_FRAGMENT
# Inputs of the output node.
const ALBEDO := 0
const EMISSION := 5
# Outputs of the nodes.
const OF_RADIANCE := 0
const OF_EMISSION := 1

var _view: LinearViewport
var _environment: LobeEnvironment3D
var _bench: Bench


func before_test() -> void:
	_bench = Bench.new()
	add_child(_bench)
	_view = _bench.view
	_environment = _bench.environment


func after_test() -> void:
	_bench.free()
	_bench = null
	_view = null
	_environment = null


func test_a_surface_is_that_of_a_lobe_material() -> void:
	for sun: float in [0.0, 400.0]:
		await _bench.light_up(sun)
		var shader := _new_shader()
		_add_surface(shader)
		var own := _own(shader)
		own.set_shader_parameter(&"albedo", Bench.COLOUR)
		for values: Array in [[0.45, 0.6, 0.7], [0.28, -0.86, 0.0]]:
			own.set_shader_parameter(&"roughness", values[0])
			own.set_shader_parameter(&"anisotropy", values[1])
			own.set_shader_parameter(&"metallic", values[2])
			await _compare(own, Bench.lobe_material(values[0], values[1], values[2]))
		var path := create_temp_dir("visual_shader").path_join("surface.tres")
		assert_int(ResourceSaver.save(own, path)).is_equal(OK)
		# The code is not kept, and the nodes know their files.
		assert_str(FileAccess.get_file_as_string(path)).not_contains("fragment()")
		var loaded: LobeShaderMaterial = ResourceLoader.load(
			path, "", ResourceLoader.CACHE_MODE_IGNORE
		)
		assert_str(loaded.shader.code).is_equal(own.shader.code)
		await _compare(loaded, Bench.lobe_material(0.28, -0.86, 0.0))


func test_typed_values_make_round_lobes() -> void:
	await _bench.light_up(400.0)
	var shader := _new_shader()
	var node := VisualShaderNodeLobelightReflection.new()
	node.set_input_port_default_value(VisualShaderNodeLobelightReflection.ROUGHNESS, 0.3)
	shader.add_node(FRAGMENT, node, Vector2.ZERO, 2)
	var colour := VisualShaderNodeColorParameter.new()
	colour.parameter_name = "albedo"
	shader.add_node(FRAGMENT, colour, Vector2.ZERO, 3)
	shader.add_node(FRAGMENT, VisualShaderNodeLobelightLinear.new(), Vector2.ZERO, 4)
	shader.connect_nodes(FRAGMENT, 3, 0, 4, 0)
	shader.connect_nodes(FRAGMENT, 4, 0, 2, 4)
	shader.connect_nodes(FRAGMENT, 2, OF_EMISSION, 0, EMISSION)
	var own := _own(shader)
	own.set_shader_parameter(&"albedo", Bench.COLOUR)
	await _compare(own, Bench.lobe_material(0.3, 0.0, 1.0))
	assert_str(_shown_code(own)).contains("#define LOBELIGHT_ISOTROPIC")
	# Another value makes long ones.
	node.set_input_port_default_value(VisualShaderNodeLobelightReflection.ANISOTROPY, 0.9)
	await _compare(own, Bench.lobe_material(0.3, 0.9, 1.0))
	assert_str(_shown_code(own)).not_contains("#define LOBELIGHT_ISOTROPIC")


func test_nodes_share_a_graph() -> void:
	# Half of what a matt white surface shows and half of a metal's.
	await _bench.light_up(0.0)
	var shader := _new_shader()
	shader.add_node(FRAGMENT, VisualShaderNodeLobelightDiffuse.new(), Vector2.ZERO, 2)
	var metal := VisualShaderNodeLobelightReflection.new()
	metal.set_input_port_default_value(metal.ROUGHNESS, 0.4)
	metal.set_input_port_default_value(metal.ANISOTROPY, 0.5)
	metal.set_input_port_default_value(4, Vector3.ONE)
	shader.add_node(FRAGMENT, metal, Vector2.ZERO, 3)
	var mix := VisualShaderNodeMix.new()
	mix.op_type = VisualShaderNodeMix.OP_TYPE_VECTOR_3D_SCALAR
	mix.set_input_port_default_value(2, 0.5)
	shader.add_node(FRAGMENT, mix, Vector2.ZERO, 4)
	shader.add_node(FRAGMENT, VisualShaderNodeLobelightEmission.new(), Vector2.ZERO, 5)
	shader.connect_nodes(FRAGMENT, 2, OF_RADIANCE, 4, 0)
	shader.connect_nodes(FRAGMENT, 3, OF_RADIANCE, 4, 1)
	shader.connect_nodes(FRAGMENT, 4, 0, 5, 0)
	shader.connect_nodes(FRAGMENT, 5, 0, 0, EMISSION)
	var matt := Bench.lobe_material(0.4, 0.0, 0.0)
	matt.albedo_color = Color.WHITE
	matt.metallic_specular = 0.0
	var brushed := Bench.lobe_material(0.4, 0.5, 1.0)
	brushed.albedo_color = Color.WHITE
	var both := await _bench.capture(matt)
	var other := await _bench.capture(brushed)
	for y in SIDE:
		for x in SIDE:
			both.set_pixel(x, y, both.get_pixel(x, y).lerp(other.get_pixel(x, y), 0.5))
	_assert_same(await _bench.capture(_own(shader)), both)


func test_the_sky_is_followed() -> void:
	var shader := _new_shader()
	var metal := VisualShaderNodeLobelightReflection.new()
	metal.set_input_port_default_value(4, Vector3.ONE)
	shader.add_node(FRAGMENT, metal, Vector2.ZERO, 2)
	shader.connect_nodes(FRAGMENT, 2, OF_EMISSION, 0, EMISSION)
	var own := _own(shader)
	for light: float in [0.25, 0.5]:
		_environment.panorama = Kit.constant(light)
		await _environment.rebuild()
		var image := await _bench.capture(own)
		var middle := image.get_pixel(SIDE / 2, SIDE / 2).r
		assert_float(middle).is_equal_approx(light, 0.008 * light)


func test_nodes_belong_to_fragments_of_surfaces() -> void:
	var node := VisualShaderNodeLobelightSurface.new()
	assert_bool(node._is_available(Shader.MODE_SPATIAL, FRAGMENT)).is_true()
	assert_bool(node._is_available(Shader.MODE_SPATIAL, VisualShader.TYPE_VERTEX)).is_false()
	assert_bool(node._is_available(Shader.MODE_CANVAS_ITEM, FRAGMENT)).is_false()


static func _new_shader() -> VisualShader:
	var shader := VisualShader.new()
	shader.set_mode(Shader.MODE_SPATIAL)
	shader.set("flags/ambient_light_disabled", true)
	# White where nothing is connected.
	var black := VisualShaderNodeVec3Constant.new()
	shader.add_node(FRAGMENT, black, Vector2.ZERO, 20)
	shader.connect_nodes(FRAGMENT, 20, 0, 0, ALBEDO)
	return shader


static func _add_surface(shader: VisualShader) -> void:
	shader.add_node(FRAGMENT, VisualShaderNodeLobelightSurface.new(), Vector2.ZERO, 2)
	var names: Array[String] = ["roughness", "anisotropy", "albedo", "metallic"]
	for i in names.size():
		var parameter: VisualShaderNodeParameter = VisualShaderNodeFloatParameter.new()
		if names[i] == "albedo":
			parameter = VisualShaderNodeColorParameter.new()
		parameter.parameter_name = names[i]
		shader.add_node(FRAGMENT, parameter, Vector2.ZERO, 3 + i)
		shader.connect_nodes(FRAGMENT, 3 + i, 0, 2, VisualShaderNodeLobelightSurface.ROUGHNESS + i)
	shader.connect_nodes(FRAGMENT, 2, OF_EMISSION, 0, EMISSION)


static func _own(shader: VisualShader) -> LobeShaderMaterial:
	var material := LobeShaderMaterial.new()
	material.shader = shader
	return material


static func _shown_code(material: ShaderMaterial) -> String:
	return (Binding._find(material)._get_shown() as Shader).code


func _compare(own: Material, ready: Material) -> void:
	_assert_same(await _bench.capture(own), await _bench.capture(ready))


func _assert_same(picture: Image, expected: Image) -> void:
	var found := Bench.compare(picture, expected)
	assert_float(found["mean"]).is_greater(0.05)
	assert_float(found["largest"]).is_less(1.01 * STEP)
