@tool
extends GdUnitTestSuite
## What the editor says where the native library is missing.

const BakePanel := preload("res://addons/lobelight/editor/bake/bake_panel.gd")
const CreateMenu := preload("res://addons/lobelight/editor/create/create_menu.gd")
const Kit := preload("res://tests/editor/editor_kit.gd")
const NativeLibrary := preload("res://addons/lobelight/editor/bake/native_library.gd")
const Recipe := preload("res://addons/lobelight/editor/bake/bake_recipe.gd")


func test_the_inspector_says_what_is_missing() -> void:
	assert_bool(ClassDB.class_exists(&"LobeBaker")).is_false()
	Kit.get_plugin(get_tree())
	EditorInterface.inspect_object(LobeTable.new())
	await await_idle_frame()
	await await_idle_frame()
	var panels := Kit.find_all(EditorInterface.get_inspector(), BakePanel)
	assert_int(panels.size()).is_equal(1)
	var panel: BakePanel = panels[0]
	assert_str(panel.get_status()).is_equal(NativeLibrary.MISSING)
	EditorInterface.inspect_object(null)
	await await_idle_frame()


func test_a_bake_fails_with_a_sentence() -> void:
	var messages: PackedStringArray = []
	var table := LobeTable.new()
	var bakes: Node = Kit.get_plugin(get_tree()).get_bakes()
	var note := func(_table: LobeTable, message: String) -> void: messages.append(message)
	bakes.failed.connect(note)
	bakes.add(table, Recipe.new())
	bakes.failed.disconnect(note)
	assert_array(messages).is_equal(PackedStringArray([NativeLibrary.MISSING]))
	assert_int(table.lobe_count).is_equal(0)


func test_scenes_are_made_without_it() -> void:
	Kit.get_plugin(get_tree()).get_create_menu().choose(CreateMenu.Item.SPHERE)
	var root := EditorInterface.get_edited_scene_root()
	assert_int(root.get_child_count()).is_equal(4)
	EditorInterface.close_scene()
	await await_idle_frame()
