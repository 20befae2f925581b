extends GdUnitTestSuite
## What LobeGLTFExtension makes of files written here, as Khronos' texts have it.

const Widths := preload("res://addons/lobelight/runtime/table/widths.gd")
const MAKE_TANGENTS := 8

## Strength, roughness.
const WIDTHS := [[0.3, 0.5], [0.6, 0.4], [1.0, 0.7], [0.9, 0.35], [0.05, 0.9]]

## A material's extensions, and what the sentence about it says.
const BAD := [
	[{"KHR_materials_anisotropy": 3}, "KHR_materials_anisotropy is 3"],
	[{"KHR_materials_anisotropy": {"anisotropyStrength": "much"}}, 'anisotropyStrength is "much"'],
	[{"KHR_materials_anisotropy": {"anisotropyStrength": 1.5}}, "anisotropyStrength is 1.5"],
	[
		{
			"KHR_materials_anisotropy":
			{"anisotropyStrength": 1.0, "anisotropyTexture": {"index": 7}}
		},
		"anisotropyTexture, number 7, is not in the file"
	],
	[{"KHR_materials_sheen": {"sheenColorFactor": [1.0]}}, "sheenColorFactor is [1.0]"],
	[{"KHR_materials_ior": {"ior": null}}, "ior is null"],
	[
		{
			"KHR_materials_clearcoat":
			{"clearcoatFactor": 1.0, "clearcoatNormalTexture": {"index": 0}}
		},
		"the normal texture of its clear coat"
	],
	[{"KHR_materials_ior": {"ior": 4.0}}, "16 % is the most"],
]

var _extension: LobeGLTFExtension


func before_test() -> void:
	_extension = LobeGLTFExtension.new()
	GLTFDocument.register_gltf_document_extension(_extension)


func after_test() -> void:
	GLTFDocument.unregister_gltf_document_extension(_extension)


func test_widths_are_those_of_the_text(
	strength: float, roughness: float, _test_parameters := WIDTHS
) -> void:
	_extension.make_lobe_materials = true
	var material: LobeMaterial3D = _import(_anisotropic(strength, 0.0, roughness))
	var alpha := roughness * roughness
	var widths := LobeMaterial3D.widths_of(material.roughness, material.anisotropy)
	assert_bool(material.anisotropy_enabled).is_true()
	var wide := lerpf(alpha, 1.0, strength * strength)
	assert_float(widths.x).is_equal_approx(wide, 0.002 * wide)
	assert_float(widths.y).is_equal_approx(alpha, 0.002 * alpha)
	assert_array(_extension.problems).is_empty()


func test_widths_that_are_too_far_apart_are_clamped_and_said() -> void:
	_extension.make_lobe_materials = true
	var material: LobeMaterial3D = _import(_anisotropic(1.0, 0.0, 0.05))
	var widths := LobeMaterial3D.widths_of(material.roughness, material.anisotropy)
	assert_float(widths.x).is_equal_approx(1.0, 0.01)
	assert_float(widths.x / widths.y).is_equal_approx(100.0, 1.0)
	assert_str("\n".join(_extension.problems)).contains("100:1")


func test_materials_of_godot_get_anisotropy_within_their_range() -> void:
	var material: StandardMaterial3D = _import(_anisotropic(0.6, 0.5, 0.5))
	assert_bool(material.anisotropy_enabled).is_true()
	var widths := Widths.from_roughness(material.roughness, material.anisotropy)
	assert_float(widths.x).is_equal_approx(lerpf(0.25, 1.0, 0.36), 0.002)
	assert_float(widths.y).is_equal_approx(0.25, 0.002)
	var flow := _flow_at(material.anisotropy_flowmap, 0, 0)
	assert_vector(flow).is_equal_approx(Vector2.from_angle(0.5), Vector2.ONE * 0.002)
	assert_bool(material.has_meta(LobeGLTFExtension.META)).is_false()
	# Godot's materials end at 10:1; the wider width is kept.
	material = _import(_anisotropic(1.0, 0.0, 0.2))
	assert_float(material.anisotropy).is_equal_approx(1.0, 0.001)
	widths = Widths.from_roughness(material.roughness, material.anisotropy)
	assert_float(widths.x).is_equal_approx(1.0, 0.01)


func test_rotation_is_counter_clockwise_from_the_tangent() -> void:
	_extension.make_lobe_materials = true
	var material: LobeMaterial3D = _import(_anisotropic(0.6, 0.7, 0.5))
	assert_float(material.anisotropy_rotation).is_equal_approx(0.7, 1e-5)
	assert_object(material.anisotropy_flowmap).is_null()


