@tool
extends EditorPlugin
## Goes through the guide in the running editor, takes a picture of each step and quits:
## "++ --guide-pictures FOLDER".

const OPTION := "--guide-pictures"
const ADDON := "lobelight"
const SCENE := "res://sphere.tscn"
const SIZE := Vector2i(1400, 860)

var _folder := ""
var _failed := false
var _root: Node3D


func _enter_tree() -> void:
	var arguments := OS.get_cmdline_user_args()
	var option := arguments.find(OPTION)
	if option >= 0 and option + 1 < arguments.size():
		_folder = arguments[option + 1]
		_run.call_deferred()


func _run() -> void:
	while EditorInterface.get_resource_filesystem().is_scanning():
		await get_tree().process_frame
	get_window().mode = Window.MODE_WINDOWED
	get_window().size = SIZE
	await _wait(1.0)
	await _enable()
	await _build_scene()
	await _show_report()
	await _bake_table()
	await _show_import()
	await _show_help()
	while EditorInterface.get_resource_filesystem().is_scanning():
		await get_tree().process_frame
	get_tree().quit(1 if _failed else 0)


func _enable() -> void:
	EditorInterface.set_plugin_enabled(ADDON, true)
	var settings: Window = _find_class(get_tree().root, "ProjectSettingsEditor")
	settings.popup_centered(Vector2i(1000, 600))
	var tabs: TabContainer = _find_class(settings, "TabContainer")
	for tab in tabs.get_tab_count():
		if tabs.get_tab_title(tab) == tr("Plugins"):
			tabs.current_tab = tab
	await _wait(1.0)
	await _take("1_enable")
	settings.hide()


# As the list of clicks has it.
func _build_scene() -> void:
	_root = Node3D.new()
	_root.name = "Node3D"
	var packed := PackedScene.new()
	packed.pack(_root)
	ResourceSaver.save(packed, SCENE)
	_root.free()
	EditorInterface.open_scene_from_path(SCENE)
	await _wait(1.0)
	_root = EditorInterface.get_edited_scene_root()
	EditorInterface.set_main_screen_editor("3D")
	var world := WorldEnvironment.new()
	world.environment = Environment.new()
	world.environment.background_mode = Environment.BG_SKY
	world.environment.sky = Sky.new()
	world.environment.sky.sky_material = ProceduralSkyMaterial.new()
	_add(world, "WorldEnvironment")
	var environment := LobeEnvironment3D.new()
	_add(environment, "LobeEnvironment3D")
	EditorInterface.edit_node(environment)
	await _wait(3.0)
	await _take("2_environment")
	var sphere := MeshInstance3D.new()
	sphere.mesh = SphereMesh.new()
	var material := LobeMaterial3D.new()
	material.anisotropy = 0.9
	sphere.material_override = material
	_add(sphere, "MeshInstance3D")
	EditorInterface.edit_node(sphere)
	await _wait(3.0)
	await _take("3_sphere")
	EditorInterface.edit_resource(material)
	await _wait(3.0)
	await _take("4_material")


func _add(node: Node, title: String) -> void:
	node.name = title
	_root.add_child(node)
	node.owner = _root


func _show_report() -> void:
	var menu := _find(EditorInterface.get_base_control(), "tools_menu.gd")
	menu.call("choose", 1)
	await _wait(1.0)
	await _take("8_report")
	(menu.get("_dialog") as Window).hide()


func _bake_table() -> void:
	var table := LobeTable.new()
	EditorInterface.edit_resource(table)
	await _wait(1.0)
	var panel := _find(EditorInterface.get_inspector(), "bake_panel.gd")
	var queue: Node = panel.get("_queue")
	var recipe: RefCounted = panel.get("recipe")
	# Long enough for a picture of the dialog.
	recipe.set("alpha", Vector2(0.02, 0.3))
	recipe.set("lobes", 32)
	panel.call("_fill")
	panel.call("bake")
	var dialog: Window = _find(EditorInterface.get_base_control(), "bake_dialog.gd")
	while not dialog.visible:
		await get_tree().process_frame
	await _wait(0.3)
	await _take("5_bake")
	queue.call("cancel_all")
	while queue.call("is_baking", table):
		await get_tree().process_frame
	panel.call("_on_preset", 2)
	panel.call("bake")
	while queue.call("is_baking", table):
		await get_tree().process_frame
	await _wait(1.0)
	var view := _find(EditorInterface.get_inspector(), "table_view.gd")
	var spheres: Node = view.call("get_spheres")
	spheres.call("render_reference")
	while spheres.call("get_reference_texture") == null:
		await get_tree().process_frame
	await _wait(3.0)
	(EditorInterface.get_inspector() as ScrollContainer).scroll_vertical = 330
	await _wait(0.5)
	await _take("6_baked")


func _show_import() -> void:
	var config := ConfigFile.new()
	config.set_value("remap", "importer", "lobelight.panorama")
	config.save("res://layers.exr.import")
	DirAccess.copy_absolute("res://data/layers.exr", "res://layers.exr")
	var files := EditorInterface.get_resource_filesystem()
	files.update_file("res://layers.exr")
	files.reimport_files(["res://layers.exr"])
	await _wait(1.0)
	EditorInterface.select_file("res://layers.exr")
	await _wait(1.0)
	var tree: Tree = _find_class(EditorInterface.get_file_system_dock(), "Tree")
	tree.multi_selected.emit(tree.get_selected(), 0, true)
	var dock := _find_class(EditorInterface.get_base_control(), "ImportDock") as Control
	if dock != null and dock.get_parent() is TabContainer:
		(dock.get_parent() as TabContainer).current_tab = dock.get_index()
	await _wait(1.5)
	await _take("7_import")


func _show_help() -> void:
	EditorInterface.set_main_screen_editor("Script")
	EditorInterface.get_script_editor().goto_help("class_name:LobeMaterial3D")
	await _wait(3.0)
	await _take("9_help")


func _find(root: Node, file: String) -> Node:
	var script := root.get_script() as Script
	if script != null and script.resource_path.get_file() == file:
		return root
	for child in root.get_children(true):
		var found := _find(child, file)
		if found != null:
			return found
	return null


func _find_class(root: Node, native_class: String) -> Node:
	if root.is_class(native_class):
		return root
	for child in root.get_children(true):
		var found := _find_class(child, native_class)
		if found != null:
			return found
	return null


func _wait(seconds: float) -> void:
	await get_tree().create_timer(seconds).timeout


func _take(picture: String) -> void:
	# The editor draws only what has changed.
	EditorInterface.get_base_control().queue_redraw()
	await RenderingServer.frame_post_draw
	var image := EditorInterface.get_base_control().get_viewport().get_texture().get_image()
	image.convert(Image.FORMAT_RGB8)
	if image.save_png(_folder.path_join(picture + ".png")) != OK:
		_failed = true
	print("took " + picture)
