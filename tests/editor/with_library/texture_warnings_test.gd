@tool
extends GdUnitTestSuite
## Warnings about flow maps and normal maps in formats that bend their directions.

const Kit := preload("res://tests/editor/editor_kit.gd")
const SceneWarnings := preload("res://addons/lobelight/editor/warnings/scene_warnings.gd")
const TextureWarnings := preload("res://addons/lobelight/editor/warnings/texture_warnings.gd")

const PATH := "res://directions.png"

# compress/mode, compress/normal_map, what is said of a flow map and of a normal map.
const IMPORTS := [
	[0, 2, "", ""],
	[1, 2, "is imported as lossy", "imported as lossy colours"],
	[1, 1, "is imported as lossy", "set Compress > Mode to VRAM Compressed"],
	[2, 2, "is imported as VRAM-compressed", "set Compress > Normal Map to Enable"],
	[2, 1, "is imported as VRAM-compressed", ""],
	[3, 2, "", ""],
	[4, 2, "is imported as Basis Universal", "set Compress > Normal Map to Enable"],
]


func before() -> void:
	Kit.get_plugin(get_tree())
	var image := Image.create_empty(8, 8, false, Image.FORMAT_RGB8)
	image.fill(Color(0.5, 0.5, 1.0))
	image.save_png(PATH)
	EditorInterface.get_resource_filesystem().scan()
	await Kit.wait_until(get_tree(), func() -> bool: return ResourceLoader.exists(PATH))
	await Kit.wait_for_scan(get_tree())


func after() -> void:
	DirAccess.remove_absolute(PATH)
	DirAccess.remove_absolute(PATH + ".import")
	EditorInterface.get_resource_filesystem().scan()
	await Kit.wait_for_scan(get_tree())


# As the Import dock writes it; the texture itself need not be imported again.
func _set_import(mode: int, normal_map: int) -> void:
	var file := ConfigFile.new()
	file.load(PATH + ".import")
	file.set_value("params", "compress/mode", mode)
	file.set_value("params", "compress/normal_map", normal_map)
	file.save(PATH + ".import")
	# Files' times are of whole seconds.
	TextureWarnings._imports.clear()


func test_imported_textures(
	mode: int, normal_map: int, flow: String, normal: String, _test_parameters := IMPORTS
) -> void:
	_set_import(mode, normal_map)
	var texture: Texture2D = load(PATH)
	_assert_said(TextureWarnings.of_flow_map(texture), flow)
	_assert_said(TextureWarnings.of_normal_map(texture), normal)


func _assert_said(said: String, expected: String) -> void:
	if expected.is_empty():
		assert_str(said).is_empty()
	else:
		assert_str(said).contains(expected)


func test_only_what_is_shown_is_warned_of() -> void:
	_set_import(2, 2)
	var material := LobeMaterial3D.new()
	var atlas := AtlasTexture.new()
	atlas.atlas = load(PATH)
	material.anisotropy_flowmap = atlas
	material.normal_texture = load(PATH)
	assert_array(Array(TextureWarnings.of(material))).is_empty()
	material.normal_enabled = true
	assert_array(Array(TextureWarnings.of(material))).has_size(1)
	material.anisotropy_enabled = true
	material.anisotropy = 0.5
	var warnings := TextureWarnings.of(material)
	assert_array(Array(warnings)).has_size(2)
	assert_str(warnings[0]).contains("directions.png").contains("Mode to Lossless")
	# The inspector and the scene's report show them.
	assert_array(Array(SceneWarnings.of_material(material, null))).contains(Array(warnings))


func test_textures_that_were_not_imported() -> void:
	var blocks := PackedByteArray()
	blocks.resize(16)
	var formats: Dictionary[Image.Format, Array] = {
		Image.FORMAT_DXT5: [true, true], Image.FORMAT_RGTC_RG: [true, false]
	}
	for format in formats:
		var image := Image.create_from_data(4, 4, false, format, blocks)
		var texture := ImageTexture.create_from_image(image)
		assert_bool(TextureWarnings.of_flow_map(texture).is_empty()).is_equal(
			not formats[format][0]
		)
		assert_bool(TextureWarnings.of_normal_map(texture).is_empty()).is_equal(
			not formats[format][1]
		)
	var plain := ImageTexture.create_from_image(Image.create_empty(4, 4, false, Image.FORMAT_RGBAH))
	assert_str(TextureWarnings.of_flow_map(plain) + TextureWarnings.of_normal_map(plain)).is_empty()
	assert_str(TextureWarnings.of_flow_map(null)).is_empty()
