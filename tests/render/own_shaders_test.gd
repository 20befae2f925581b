extends GdUnitTestSuite
## Materials with shaders of one's own, written as lobelight.gdshaderinc says: they show what the
## equal LobeMaterial3D shows, and follow the lights as it does.

const Binding := preload("res://addons/lobelight/runtime/own_shaders/shader_binding.gd")
const Kit := preload("support/render_kit.gd")
const LightRegistry := preload("res://addons/lobelight/runtime/light/light_registry.gd")
const Bench := preload("support/own_shader_bench.gd")
const SIDE := Bench.SIDE
# As screens show them.
const STEP := 1.0 / 255.0
const SHADER := """
shader_type spatial;
render_mode ambient_light_disabled;
%s
#include "res://addons/lobelight/lobelight.gdshaderinc"

uniform vec3 albedo : source_color;
uniform float metallic;
uniform float roughness;
uniform float anisotropy;

void fragment() {
	LobelightPixel pixel = LOBELIGHT_PIXEL;
	vec3 colour = lobelight_linear(albedo);
	vec3 light = lobelight_surface(
			pixel, NORMAL, TANGENT, roughness, anisotropy, colour, metallic, 0.5);
	EMISSION = lobelight_emission(light);
	ALBEDO = vec3(0.0);
	ROUGHNESS = 1.0;
	SPECULAR = 0.0;
}
"""
const METAL := """
shader_type spatial;
render_mode ambient_light_disabled;
#include "res://addons/lobelight/lobelight.gdshaderinc"

void fragment() {
	LobelightPixel pixel = LOBELIGHT_PIXEL;
	vec3 light = lobelight_reflection(pixel, NORMAL, TANGENT, 0.4, 0.0, vec3(1.0));
	EMISSION = lobelight_emission(light);
	ALBEDO = vec3(0.0);
}
"""
# Roughness, anisotropy, metallic.
const CASES := [
	[0.3, 0.0, 1.0],
	[0.5, 0.0, 0.0],
	[0.45, 0.6, 1.0],
	[0.4, -0.7, 0.5],
	[0.28, 0.86, 1.0],
	[0.22, 1.0, 1.0],
]

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


func test_surfaces_are_those_of_lobe_materials(
	roughness: float, anisotropy: float, metallic: float, _test_parameters := CASES
) -> void:
	await _bench.light_up(400.0)
	# Without anisotropy LobeMaterial3D has the isotropic lobes.
	var defines := "#define LOBELIGHT_ISOTROPIC" if anisotropy == 0.0 else ""
	var own := _own_surface(roughness, anisotropy, metallic, defines)
	await _compare(own, Bench.lobe_material(roughness, anisotropy, metallic))
	assert_str(_shown_code(own)).contains("#define LOBELIGHT_SOURCES")


func test_rooms_are_seen_from_where_the_pixel_is() -> void:
	await _bench.light_up(0.0)
	var probe := LobeProbe3D.new()
	probe.light = LobeLight.make_constant(Color(0.1, 0.9, 0.3), true)
	# It ends across the sphere.
	probe.position = Vector3(-4.0, 0.0, 0.0)
	probe.size = 8.0 * Vector3.ONE
	probe.blend_distance = 0.5
	_view.add_child(probe)
	var own := _own_surface(0.4, 0.5, 0.5)
	await _compare(own, Bench.lobe_material(0.4, 0.5, 0.5))
	assert_str(_shown_code(own)).contains("#define LOBELIGHT_PLACED")
	probe.free()
	# Lights that leave stay for some frames.
	for frame in 6:
		await _view.capture()
	await _compare(own, Bench.lobe_material(0.4, 0.5, 0.5))
	assert_str(_shown_code(own)).not_contains("#define LOBELIGHT_PLACED")


