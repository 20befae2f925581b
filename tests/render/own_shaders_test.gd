extends GdUnitTestSuite
## Materials with shaders of one's own, written as lobelight.gdshaderinc says: they show what the
## equal LobeMaterial3D shows, and follow the lights as it does.

const Binding := preload("res://addons/lobelight/runtime/own_shaders/shader_binding.gd")
const Kit := preload("support/render_kit.gd")
const LightRegistry := preload("res://addons/lobelight/runtime/light/light_registry.gd")
const Oracle := preload("support/material_oracle.gd")
const SIDE := 48
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


func test_surfaces_are_those_of_lobe_materials(
	roughness: float, anisotropy: float, metallic: float, _test_parameters := CASES
) -> void:
	for sun: float in [0.0, 400.0]:
		await _light_up(sun)
		for defines: String in ["", "#define LOBELIGHT_ISOTROPIC"]:
			# Without anisotropy LobeMaterial3D has the isotropic lobes.
			if (anisotropy == 0.0) == defines.is_empty():
				continue
			var own := _own(SHADER % defines)
			own.set_shader_parameter(&"albedo", Color(0.9, 0.6, 0.3))
			own.set_shader_parameter(&"metallic", metallic)
			own.set_shader_parameter(&"roughness", roughness)
			own.set_shader_parameter(&"anisotropy", anisotropy)
			var ready := _lobe_material(roughness, anisotropy, metallic)
			await _compare(own, ready)


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


static func _own(code: String) -> ShaderMaterial:
	var material := ShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = code
	LobeLight.bind(material)
	return material


static func _lobe_material(roughness: float, anisotropy: float, metallic: float) -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.albedo_color = Color(0.9, 0.6, 0.3)
	material.metallic = metallic
	material.roughness = roughness
	material.anisotropy_enabled = anisotropy != 0.0
	material.anisotropy = anisotropy
	return material


func _compare(own: Material, ready: Material) -> void:
	var pictures: Array[Image] = []
	for material: Material in [own, ready]:
		(_sphere.mesh as PrimitiveMesh).material = material
		await _view.capture()
		pictures.append(await _view.capture())
	var largest := 0.0
	var mean := 0.0
	for y in SIDE:
		for x in SIDE:
			var one := pictures[0].get_pixel(x, y).linear_to_srgb()
			var other := pictures[1].get_pixel(x, y).linear_to_srgb()
			for channel in 3:
				mean += other[channel] / (3 * SIDE * SIDE)
				largest = maxf(largest, absf(minf(one[channel], 1.0) - minf(other[channel], 1.0)))
	assert_float(mean).is_greater(0.05)
	assert_float(largest).is_less(1.01 * STEP)
