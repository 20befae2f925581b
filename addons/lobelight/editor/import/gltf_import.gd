@tool
extends EditorScenePostImportPlugin
## Imports of glTF files: reads what Godot drops of their materials, and, where the file's import
## option asks for it, makes [LobeMaterial3D]s of them.

enum Materials { KEEP, LOBES }

const OPTION := "lobelight/materials"
# Blender's files are imported by way of glTF.
const ENDINGS: PackedStringArray = ["gltf", "glb", "blend"]

var _extension := LobeGLTFExtension.new()
# By the materials that they are made of: meshes share materials.
var _made: Dictionary[Material, LobeMaterial3D] = {}


## Has the engine's importer of glTF ask.
func start() -> void:
	_extension.marks_materials = true
	GLTFDocument.register_gltf_document_extension(_extension)


func stop() -> void:
	GLTFDocument.unregister_gltf_document_extension(_extension)


func _get_import_options(path: String) -> void:
	# Without a path it is for the project's settings.
	if path.is_empty() or path.get_extension().to_lower() in ENDINGS:
		add_import_option_advanced(
			TYPE_INT, OPTION, Materials.KEEP, PROPERTY_HINT_ENUM, "Keep,LobeMaterial3D"
		)


func _get_option_visibility(_path: String, for_animation: bool, option: String) -> Variant:
	return not for_animation if option == OPTION else null


func _pre_process(scene: Node) -> void:
	_made.clear()
	var makes: bool = get_option_value(OPTION) == Materials.LOBES
	for node in scene.find_children("*", "ImporterMeshInstance3D", true, false):
		var mesh := (node as ImporterMeshInstance3D).mesh
		for surface in mesh.get_surface_count() if mesh != null else 0:
			var material := mesh.get_surface_material(surface) as BaseMaterial3D
			if material == null:
				continue
			if makes:
				mesh.set_surface_material(surface, _get_made(material))
			else:
				material.remove_meta(LobeGLTFExtension.META)
	_made.clear()


func _get_made(material: BaseMaterial3D) -> LobeMaterial3D:
	if not _made.has(material):
		_made[material] = LobeGLTFExtension.to_lobe_material(material)
	return _made[material]
