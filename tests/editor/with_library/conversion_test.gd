@tool
extends GdUnitTestSuite
## Conversions of whole scenes, in the running editor: nothing that was converted is lost by saving,
## closing, opening, undoing and importing anew.

const ConversionScene := preload("res://tests/editor/conversion_scene.gd")
const Kit := preload("res://tests/editor/editor_kit.gd")
const Report := preload("res://addons/lobelight/editor/conversion/conversion_report.gd")
const SceneConversion := preload("res://addons/lobelight/editor/conversion/scene_conversion.gd")
const SceneFile := preload("res://addons/lobelight/editor/conversion/scene_file.gd")
const SceneMenu := preload("res://addons/lobelight/editor/conversion/scene_conversion_menu.gd")
const ToolsMenu := preload("res://addons/lobelight/editor/menu/tools_menu.gd")

const FILES: PackedStringArray = ["ball", "prop", "shelf", "hall"]

var _menu: SceneMenu


func before() -> void:
	_menu = Kit.get_plugin(get_tree())._scene_menu
	await _import(0.0)


func after() -> void:
	await _close_all()
	for file in DirAccess.get_files_at(ConversionScene.FOLDER):
		DirAccess.remove_absolute(ConversionScene.FOLDER.path_join(file))
	DirAccess.remove_absolute(ConversionScene.FOLDER)
	EditorInterface.get_resource_filesystem().scan()
	await Kit.wait_for_scan(get_tree())


func after_test() -> void:
	await _close_all()


func _close_all() -> void:
	while EditorInterface.get_edited_scene_root() != null:
		await _close()


# Materials stay until their nodes are gone: without a window, the renderer asks for those of a CSG
# shape when these are freed already.
func _close() -> void:
	var kept := ConversionScene.list_materials(EditorInterface.get_edited_scene_root())
	EditorInterface.close_scene()
	await await_idle_frame()
	kept.clear()


func _import(shift: float) -> void:
	var files := EditorInterface.get_resource_filesystem()
	ConversionScene.write_source(shift)
	if not ResourceLoader.exists(ConversionScene.THING):
		files.scan()
		var is_there := func() -> bool: return ResourceLoader.exists(ConversionScene.THING)
		await Kit.wait_until(get_tree(), is_there)
		await Kit.wait_for_scan(get_tree())
	else:
		files.reimport_files([ConversionScene.THING])
		await await_idle_frame()
	await await_idle_frame()


func _open(path: String) -> Node:
	EditorInterface.open_scene_from_path(path)
	await await_idle_frame()
	return EditorInterface.get_edited_scene_root()


# Saves the open scene, closes it and opens it again.
func _reopen() -> Node:
	var path := EditorInterface.get_edited_scene_root().scene_file_path
	EditorInterface.save_scene_as(path, false)
	await await_idle_frame()
	await _close()
	return await _open(path)


func _read_files() -> Array:
	return Array(FILES).map(
		func(name: String) -> String:
			return FileAccess.get_file_as_string(ConversionScene.FOLDER.path_join(name + ".tscn"))
	)


# What is drawn has the names and colours that it had, and is of one class; own shaders stay.
func _assert_drawn(
	root: Node, before: Dictionary[String, Array], type: String, where: String
) -> void:
	var now := ConversionScene.list_drawn(root)
	assert_array(now.keys()).append_failure_message(where).contains_exactly_in_any_order(
		before.keys()
	)
	var wrong: PackedStringArray = []
	for key in before:
		var expected := before[key].duplicate()
		if expected[0] != "ShaderMaterial":
			expected[0] = type
		if now.get(key) != expected:
			wrong.append("%s: %s instead of %s" % [key, now.get(key), expected])
	assert_str("\n".join(wrong.slice(0, 10))).append_failure_message(where).is_empty()


# How many nodes a scene's file has.
func _count_saved(root: Node) -> int:
	var packed := PackedScene.new()
	packed.pack(root)
	return packed.get_state().get_node_count()


func _undo(root: Node) -> void:
	Kit.get_history(root).undo()


func _redo(root: Node) -> void:
	Kit.get_history(root).redo()


func test_a_large_scene_is_converted_saved_undone_and_converted_back() -> void:
	var root := await _open(ConversionScene.write())
	assert_int(root.find_children("*", "Node", true, false).size()).is_greater_equal(200)
	var before := ConversionScene.list_drawn(root)
	assert_int(before.size()).is_greater(250)
	_assert_drawn(root, before, "StandardMaterial3D", "before")
	var files := _read_files()
	var saved := _count_saved(root)
	var report := _menu.convert_nodes([root])
	assert_int(_count_saved(root)).is_greater(saved + 100)
	_assert_drawn(root, before, "LobeMaterial3D", "converted")
	assert_str(report).contains(" and 2 nodes more: Sprite3Ds are drawn")
	assert_str(report).contains("whose shader is its own")
	_undo(root)
	_assert_drawn(root, before, "StandardMaterial3D", "undone")
	# Nothing of it is saved then, nor is any instance editable that was not.
	assert_int(_count_saved(root)).is_equal(saved)
	# The editor goes by its own count of the steps.
	_redo(root)
	_undo(root)
	root = await _reopen()
	_assert_drawn(root, before, "StandardMaterial3D", "undone and opened again")
	_menu.convert_nodes([root])
	_undo(root)
	_redo(root)
	root = await _reopen()
	_assert_drawn(root, before, "LobeMaterial3D", "opened again")
	var now := _read_files()
	for index in FILES.size() - 1:
		assert_str(now[index]).is_equal(files[index])
	assert_str(_menu.convert_nodes([root])).starts_with("0 materials")
	_menu.convert_back([root])
	root = await _reopen()
	_assert_drawn(root, before, "StandardMaterial3D", "converted back")