func test_textures_have_direction_and_strength() -> void:
	_extension.make_lobe_materials = true
	# Left along the tangent with full strength, right along the bitangent with half of it.
	var image := Image.create_empty(2, 1, false, Image.FORMAT_RGB8)
	image.set_pixel(0, 0, Color8(255, 128, 255))
	image.set_pixel(1, 0, Color8(128, 255, 128))
	var described := _anisotropic(0.8, PI / 2.0, 0.5)
	var anisotropy: Dictionary = described["extensions"]["KHR_materials_anisotropy"]
	anisotropy["anisotropyTexture"] = {"index": 0}
	var material: LobeMaterial3D = _import(described, [image])
	assert_vector(_flow_at(material.anisotropy_flowmap, 0, 0)).is_equal_approx(
		Vector2(0.0, 1.0), Vector2.ONE * 0.01
	)
	assert_vector(_flow_at(material.anisotropy_flowmap, 1, 0)).is_equal_approx(
		Vector2(-1.0, 0.0), Vector2.ONE * 0.01
	)
	for texel in 2:
		var strength := 0.8 if texel == 0 else 0.8 * 128.0 / 255.0
		var share := material.anisotropy_flowmap.get_image().get_pixel(texel, 0).a
		var rough := material.roughness_texture.get_image().get_pixel(texel, 0).r
		var widths := LobeMaterial3D.widths_of(
			material.roughness * rough, material.anisotropy * share
		)
		assert_float(widths.x).is_equal_approx(lerpf(0.25, 1.0, strength * strength), 0.01)
		assert_float(widths.y).is_equal_approx(0.25, 0.01)


func test_a_strength_that_is_the_same_everywhere_needs_no_roughness_texture() -> void:
	_extension.make_lobe_materials = true
	var image := Image.create_empty(2, 2, false, Image.FORMAT_RGB8)
	image.fill(Color8(128, 255, 255))
	var described := _anisotropic(0.8, 0.0, 0.5)
	var anisotropy: Dictionary = described["extensions"]["KHR_materials_anisotropy"]
	anisotropy["anisotropyTexture"] = {"index": 0}
	var material: LobeMaterial3D = _import(described, [image])
	assert_object(material.roughness_texture).is_null()
	assert_bool(material.varies()).is_false()


