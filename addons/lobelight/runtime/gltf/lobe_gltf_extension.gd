@tool
class_name LobeGLTFExtension
extends GLTFDocumentExtension
## Reads what Godot's importer of glTF drops of materials: anisotropy, clear coats, the index of
## refraction, specular strength and sheen.
##
## With the addon enabled the editor's imports have it, and the import option
## [code]lobelight/materials[/code] says whether materials become [LobeMaterial3D]s. At run time:
## [codeblock]
## var extension := LobeGLTFExtension.new()
## extension.make_lobe_materials = true
## GLTFDocument.register_gltf_document_extension(extension)
## var document := GLTFDocument.new()
## var state := GLTFState.new()
## # 8 makes tangents for meshes that have none.
## document.append_from_file("user://lamp.glb", state, 8)
## add_child(document.generate_scene(state))
## [/codeblock]
## [br][br]
## [code]KHR_materials_anisotropy[/code] gives the two widths of the text: α = r² across, and along
## the direction [code]mix(α, 1, strength²)[/code]. Widths more than 100:1 apart (10:1 in
## [StandardMaterial3D]) get the narrower one widened. Its texture becomes a flow map, and where
## strength or roughness vary, a roughness texture; both are stored with the scene, of 1024 texels a
## side at most.
## [br][br]
## [code]KHR_materials_clearcoat[/code] without its normal texture: the coat has the mesh's normal.
## [code]KHR_materials_ior[/code] and [code]KHR_materials_specular[/code] set [member
## BaseMaterial3D.metallic_specular]; the latter's colour counts by its luminance, and its textures
## are left out. [code]KHR_materials_sheen[/code] needs a [LobeMaterial3D], and its roughness
## texture is left out. [code]KHR_texture_transform[/code] counts where all textures of a material
## have the same, as Godot has one for all; its rotation is left out.
## [br][br]
## What a file asks for and does not get, warnings say.

const MaterialReader := preload("material_reader.gd")

## The metadata of a material of Godot's for what it cannot hold itself, see [member
## marks_materials].
const META := &"lobelight_gltf"

## Whether materials become [LobeMaterial3D]s. Otherwise they stay Godot's and get what these can
## hold.
var make_lobe_materials := false
## Whether materials that stay Godot's are given, as metadata of the name [constant META], the
## properties that a [LobeMaterial3D] made of them is to have besides. The editor's import asks for
## it.
var marks_materials := false
## What the last file asked for and did not get, a sentence for each.
var problems: PackedStringArray = []


## The [LobeMaterial3D] for a material of Godot's that came out of an import with [member
## marks_materials].
static func to_lobe_material(material: BaseMaterial3D) -> LobeMaterial3D:
	var more: Dictionary = material.get_meta(META, {})
	material.remove_meta(META)
	var made := LobeMaterial3D.from_standard(material)
	for property: StringName in more:
		made.set(property, more[property])
	return made


func _get_supported_extensions() -> PackedStringArray:
	return PackedStringArray(
		[
			"KHR_materials_anisotropy",
			"KHR_materials_clearcoat",
			"KHR_materials_ior",
			"KHR_materials_sheen",
			"KHR_materials_specular",
		]
	)


# Materials are whole here: meshes have told them whether they have colours.
func _import_post_parse(state: GLTFState) -> Error:
	problems.clear()
	var materials := state.materials
	var described: Array = state.json.get("materials", [])
	var exchanged: Dictionary[Material, Material] = {}
	for index in mini(materials.size(), described.size()):
		var material := materials[index] as BaseMaterial3D
		if material == null or described[index] is not Dictionary:
			continue
		var reader := MaterialReader.new(state, described[index] as Dictionary)
		reader.apply(material)
		_tell(state, material, reader.problems)
		if make_lobe_materials or marks_materials:
			material.set_meta(META, reader.more)
		if make_lobe_materials:
			exchanged[material] = to_lobe_material(material)
			materials[index] = exchanged[material]
	state.materials = materials
	_exchange(state, exchanged)
	return OK


func _tell(state: GLTFState, material: Material, sentences: PackedStringArray) -> void:
	for sentence in sentences:
		var file := state.filename + ": " if state.filename else ""
		problems.append('%smaterial "%s": %s' % [file, material.resource_name, sentence])
		push_warning(problems[-1])


static func _exchange(state: GLTFState, exchanged: Dictionary[Material, Material]) -> void:
	if exchanged.is_empty():
		return
	for gltf_mesh: GLTFMesh in state.meshes:
		var mesh := gltf_mesh.mesh
		for surface in mesh.get_surface_count() if mesh != null else 0:
			var material := mesh.get_surface_material(surface)
			mesh.set_surface_material(surface, exchanged.get(material, material))
		var own := gltf_mesh.instance_materials
		for index in own.size():
			own[index] = exchanged.get(own[index], own[index])
		gltf_mesh.instance_materials = own
