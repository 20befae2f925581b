extends SceneTree
## Draws the glTF files of a folder, imported as at run time, each to NAME.f32: rows of four floats
## a pixel, linear radiance. `--folder DIR`; see gltf.py.

const PANORAMA := "res://demo/environments/hall.exr"
const SIDE := 96
const MAKE_TANGENTS := 8

# By the file's name.
var _lobes: Dictionary = {}
var _arguments := CommandLine.new("crosscheck-gltf", ["folder"])


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	var folder := _arguments.path("folder")
	_lobes = JSON.parse_string(FileAccess.get_file_as_string(folder.path_join("lobes.json")))
	_arguments.fail_if(NativeLibrary.error())
	var view := LinearViewport.new(SIDE)
	root.add_child(view)
	var environment := LobeEnvironment3D.new()
	environment.panorama = load(PANORAMA)
	view.add_child(environment)
	await environment.rebuild()
	var extension := LobeGLTFExtension.new()
	extension.make_lobe_materials = true
	GLTFDocument.register_gltf_document_extension(extension)
	for name in DirAccess.get_files_at(folder):
		if name.get_extension() == "gltf" and _arguments.error.is_empty():
			await _draw(view, folder.path_join(name))
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
	quit(0 if _arguments.error.is_empty() else 1)


func _draw(view: LinearViewport, path: String) -> void:
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	if document.append_from_file(path, state, MAKE_TANGENTS) != OK:
		_arguments.fail("%s: cannot be imported." % path)
		return
	var scene := document.generate_scene(state)
	var name := path.get_file().get_basename()
	if _lobes.has(name):
		_give_table(scene, int(_lobes[name]))
	view.add_child(scene)
	await view.capture()
	var image: Image = await view.capture()
	scene.free()
	var file := FileAccess.open(path.get_basename() + ".f32", FileAccess.WRITE)
	if file == null:
		_arguments.fail("%s: cannot be written." % path.get_basename())
		return
	file.store_buffer(image.get_data())


# A table of the widths that the material was given.
func _give_table(scene: Node, lobes: int) -> void:
	var instance: MeshInstance3D = scene.find_children("*", "MeshInstance3D", true, false)[0]
	var material: LobeMaterial3D = instance.get_active_material(0)
	var widths := LobeMaterial3D.widths_of(material.roughness, material.anisotropy)
	var recipe := {"brdf": "ggx", "alpha": widths, "lobes": lobes}
	var result: Dictionary = NativeLibrary.create(&"LobeBaker").call("bake", recipe)
	material.table = LobeTable.from_baked(result)