func test_roughness_textures_are_converted() -> void:
	_extension.make_lobe_materials = true
	var image := Image.create_empty(2, 1, false, Image.FORMAT_RGB8)
	image.set_pixel(0, 0, Color8(0, 255, 255))
	image.set_pixel(1, 0, Color8(0, 153, 255))
	var described := _anisotropic(0.7, 0.0, 1.0)
	described["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {"index": 0}
	var material: LobeMaterial3D = _import(described, [image])
	for texel in 2:
		var alpha := 1.0 if texel == 0 else 0.36
		var share := material.anisotropy_flowmap.get_image().get_pixel(texel, 0).a
		var rough := material.roughness_texture.get_image().get_pixel(texel, 0).r
		var widths := LobeMaterial3D.widths_of(
			material.roughness * rough, material.anisotropy * share
		)
		assert_float(widths.x).is_equal_approx(lerpf(alpha, 1.0, 0.49), 0.015)
		assert_float(widths.y).is_equal_approx(alpha, 0.015)
	assert_int(material.metallic_texture_channel).is_equal(BaseMaterial3D.TEXTURE_CHANNEL_BLUE)


func test_everything_else_that_is_read() -> void:
	_extension.make_lobe_materials = true
	var described := {
		"pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.6},
		"extensions":
		{
			"KHR_materials_ior": {"ior": 1.33},
			"KHR_materials_specular": {"specularFactor": 0.5},
			"KHR_materials_clearcoat":
			{
				"clearcoatFactor": 0.8,
				"clearcoatRoughnessFactor": 0.2,
				"clearcoatTexture": {"index": 0},
			},
			"KHR_materials_sheen":
			{
				"sheenColorFactor": [0.5, 0.25, 0.0],
				"sheenRoughnessFactor": 0.4,
				"sheenColorTexture": {"index": 0},
			},
		},
	}
	var image := Image.create_empty(2, 2, false, Image.FORMAT_RGB8)
	image.fill(Color8(51, 0, 0))
	var material: LobeMaterial3D = _import(described, [image])
	var f0 := 0.5 * pow(0.33 / 2.33, 2.0)
	assert_float(material.metallic_specular).is_equal_approx(sqrt(f0 / 0.16), 1e-4)
	assert_bool(material.clearcoat_enabled).is_true()
	assert_float(material.clearcoat).is_equal_approx(0.8, 1e-5)
	assert_float(Widths.from_coat_roughness(material.clearcoat_roughness)).is_equal_approx(
		0.04, 1e-4
	)
	var coat := material.clearcoat_texture.get_image().get_pixel(0, 0)
	assert_float(coat.r).is_equal_approx(0.2, 0.005)
	assert_float(coat.g).is_equal_approx(1.0, 0.005)
	assert_bool(material.sheen_enabled).is_true()
	assert_float(material.sheen_color.srgb_to_linear().g).is_equal_approx(0.25, 0.002)
	assert_float(material.sheen_roughness).is_equal_approx(0.4, 1e-5)
	assert_object(material.sheen_texture).is_not_null()
	assert_array(_extension.problems).is_empty()


func test_a_transform_that_all_textures_share_is_taken() -> void:
	var transform := {"KHR_texture_transform": {"scale": [2.0, 3.0], "offset": [0.5, 0.25]}}
	var described := _anisotropic(0.5, 0.0, 0.5)
	var anisotropy: Dictionary = described["extensions"]["KHR_materials_anisotropy"]
	anisotropy["anisotropyTexture"] = {"index": 0, "extensions": transform}
	var image := Image.create_empty(2, 2, false, Image.FORMAT_RGB8)
	image.fill(Color8(255, 128, 255))
	var material: StandardMaterial3D = _import(described, [image])
	assert_vector(material.uv1_scale).is_equal(Vector3(2.0, 3.0, 1.0))
	assert_vector(material.uv1_offset).is_equal(Vector3(0.5, 0.25, 0.0))
	described["normalTexture"] = {"index": 0}
	material = _import(described, [image])
	assert_vector(material.uv1_scale).is_equal(Vector3.ONE)
	assert_str("\n".join(_extension.problems)).contains("different transforms")


func test_bad_files_get_one_sentence(
	extensions: Dictionary, sentence: String, _test_parameters := BAD
) -> void:
	_extension.make_lobe_materials = true
	var material: Material = _import({"name": "odd", "extensions": extensions})
	assert_object(material).is_not_null()
	assert_int(_extension.problems.size()).is_equal(1)
	assert_str(_extension.problems[0]).contains(sentence).contains('material "odd"')


func test_materials_stay_godots_where_nothing_asks_for_more() -> void:
	var material: StandardMaterial3D = _import({"pbrMetallicRoughness": {"roughnessFactor": 0.3}})
	assert_float(material.roughness).is_equal_approx(0.3, 1e-6)
	assert_bool(material.anisotropy_enabled).is_false()
	assert_float(material.metallic_specular).is_equal_approx(0.5, 1e-6)


func test_scenes_are_made_with_the_materials() -> void:
	_extension.make_lobe_materials = true
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	var file := _file(_anisotropic(0.5, 0.0, 0.5), [])
	assert_int(document.append_from_buffer(file, "", state, MAKE_TANGENTS)).is_equal(OK)
	var scene := document.generate_scene(state)
	var meshes := scene.find_children("*", "MeshInstance3D", true, false)
	var instance: MeshInstance3D = meshes[0]
	assert_object(instance.get_active_material(0) as LobeMaterial3D).is_not_null()
	scene.free()


static func _anisotropic(strength: float, rotation: float, roughness: float) -> Dictionary:
	return {
		"name": "brushed",
		"pbrMetallicRoughness": {"metallicFactor": 1.0, "roughnessFactor": roughness},
		"extensions":
		{
			"KHR_materials_anisotropy":
			{"anisotropyStrength": strength, "anisotropyRotation": rotation}
		},
	}


static func _flow_at(map: Texture2D, x: int, y: int) -> Vector2:
	var texel := map.get_image().get_pixel(x, y)
	return 2.0 * Vector2(texel.r, texel.g) - Vector2.ONE


# The material of a file's only triangle.
func _import(described: Dictionary, images: Array = []) -> Material:
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	var error := document.append_from_buffer(_file(described, images), "", state, MAKE_TANGENTS)
	assert_int(error).is_equal(OK)
	return state.meshes[0].mesh.get_surface_material(0)


static func _file(described: Dictionary, images: Array) -> PackedByteArray:
	var points := PackedFloat32Array([0, 0, 0, 1, 0, 0, 0, 1, 0])
	points.append_array(PackedFloat32Array([0, 0, 1, 0, 0, 1, 0, 0, 1]))
	points.append_array(PackedFloat32Array([0, 0, 1, 0, 0, 1]))
	var bytes := points.to_byte_array()
	var triangle := {
		"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2},
		"material": 0,
	}
	var file := {
		"asset": {"version": "2.0"},
		"scene": 0,
		"scenes": [{"nodes": [0]}],
		"nodes": [{"mesh": 0}],
		"meshes": [{"primitives": [triangle]}],
		"materials": [described],
		"buffers":
		[
			{
				"byteLength": bytes.size(),
				"uri": "data:application/octet-stream;base64," + Marshalls.raw_to_base64(bytes),
			}
		],
		"bufferViews":
		[
			{"buffer": 0, "byteOffset": 0, "byteLength": 36},
			{"buffer": 0, "byteOffset": 36, "byteLength": 36},
			{"buffer": 0, "byteOffset": 72, "byteLength": 24},
		],
		"accessors":
		[
			{
				"bufferView": 0,
				"componentType": 5126,
				"count": 3,
				"type": "VEC3",
				"min": [0, 0, 0],
				"max": [1, 1, 0],
			},
			{"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"},
			{"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2"},
		],
		"extensionsUsed": (described.get("extensions", {}) as Dictionary).keys(),
	}
	if not images.is_empty():
		file["textures"] = []
		file["images"] = []
	for image: Image in images:
		file["textures"].append({"source": file["images"].size()})
		var png := Marshalls.raw_to_base64(image.save_png_to_buffer())
		file["images"].append({"uri": "data:image/png;base64," + png})
	return JSON.stringify(file).to_utf8_buffer()