func test_instances_are_converted_in_their_own_files() -> void:
	var root := await _open(ConversionScene.write())
	var before := ConversionScene.list_drawn(root)
	var files := _read_files()
	var report := _menu.convert_nodes([root], true, true)
	assert_str(report).contains("3 files to be changed")
	assert_str(report).contains("prop.tscn").contains("ball.tscn").contains(
		"thing.gltf: it is imported"
	)
	_assert_drawn(root, before, "LobeMaterial3D", "converted")
	var converted := _read_files()
	_undo(root)
	_assert_drawn(root, before, "StandardMaterial3D", "undone")
	assert_array(_read_files()).is_equal(files)
	_redo(root)
	assert_array(_read_files()).is_equal(converted)
	root = await _reopen()
	_assert_drawn(root, before, "LobeMaterial3D", "opened again")
	# The files have it all, not the scene.
	var text: String = _read_files()[3]
	assert_str(text).not_contains('editable path="Shelf1"')
	# Other scenes have it with them.
	await _close()
	root = await _open(ConversionScene.FOLDER + "/shelf.tscn")
	for drawn in ConversionScene.list_drawn(root).values():
		assert_str(drawn[0]).is_not_equal("StandardMaterial3D")


func test_open_files_are_left_alone() -> void:
	ConversionScene.write()
	await _open(ConversionScene.FOLDER + "/prop.tscn")
	var root := await _open(ConversionScene.FOLDER + "/shelf.tscn")
	var files := _read_files()
	var before := ConversionScene.list_drawn(root)
	var report := _menu.convert_nodes([root], true, true)
	assert_str(report).contains("prop.tscn: it is open").contains("ball.tscn")
	_assert_drawn(root, before, "LobeMaterial3D", "converted")
	assert_str(_read_files()[1]).is_equal(files[1])
	_undo(root)
	_redo(root)


func test_it_survives_two_imports_of_the_source() -> void:
	var root := await _open(ConversionScene.write())
	var before := ConversionScene.list_drawn(root)
	_menu.convert_nodes([root])
	root = await _reopen()
	for shift: float in [0.25, 0.5]:
		await _import(shift)
		root = EditorInterface.get_edited_scene_root()
		_assert_drawn(root, before, "LobeMaterial3D", "imported at %s" % shift)
		var part := root.get_node("Thing/Thing/A") as MeshInstance3D
		assert_float(part.mesh.get_aabb().position.x).is_equal_approx(minf(shift, 0.0), 1e-3)
	root = await _reopen()
	_assert_drawn(root, before, "LobeMaterial3D", "opened again")
	# With the scene closed, too.
	await _close()
	for shift: float in [0.125, 0.0]:
		await _import(shift)
	root = await _open(ConversionScene.HALL)
	_assert_drawn(root, before, "LobeMaterial3D", "opened after the imports")


func test_one_node_of_an_instance_is_converted_alone() -> void:
	var root := await _open(ConversionScene.write())
	var before := ConversionScene.list_drawn(root)
	assert_bool(_scene_tree_lists("A")).is_false()
	var chosen := root.get_node("Shelf1/Thing/Thing/A")
	var added := MeshInstance3D.new()
	added.material_override = StandardMaterial3D.new()
	chosen.add_child(added)
	_menu.convert_nodes([chosen])
	# What a script has added is in no file.
	assert_object(added.material_override).is_instanceof(StandardMaterial3D)
	for frame in 2:
		await await_idle_frame()
	assert_bool(_scene_tree_lists("A")).is_true()
	root = await _reopen()
	var now := ConversionScene.list_drawn(root)
	for key in before:
		var is_chosen := key.begins_with("Shelf1/Thing/Thing/A ")
		assert_bool(now[key][0] == "LobeMaterial3D").append_failure_message(key).is_equal(is_chosen)


# Whether a node is among those that the editor's scene tree shows.
func _scene_tree_lists(name: String) -> bool:
	var docks := EditorInterface.get_base_control().find_children("*", "SceneTreeDock", true, false)
	for tree: Tree in docks[0].find_children("*", "Tree", true, false):
		var item := tree.get_root()
		while item != null:
			if item.get_text(0) == name:
				return true
			item = item.get_next_in_tree()
	return false


