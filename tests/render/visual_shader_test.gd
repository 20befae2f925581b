extends GdUnitTestSuite
## The nodes of visual shaders: graphs of them show what the equal LobeMaterial3D shows, saved and
## loaded again too, and follow the lights.

const Binding := preload("res://addons/lobelight/runtime/own_shaders/shader_binding.gd")
const Kit := preload("support/render_kit.gd")
const Oracle := preload("support/material_oracle.gd")
const SIDE := 48
# As screens show them.
const STEP := 1.0 / 255.0
const COLOUR := Color(0.9, 0.6, 0.3)
const FRAGMENT := VisualShader.TYPE_FRAGMENT
# Inputs of the output node.
const ALBEDO := 0
const EMISSION := 5
# Outputs of the nodes.
const OF_RADIANCE := 0
const OF_EMISSION := 1

var _view: LinearViewport
var _environment: LobeEnvironment3D
var _sphere: MeshInstance3D


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_environment = LobeEnvironment3D.new()
	_view.add_child(_environment)
	_sphere = Kit.make_sphere(null)
	_view.add_child(_sphere)


func after_test() -> void:
	_view.free()
	_sphere = null
	_environment = null


func test_a_surface_is_that_of_a_lobe_material() -> void:
	for sun: float in [0.0, 400.0]:
		await _light_up(sun)
		var shader := _new_shader()
		_add_surface(shader)
		var own := _own(shader)
		own.set_shader_parameter(&"albedo", COLOUR)
		for values: Array in [[0.45, 0.6, 0.7], [0.28, -0.86, 0.0]]:
			own.set_shader_parameter(&"roughness", values[0])
			own.set_shader_parameter(&"anisotropy", values[1])
			own.set_shader_parameter(&"metallic", values[2])
			await _compare(own, _lobe_material(values[0], values[1], values[2]))
		var path := create_temp_dir("visual_shader").path_join("surface.tres")
		assert_int(ResourceSaver.save(own, path)).is_equal(OK)
		# The code is not kept, and the nodes know their files.
		assert_str(FileAccess.get_file_as_string(path)).not_contains("fragment()")
		var loaded: LobeShaderMaterial = ResourceLoader.load(
			path, "", ResourceLoader.CACHE_MODE_IGNORE
		)
		assert_str(loaded.shader.code).is_equal(own.shader.code)
		await _compare(loaded, _lobe_material(0.28, -0.86, 0.0))


func test_typed_values_make_round_lobes() -> void:
	await _light_up(400.0)
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
	own.set_shader_parameter(&"albedo", COLOUR)
	await _compare(own, _lobe_material(0.3, 0.0, 1.0))
	assert_str(_shown_code(own)).contains("#define LOBELIGHT_ISOTROPIC")
	# Another value makes long ones.
	node.set_input_port_default_value(VisualShaderNodeLobelightReflection.ANISOTROPY, 0.9)
	await _compare(own, _lobe_material(0.3, 0.9, 1.0))
	assert_str(_shown_code(own)).not_contains("#define LOBELIGHT_ISOTROPIC")


func test_nodes_share_a_graph() -> void:
	# Half of what a matt white surface shows and half of a metal's.
	await _light_up(0.0)
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
	var matt := _lobe_material(0.4, 0.0, 0.0)
	matt.albedo_color = Color.WHITE
	matt.metallic_specular = 0.0
	var brushed := _lobe_material(0.4, 0.5, 1.0)
	brushed.albedo_color = Color.WHITE
	var both := await _capture(matt)
	var other := await _capture(brushed)
	for y in SIDE:
		for x in SIDE:
			both.set_pixel(x, y, both.get_pixel(x, y).lerp(other.get_pixel(x, y), 0.5))
	_assert_same(await _capture(_own(shader)), both)


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
		var image := await _capture(own)
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


static func _lobe_material(roughness: float, anisotropy: float, metallic: float) -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.albedo_color = COLOUR
	material.metallic = metallic
	material.roughness = roughness
	material.anisotropy_enabled = anisotropy != 0.0
	material.anisotropy = anisotropy
	return material


static func _shown_code(material: ShaderMaterial) -> String:
	return (Binding._find(material)._get_shown() as Shader).code


func _light_up(sun: float) -> void:
	var direction := Vector3(0.3, 0.5, 0.8).normalized()
	var light := func(d: Vector3) -> Color:
		var colour: Color = Oracle.light(d)
		return colour + Color.WHITE * sun if d.dot(direction) > 0.9995 else colour
	_environment.panorama = Kit.make_panorama(128, light)
	await _environment.rebuild()
	# Sources are found while frames are drawn.
	for frame in 8:
		await _view.capture()


func _capture(material: Material) -> Image:
	(_sphere.mesh as PrimitiveMesh).material = material
	await _view.capture()
	return await _view.capture()


func _compare(own: Material, ready: Material) -> void:
	_assert_same(await _capture(own), await _capture(ready))


func _assert_same(picture: Image, expected: Image) -> void:
	var largest := 0.0
	var mean := 0.0
	for y in SIDE:
		for x in SIDE:
			var one := picture.get_pixel(x, y).linear_to_srgb()
			var other := expected.get_pixel(x, y).linear_to_srgb()
			for channel in 3:
				mean += other[channel] / (3 * SIDE * SIDE)
				largest = maxf(largest, absf(minf(one[channel], 1.0) - minf(other[channel], 1.0)))
	assert_float(mean).is_greater(0.05)
	assert_float(largest).is_less(1.01 * STEP)