func test_the_light_is_followed_until_unbound() -> void:
	_environment.panorama = Kit.constant(0.25)
	await _environment.rebuild()
	var own := _own(METAL)
	assert_float(await _middle_of(own)).is_equal_approx(0.25, 0.002)
	_environment.panorama = Kit.constant(0.5)
	await _environment.rebuild()
	assert_float(await _middle_of(own)).is_equal_approx(0.5, 0.004)
	# A light of its own, and back.
	LobeLight.bind(own, null, LobeLight.make_constant(Color(0.125, 0.125, 0.125), true))
	assert_float(await _middle_of(own)).is_equal_approx(0.125, 0.002)
	LobeLight.bind(own)
	assert_float(await _middle_of(own)).is_equal_approx(0.5, 0.004)
	LobeLight.unbind(own)
	LobeLight.unbind(own)
	assert_float(await _middle_of(own)).is_equal_approx(0.0, 0.001)
	LobeLight.bind(own)
	assert_float(await _middle_of(own)).is_equal_approx(0.5, 0.004)
	# Before the binding has looked at it.
	own.shader = Shader.new()
	own.shader.code = METAL.replace("lobelight_emission(light)", "lobelight_emission(light + 0.25)")
	LobeLight.unbind(own)
	assert_float(await _middle_of(own)).is_equal_approx(0.25, 0.002)
	var fleeting := _own(METAL)
	LobeLight.unbind(fleeting)
	assert_float(await _middle_of(fleeting)).is_equal_approx(0.0, 0.001)


func test_other_shaders_and_other_code_are_followed() -> void:
	_environment.panorama = Kit.constant(0.5)
	await _environment.rebuild()
	var own := _own(METAL)
	assert_float(await _middle_of(own)).is_equal_approx(0.5, 0.004)
	own.shader.code = METAL.replace("vec3(1.0)", "vec3(0.5)")
	var half := await _middle_of(own)
	assert_float(half).is_between(0.2, 0.3)
	# Isotropic code wants another texture of lobes.
	own.shader.code = METAL.replace("#include", "#define LOBELIGHT_ISOTROPIC\n#include")
	assert_float(await _middle_of(own)).is_equal_approx(0.5, 0.004)
	var other := Shader.new()
	other.code = METAL.replace("vec3(1.0)", "vec3(0.5)")
	own.shader = other
	assert_float(await _middle_of(own)).is_equal_approx(half, 0.002)
	own.shader = null
	await _view.capture()


func test_uniforms_may_have_any_name() -> void:
	# The engine takes every variable for the uniform of its name.
	_environment.panorama = Kit.constant(0.5)
	await _environment.rebuild()
	var uniforms := ""
	for named: String in [
		"vec4 f0", "vec4 normal", "float roughness", "float energy", "vec2 widths"
	]:
		uniforms += "uniform %s;\n" % named
	var own := _own(METAL.replace("void fragment", uniforms + "\nvoid fragment"))
	assert_float(await _middle_of(own)).is_equal_approx(0.5, 0.004)


func test_ward_is_ward() -> void:
	await _bench.light_up(400.0)
	var tables: LobeTableSet = load("res://addons/lobelight/tables/ward_8.res")
	var own := _own_surface(0.25, 0.9, 1.0)
	LobeLight.bind(own, tables)
	var ready := Bench.lobe_material(0.25, 0.9, 1.0)
	ready.table_set = tables
	await _compare(own, ready)


func test_a_lobe_shader_material_binds_itself_and_saves_nothing_of_the_light() -> void:
	_environment.panorama = Kit.constant(0.5)
	await _environment.rebuild()
	var made := LobeShaderMaterial.new()
	made.shader = Shader.new()
	made.shader.code = METAL
	assert_float(await _middle_of(made)).is_equal_approx(0.5, 0.004)
	var path := create_temp_dir("own_shaders").path_join("material.tres")
	assert_int(ResourceSaver.save(made, path)).is_equal(OK)
	# The engine saves numbers of all parameters, those of the light as they are without one.
	var text := FileAccess.get_file_as_string(path)
	assert_str(text).contains("shader_parameter/lobelight_environment_energy = 0.0")
	for kind: String in ["Cubemap", "Texture", "Image"]:
		assert_str(text).not_contains(kind)
	var loaded: LobeShaderMaterial = ResourceLoader.load(
		path, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP
	)
	assert_float(await _middle_of(loaded)).is_equal_approx(0.5, 0.004)
	var plain := _own(METAL)
	await _middle_of(plain)
	assert_int(ResourceSaver.save(plain, path)).is_equal(OK)
	plain = ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP)
	LobeLight.bind(plain)
	assert_float(await _middle_of(plain)).is_equal_approx(0.5, 0.004)
	var copy: LobeShaderMaterial = loaded.duplicate()
	assert_float(await _middle_of(copy)).is_equal_approx(0.5, 0.004)


