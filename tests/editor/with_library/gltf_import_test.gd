@tool
extends GdUnitTestSuite
## glTF files in the running editor: the import option, and what materials become.

const GltfImport := preload("res://addons/lobelight/editor/import/gltf_import.gd")
const Kit := preload("res://tests/editor/editor_kit.gd")

const FOLDER := "res://gltf"
const PATH := FOLDER + "/brushed.gltf"
const FILE := {
	"asset": {"version": "2.0"},
	"extensionsUsed": ["KHR_materials_anisotropy", "KHR_materials_sheen"],
	"scene": 0,
	"scenes": [{"nodes": [0]}],
	"nodes": [{"mesh": 0}],
	"meshes":
	[
		{
			"primitives":
			[{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "material": 0}]
		}
	],
	"materials":
	[
		{
			"name": "brushed",
			"pbrMetallicRoughness": {"metallicFactor": 1.0, "roughnessFactor": 0.5},
			"extensions":
			{
				"KHR_materials_anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": 0.5},
				"KHR_materials_sheen": {"sheenColorFactor": [1.0, 0.0, 0.0]},
			},
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
}


func before() -> void:
	Kit.get_plugin(get_tree())
	DirAccess.make_dir_absolute(FOLDER)
	_write()
	await _scan(true)


func after() -> void:
	for file in DirAccess.get_files_at(FOLDER):
		DirAccess.remove_absolute(FOLDER.path_join(file))
	DirAccess.remove_absolute(FOLDER)
	await _scan(false)


# The scan begins and ends some frames later.
func _scan(is_there: bool) -> void:
	var files := EditorInterface.get_resource_filesystem()
	files.scan()
	var is_known := func() -> bool:
		return not files.is_scanning() and (files.get_filesystem_path(FOLDER) != null) == is_there
	await Kit.wait_until(get_tree(), is_known)


func test_the_import_option_says_what_materials_become() -> void:
	# The engine's importer with the option's default.
	var kept := _import(GltfImport.Materials.KEEP) as StandardMaterial3D
	assert_object(kept).is_not_null()
	assert_bool(kept.anisotropy_enabled).is_true()
	assert_object(kept.anisotropy_flowmap).is_not_null()
	assert_array(kept.get_meta_list()).is_empty()
	# Twice: nothing is lost when the source is imported anew.
	for time in 2:
		var made := _import(GltfImport.Materials.LOBES) as LobeMaterial3D
		assert_object(made).is_not_null()
		assert_float(made.anisotropy_rotation).is_equal_approx(0.5, 1e-5)
		assert_object(made.anisotropy_flowmap).is_null()
		assert_bool(made.sheen_enabled).is_true()
		var widths := LobeMaterial3D.widths_of(made.roughness, made.anisotropy)
		assert_float(widths.x).is_equal_approx(lerpf(0.25, 1.0, 0.36), 0.002)


func test_the_option_is_offered_for_gltf_alone() -> void:
	var config := ConfigFile.new()
	assert_int(config.load(PATH + ".import")).is_equal(OK)
	assert_bool(config.has_section_key("params", GltfImport.OPTION)).is_true()
	var importer := GltfImport.new()
	assert_bool(importer._get_option_visibility("", false, GltfImport.OPTION)).is_true()
	assert_bool(importer._get_option_visibility("", true, GltfImport.OPTION)).is_false()


func _write() -> void:
	var points := PackedFloat32Array([0, 0, 0, 1, 0, 0, 0, 1, 0])
	points.append_array(PackedFloat32Array([0, 0, 1, 0, 0, 1, 0, 0, 1]))
	points.append_array(PackedFloat32Array([0, 0, 1, 0, 0, 1]))
	var bytes := Marshalls.raw_to_base64(points.to_byte_array())
	var file := FILE.duplicate(true)
	file["buffers"] = [{"byteLength": 96, "uri": "data:application/octet-stream;base64," + bytes}]
	FileAccess.open(PATH, FileAccess.WRITE).store_string(JSON.stringify(file))


# Imports the file, as the dock does, and gives the material of the saved scene.
func _import(materials: int) -> Material:
	var config := ConfigFile.new()
	config.load(PATH + ".import")
	config.set_value("remap", "importer", "scene")
	config.set_value("params", GltfImport.OPTION, materials)
	config.save(PATH + ".import")
	EditorInterface.get_resource_filesystem().update_file(PATH)
	EditorInterface.get_resource_filesystem().reimport_files([PATH])
	var packed := (
		ResourceLoader.load(PATH, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP) as PackedScene
	)
	var scene := packed.instantiate()
	var meshes := scene.find_children("*", "MeshInstance3D", true, false)
	var material := (meshes[0] as MeshInstance3D).get_active_material(0)
	scene.free()
	return material