func test_inherited_scenes_are_converted() -> void:
	ConversionScene.write()
	EditorInterface.open_scene_from_path(ConversionScene.FOLDER + "/shelf.tscn", true)
	await await_idle_frame()
	var root := EditorInterface.get_edited_scene_root()
	ConversionScene.add_ball(root)
	var path := ConversionScene.FOLDER + "/inherited.tscn"
	EditorInterface.save_scene_as(path, false)
	assert_object((load(path) as PackedScene).get_state().get_base_scene_state()).is_not_null()
	var before := ConversionScene.list_drawn(root)
	for in_files: bool in [false, true]:
		var shelf := FileAccess.get_file_as_string(ConversionScene.FOLDER + "/shelf.tscn")
		_menu.convert_nodes([root], true, in_files)
		_assert_drawn(root, before, "LobeMaterial3D", "converted")
		_undo(root)
		_assert_drawn(root, before, "StandardMaterial3D", "undone")
		_redo(root)
		root = await _reopen()
		_assert_drawn(root, before, "LobeMaterial3D", "opened again")
		var now := FileAccess.get_file_as_string(ConversionScene.FOLDER + "/shelf.tscn")
		assert_str(now).is_equal(shelf)
		_menu.convert_back([root])
		root = await _reopen()
		_assert_drawn(root, before, "StandardMaterial3D", "converted back")


func test_files_that_cannot_be_written_stop_it() -> void:
	var root := await _open(ConversionScene.write())
	var before := ConversionScene.list_drawn(root)
	var files := _read_files()
	var conversion: SceneConversion = SceneConversion.of([root], root, true, true)
	# A folder is in the way.
	var last := conversion.files.files.back() as SceneFile
	last.path = ConversionScene.FOLDER
	var problem := conversion.commit(EditorInterface.get_editor_undo_redo())
	assert_str(problem).contains(ConversionScene.FOLDER + " cannot be written")
	_assert_drawn(root, before, "StandardMaterial3D", "refused")
	assert_array(_read_files()).is_equal(files)


func test_files_that_were_changed_since_are_left_alone() -> void:
	var root := await _open(ConversionScene.write())
	_menu.convert_nodes([root], true, true)
	var path := ConversionScene.FOLDER + "/ball.tscn"
	var text := FileAccess.get_file_as_string(path) + "\n"
	FileAccess.open(path, FileAccess.WRITE).store_string(text)
	await (
		assert_error(func() -> void: _undo(root))
		. is_push_warning(path + " has been changed since: it stays as it is.")
	)
	assert_str(FileAccess.get_file_as_string(path)).is_equal(text)
	_redo(root)


func test_the_dialog_shows_what_comes_and_converts() -> void:
	var root := await _open(ConversionScene.write())
	var tools: ToolsMenu = Kit.get_plugin(get_tree()).get_tools_menu()
	tools.choose(ToolsMenu.Item.ASK_TO_CONVERT)
	var dialog := _menu.get_dialog()
	assert_str(dialog.get_shown_text()).contains("to be made editable").not_contains(
		"to be changed"
	)
	var before := ConversionScene.list_drawn(root)
	dialog.in_files.button_pressed = true
	assert_str(dialog.get_shown_text()).contains("3 files to be changed")
	dialog.in_files.button_pressed = false
	_assert_drawn(root, before, "StandardMaterial3D", "shown")
	dialog.get_ok_button().pressed.emit()
	_assert_drawn(root, before, "LobeMaterial3D", "confirmed")
	assert_str(dialog.get_shown_text()).contains("Built into " + ConversionScene.HALL)
	for window: Window in dialog.find_children("*", "Window", true, false):
		window.hide()
	dialog.hide()


func test_a_conversion_says_what_it_did_and_what_light_is_missing() -> void:
	var root: Node3D = auto_free(Node3D.new())
	var conversion: SceneConversion = SceneConversion.of([root], root, true, false)
	assert_str(Report.summarise(conversion)).contains("no material of Godot's own")
	var shared := StandardMaterial3D.new()
	shared.resource_name = "steel"
	shared.refraction_enabled = true
	for part in 2:
		var sphere := MeshInstance3D.new()
		sphere.material_override = shared
		root.add_child(sphere)
		sphere.owner = root
	conversion = SceneConversion.of([root], root, true, false)
	var text := Report.summarise(conversion)
	assert_str(text).starts_with("Converted 1 material.").contains("Add a LobeEnvironment3D")
	root.add_child(LobeEnvironment3D.new())
	assert_str(Report.summarise(conversion)).is_equal("Converted 1 material.")
	assert_str(Report.describe(conversion)).contains("1 material in 2 nodes").contains('"steel"')
	for loss in LobeMaterial3D.get_losses_from(shared):
		assert_str(Report.describe(conversion)).contains("lost: ").contains(loss)
	conversion = SceneConversion.of([root], root, false, false)
	assert_str(Report.summarise(conversion)).contains("no material of Lobelight's")