func test_includes_may_be_relative() -> void:
	# The variants that lights ask for are no files.
	var folder := create_temp_dir("own_shaders")
	var include := FileAccess.open(folder.path_join("half.gdshaderinc"), FileAccess.WRITE)
	include.store_string("const float HALF = 0.5;\n")
	include.close()
	var path := folder.path_join("metal.gdshader")
	var file := FileAccess.open(path, FileAccess.WRITE)
	var code := METAL.replace("void fragment", '#include "half.gdshaderinc"\n\nvoid fragment')
	file.store_string(code.replace("vec3(1.0)", "vec3(2.0 * HALF)"))
	file.close()
	_environment.panorama = Kit.constant(0.5)
	await _environment.rebuild()
	var made := LobeShaderMaterial.new()
	made.shader = load(path)
	# From a box, which takes another variant.
	made.light = LobeLight.make_constant(Color(0.125, 0.125, 0.125), false)
	assert_float(await _middle_of(made)).is_equal_approx(0.125, 0.002)
	assert_str(_shown_code(made)).contains("#define LOBELIGHT_STRETCHED_LEVELS")


func test_nothing_is_kept_of_what_has_gone() -> void:
	var before: int = LightRegistry._materials.size()
	var bindings: int = Binding._bindings.size()
	var all := _make_on_threads()
	assert_int(LightRegistry._materials.size()).is_equal(before + 80)
	# Some have been updated when they go, some not.
	all.resize(30)
	await await_idle_frame()
	await await_idle_frame()
	all.clear()
	assert_int(LightRegistry._materials.size()).is_equal(before)
	assert_int(Binding._bindings.size()).is_equal(bindings)


func test_shaders_that_do_not_include_it_are_named() -> void:
	var material := ShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = "shader_type spatial;\nvoid fragment() {}\n"
	var bind := func() -> void:
		LobeLight.bind(material)
		await await_idle_frame()
		await await_idle_frame()
	await assert_error(bind).is_push_error(
		(
			"LobeLight.bind: the shader of a material does not include"
			+ " res://addons/lobelight/lobelight.gdshaderinc."
		)
	)
	LobeLight.unbind(material)
	await (
		assert_error(func() -> void: LobeLight.bind(null))
		. is_push_error("LobeLight.bind: there is no material.")
	)


# Not in tests/runtime: the storage of the engine's headless renderer is not made for threads.
func _make_on_threads() -> Array[ShaderMaterial]:
	var make := func() -> Array[ShaderMaterial]:
		var made: Array[ShaderMaterial] = []
		for i in 20:
			made.append(_own(METAL) if i % 2 == 0 else LobeShaderMaterial.new())
		return made
	var threads: Array[Thread] = []
	for i in 4:
		threads.append(Thread.new())
		threads[i].start(make)
	var all: Array[ShaderMaterial] = []
	for thread in threads:
		all.append_array(thread.wait_to_finish())
	return all


static func _own_surface(
	roughness: float, anisotropy: float, metallic: float, defines := ""
) -> ShaderMaterial:
	var own := _own(SHADER % defines)
	own.set_shader_parameter(&"albedo", Bench.COLOUR)
	own.set_shader_parameter(&"metallic", metallic)
	own.set_shader_parameter(&"roughness", roughness)
	own.set_shader_parameter(&"anisotropy", anisotropy)
	return own


static func _own(code: String) -> ShaderMaterial:
	var material := ShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = code
	LobeLight.bind(material)
	return material


func _middle_of(material: Material) -> float:
	var image := await _bench.capture(material)
	return image.get_pixel(SIDE / 2, SIDE / 2).r


static func _shown_code(material: ShaderMaterial) -> String:
	return (Binding._find(material)._get_shown() as Shader).code


func _compare(own: Material, ready: Material) -> void:
	_assert_same(await _bench.capture(own), await _bench.capture(ready))


func _assert_same(picture: Image, expected: Image) -> void:
	var found := Bench.compare(picture, expected)
	assert_float(found["mean"]).is_greater(0.05)
	assert_float(found["largest"]).is_less(1.01 * STEP)
