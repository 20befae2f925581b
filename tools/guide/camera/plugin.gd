@tool
extends EditorPlugin
## Goes through a page of the guide in the running editor with the mouse, takes a picture of each
## step and quits: "++ --guide-pictures FOLDER guide|hand|room". Fails where something is not where
## the page says.

const Finder := preload("finder.gd")
const HandWalk := preload("hand_walk.gd")
const Mouse := preload("mouse.gd")
const RoomWalk := preload("room_walk.gd")
const SphereWalk := preload("sphere_walk.gd")
const TableWalk := preload("table_walk.gd")

const OPTION := "--guide-pictures"
const SIZE := Vector2i(1400, 860)

var _folder := ""
var _walk := ""
var _mouse: Mouse


func _enter_tree() -> void:
	var arguments := OS.get_cmdline_user_args()
	var option := arguments.find(OPTION)
	if option >= 0 and option + 2 < arguments.size():
		_folder = arguments[option + 1]
		_walk = arguments[option + 2]
		_run.call_deferred()


func _run() -> void:
	_mouse = Mouse.new()
	add_child(_mouse)
	await _wait_for_files()
	get_window().mode = Window.MODE_WINDOWED
	get_window().size = SIZE
	await _mouse.wait(1.5)
	match _walk:
		"room":
			await _count(RoomWalk.new(_mouse, _take))
		"hand":
			await _count(HandWalk.new(_mouse, _take))
		_:
			await _count(SphereWalk.new(_mouse, _take))
			var table := TableWalk.new(_mouse, _take)
			await table.go()
			await _show_import()
			await _show_help()
	await _wait_for_files()
	get_tree().quit(mini(_mouse.problems.size(), 1))


# The clicks of a walk are in the file that the page's number is held against.
func _count(walk: RefCounted) -> void:
	await walk.call("go")
	var file := FileAccess.open(_folder.path_join("clicks"), FileAccess.WRITE)
	file.store_line(str(_mouse.clicks))


func _wait_for_files() -> void:
	while EditorInterface.get_resource_filesystem().is_scanning():
		await get_tree().process_frame


func _show_import() -> void:
	var config := ConfigFile.new()
	config.set_value("remap", "importer", "lobelight.panorama")
	config.save("res://layers.exr.import")
	DirAccess.copy_absolute("res://data/layers.exr", "res://layers.exr")
	var files := EditorInterface.get_resource_filesystem()
	files.update_file("res://layers.exr")
	files.reimport_files(["res://layers.exr"])
	await _mouse.wait(1.0)
	var dock := EditorInterface.get_file_system_dock()
	var tree: Tree = Finder.of_class(dock, "Tree")
	await _mouse.choose_item(tree, Finder.item(tree.get_root(), "layers.exr"), 0, "layers.exr")
	var tabs: TabBar = Finder.tabs(EditorInterface.get_base_control(), "Import")
	await _mouse.choose_tab(tabs, "Import")
	await _mouse.wait(1.0)
	await _take("7_import")


func _show_help() -> void:
	EditorInterface.set_main_screen_editor("Script")
	EditorInterface.get_script_editor().goto_help("class_name:LobeMaterial3D")
	await _mouse.wait(3.0)
	await _take("9_help")


func _take(picture: String) -> void:
	# The editor draws only what has changed.
	EditorInterface.get_base_control().queue_redraw()
	await RenderingServer.frame_post_draw
	var image := get_tree().root.get_texture().get_image()
	image.convert(Image.FORMAT_RGB8)
	if image.save_png(_folder.path_join(picture + ".png")) != OK:
		_mouse.fail(picture + " cannot be saved")
	print("took " + picture)
